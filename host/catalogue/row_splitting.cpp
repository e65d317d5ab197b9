// The image depends on the scene alone, to the bit: not on lanes, intrinsics, features, how work is
// split, or crop.
#include "host/catalogue/rows.h"

#include "host/catalogue/row_images.h"
#include "host/numerics/every_kind_scene.h"
#include "host/numerics/kernel_ways.h"

#include <fmt/format.h>

namespace parhelion::stress {
namespace {

struct Way {
    std::string text;
    RenderOptions options;
};

std::vector<Way> splits() {
    std::vector<Way> list;
    auto add = [&](const WorkSplit& split, int lanes = 0) {
        list.push_back({fmt::format("pool {}, segments of {}, groups of {}, {} streams, {} lanes",
                                    split.pool_paths, split.segment_paths, split.work_group_size,
                                    split.streams, lanes),
                        {}});
        list.back().options.split = split, list.back().options.lanes = lanes;
    };
    for (int pool : {16, 1000, 65536})
        for (int segment : {16, 100, 4096})
            for (int group : {1, 2, 7})
                if (pool > 16 || group * segment <= 100) // the same as a smaller one, and slow
                    add({pool, segment, group});
    for (int streams : {1, 2, 3})
        add({8192, 1024, 1, streams});
    add({1000, 37, 2}, 1);
    return list;
}

std::vector<Way> kernels() {
    std::vector<Way> list;
    for (const KernelWay& way : kernel_ways) {
        list.push_back({way.name(), {}});
        list.back().options.lanes = way.lanes, list.back().options.portable = way.portable;
    }
    list.push_back({"kernels of all features", {}});
    list.back().options.all_features = true;
    return list;
}

/// Each way's image against that of the run's own kernels, split as ever.
Checks made_in_ways(StressRun& run, const std::string& name, const std::vector<Way>& ways) {
    Scene scene = every_kind_scene();
    Check bad = bad_samples_check(name), check = same_bits_check(name);
    Image full = image_of(run, scene, bad);
    for (std::size_t i = 0; i < ways.size(); i++) {
        add_images(check, full, image_of(run, scene, bad, ways[i].options), ways[i].text);
        run.done(static_cast<double>(i + 1) / static_cast<double>(ways.size()));
    }
    return {check, bad};
}

} // namespace

Checks row_splitting(StressRun& run) { return made_in_ways(run, "split in other ways", splits()); }

Checks row_kernels(StressRun& run) { return made_in_ways(run, "other kernels", kernels()); }

/// With samples beyond the film's border and without, splatted and by filter sampling.
Checks row_crops(StressRun& run) {
    Scene scene = every_kind_scene();
    Check bad = bad_samples_check("cropped"), check = same_bits_check("cropped");
    const int windows[][4] = {{0, 0, 40, 30}, {3, 5, 17, 11}, {39, 29, 1, 1}, {8, 0, 4, 30}};
    for (bool border : {false, true})
        for (FilterMethod method : {FilterMethod::splatting, FilterMethod::sampling}) {
            scene.film.sample_border = border, scene.film.filter_method = method;
            Image full = image_of(run, scene, bad);
            for (const auto& [x, y, width, height] : windows) {
                Scene part = scene;
                part.film.crop_x = x, part.film.crop_y = y;
                part.film.crop_width = width, part.film.crop_height = height;
                add_images(check, full, image_of(run, part, bad),
                           fmt::format("crop {},{},{},{}", x, y, width, height));
            }
            run.done(border ? 1 : 0.5);
        }
    return {check, bad};
}

} // namespace parhelion::stress
