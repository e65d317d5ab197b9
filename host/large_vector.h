// Vectors for the large arrays of a scene.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <new>
#include <vector>

namespace parhelion {

/// Allocates whole cache lines, large arrays in huge pages where the system has them (a ray that
/// jumps about in a large scene meets a page it has not seen at nearly every node), and leaves the
/// elements of resize() uninitialised: the threads that fill them touch them first.
template<class T>
struct LargeAllocator {
    // NOLINTNEXTLINE(readability-identifier-naming): the allocator requirements name it
    using value_type = T;
    static constexpr std::size_t cache_line = 64, huge_page = std::size_t{1} << 21;

    LargeAllocator() = default;
    template<class U>
    LargeAllocator(const LargeAllocator<U>&) {}

    T* allocate(std::size_t n) {
        void* p = ::operator new(n * sizeof(T), alignment(n));
        // Without huge pages everything works as well, if more slowly: no reason to fail.
        if (is_large(n)) static_cast<void>(madvise(p, n * sizeof(T), MADV_HUGEPAGE));
        return static_cast<T*>(p);
    }
    void deallocate(T* p, std::size_t n) { ::operator delete(p, alignment(n)); }
    template<class U>
    void construct(U* p) {
        ::new (static_cast<void*>(p)) U;
    }
    template<class U, class... Arguments>
    void construct(U* p, Arguments&&... arguments) {
        ::new (static_cast<void*>(p)) U(static_cast<Arguments&&>(arguments)...);
    }
    bool operator==(const LargeAllocator&) const { return true; }

private:
    static bool is_large(std::size_t n) { return n * sizeof(T) >= huge_page; }
    static std::align_val_t alignment(std::size_t n) {
        return std::align_val_t{is_large(n) ? huge_page : cache_line};
    }
};

template<class T>
using LargeVector = std::vector<T, LargeAllocator<T>>;

} // namespace parhelion
