// Memory of zeros, behind which there is none until something is written.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstring>
#include <memory>
#include <new>

namespace parhelion {

struct UnmapPages {
    std::size_t bytes = 0;
    void operator()(void* p) const { munmap(p, bytes); }
};
using ZeroPages = std::unique_ptr<void, UnmapPages>;

/// Whole pages, `bytes` > 0 of them or more. Throws std::bad_alloc.
inline ZeroPages zero_pages(std::size_t bytes) {
    void* p = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (p == MAP_FAILED) throw std::bad_alloc();
    return ZeroPages(p, UnmapPages{bytes});
}

/// Zeros again, with no memory behind them.
inline void forget(const ZeroPages& pages) {
    const std::size_t bytes = pages.get_deleter().bytes;
    // Not of pages that are locked: those stay.
    if (madvise(pages.get(), bytes, MADV_DONTNEED) != 0) std::memset(pages.get(), 0, bytes);
}

} // namespace parhelion
