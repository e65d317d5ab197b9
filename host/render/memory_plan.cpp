// How a render keeps to the memory that it may take.
#include "host/render/memory_plan.h"

#include "host/error.h"
#include "host/flatten/flattened_size.h"
#include "host/memory_use.h"

#include <fmt/format.h>

#include <algorithm>

namespace parhelion {
namespace {

constexpr double megabyte = 1 << 20;

/// Kernels, once they are loaded (measured: up to 16 MB).
constexpr std::uint64_t kernel_bytes = 20 << 20;

constexpr int smallest_pool = 1 << 12; ///< paths

/// Of a stream, for as many of a picture's samples as there are.
WorkSizes sizes_of(const MemoryNeed& need, const FilmLayout& film, int pool_paths) {
    WorkSplit split = need.split;
    split.pool_paths = pool_paths;
    return work_sizes(film, need.scene.sampler.samples_per_pixel, need.lanes, split);
}

FilmLayout row_of_blocks(const FilmLayout& film) { return in_bands(film, 1); }

/// As many paths as asked for, halved until they take no more than a third of the room, and leave
/// some for a row of blocks.
int paths_in(const MemoryNeed& need, const FilmLayout& film, std::uint64_t room) {
    const std::uint64_t row = row_of_blocks(film).bytes();
    const auto fit = [&](int paths) {
        const std::uint64_t pool = pool_bytes(sizes_of(need, film, paths));
        return pool <= room / 3 && pool + row <= room;
    };
    int paths = need.split.pool_paths;
    while (paths > smallest_pool && !fit(paths))
        paths = std::max(smallest_pool, paths / 2);
    return paths;
}

[[noreturn]] void refuse_row(const MemoryNeed& need, const FilmLayout& film, std::uint64_t room) {
    throw InputError(fmt::format(
        "{}: {} rows of a film of {} pixels a row and {} channels take {:.2f} MB; there is room "
        "for {:.2f} MB (accepted: a smaller --size, or a part of it, --crop{})",
        need.scene.file, BLOCK_SIDE, need.scene.film.crop_width, film.channels(),
        static_cast<double>(row_of_blocks(film).bytes()) / megabyte,
        static_cast<double>(room) / megabyte, need.limit > 0 ? ", or a larger --memory" : ""));
}

std::uint64_t memory_there(const MemoryNeed& need) {
    const bool shared = need.device.of_host && need.of_group > 0;
    return shared ? std::min(need.device.all, need.of_group) : need.device.all;
}

/// For pool and film, where both are as large as `scene_bytes` and what is in memory allow.
std::uint64_t room_beside(const MemoryNeed& need, std::uint64_t scene_bytes) {
    // On a device whose memory is not the host's, the host still looks at a band at a time.
    const std::uint64_t host = resident_host_bytes() + passing_bytes;
    const std::uint64_t device = need.device.of_host ? 0 : scene_bytes;
    const std::uint64_t used = std::max(host, device);
    const std::uint64_t limit = std::min(need.limit, memory_there(need));
    return limit > used ? limit - used : 0;
}

/// Without a limit the room is that of the film, whatever the pool takes.
std::vector<WorkSizes> planned_in(const MemoryNeed& need, std::uint64_t room) {
    const FilmLayout film = film_layout(need.scene, need.aovs);
    WorkSplit split = need.split;
    std::uint64_t for_film = room;
    if (need.limit > 0) {
        split.pool_paths = paths_in(need, film, room);
        const std::uint64_t pool = pool_bytes(sizes_of(need, film, split.pool_paths));
        for_film = room > pool ? room - pool : 0;
    }
    const std::uint64_t at_once = std::min(for_film, need.device.buffer);
    const FilmLayout in_room =
        in_bands(film, split.film_bytes > 0 ? split.film_bytes : std::size_t{at_once});
    if (in_room.bytes() > at_once) refuse_row(need, film, at_once);
    split.bands_in_turn |= film.bytes() > for_film;
    return pool_choices(in_room, need.scene.sampler.samples_per_pixel, need.lanes, split);
}

/// Where nothing is said, half of what there is, so that the rest of the machine has some.
std::uint64_t room_there(const MemoryNeed& need) { return memory_there(need) / 2; }

void note(Progress& progress, const MemoryNeed& need, const WorkSizes& sizes) {
    const std::size_t pool = pool_bytes(sizes),
                      asked = pool_bytes(sizes_of(need, sizes.film, need.split.pool_paths));
    if (pool < asked)
        progress.note(fmt::format("note: the pool of paths has {:.0f} MB in the place of {:.0f}",
                                  static_cast<double>(pool) / megabyte,
                                  static_cast<double>(asked) / megabyte));
    if (sizes.bands_at_once == sizes.film.bands()) return;
    const std::uint64_t bytes = std::uint64_t{sizes.film.bytes()} * sizes.film.bands();
    progress.note(fmt::format("note: the film would take {:.0f} MB: {:.0f} MB of it at a time are "
                              "in memory, the rest is on the disk",
                              static_cast<double>(bytes) / megabyte,
                              static_cast<double>(sizes.film.bytes()) / megabyte));
}

} // namespace

void check_memory(const MemoryNeed& need) {
    if (need.limit == 0) {
        planned_in(need, room_there(need));
        return;
    }
    const FilmLayout film = film_layout(need.scene, need.aovs);
    const int paths = std::min(smallest_pool, need.split.pool_paths);
    const std::uint64_t now = resident_host_bytes(), records = most_flattened_bytes(need.scene),
                        pool = pool_bytes(sizes_of(need, film, paths)),
                        row = row_of_blocks(film).bytes(),
                        passing = passing_bytes + (need.kernels_loaded ? 0 : kernel_bytes);
    const std::uint64_t least = now + records + passing + pool + row;
    if (least <= need.limit) return;
    auto megabytes = [](std::uint64_t bytes) { return static_cast<double>(bytes) / megabyte; };
    // With what a process that has made a few frames needs beside.
    throw InputError(fmt::format(
        "{}: needs about {:.0f} MB of memory: {:.0f} for program and scene, {:.0f} for records and "
        "tree of the scene, {:.0f} for a small pool and a few rows of the film, {:.0f} for "
        "kernels, the picture and the like (accepted: --memory {:.0f}M or more)",
        need.scene.file, megabytes(least), megabytes(now), megabytes(records),
        megabytes(pool + row), megabytes(passing), megabytes(least + least / 16) + 1));
}

std::vector<WorkSizes> sizes_in_memory(const MemoryNeed& need, std::uint64_t scene_bytes,
                                       Progress& progress) {
    const std::uint64_t room = need.limit > 0 ? room_beside(need, scene_bytes) : room_there(need);
    std::vector<WorkSizes> sizes = planned_in(need, room);
    note(progress, need, sizes.front());
    return sizes;
}

} // namespace parhelion
