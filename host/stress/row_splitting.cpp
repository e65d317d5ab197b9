// The image depends on the scene alone, to the bit: not on lanes, intrinsics, features, how work is
// split, or crop.
#include "host/stress/rows.h"

#include "host/render/path_tracer.h"
#include "host/stress/every_kind_scene.h"
#include "host/stress/image_figures.h"

#include <fmt/format.h>

namespace parhelion::stress {
namespace {

Image image_of(StressRun& run, const Scene& scene, const RenderOptions& options = {}) {
    Progress quiet(Progress::Mode::quiet);
    return render(scene, run.device, options, quiet).image;
}

struct Way {
    std::string text;
    RenderOptions options;
};

std::vector<Way> splits() {
    std::vector<Way> list;
    auto add = [&](const WorkSplit& split) {
        list.push_back(
            {fmt::format("pool {}, segments of {}, groups of {}, {} streams", split.pool_paths,
                         split.segment_paths, split.work_group_size, split.streams),
             {}});
        list.back().options.split = split;
    };
    add({16, 16, 1});
    for (int pool : {1000, 65536})
        for (int segment : {16, 100, 4096})
            for (int group : {1, 2, 7})
                add({pool, segment, group});
    for (int streams : {1, 2, 3})
        add({8192, 1024, 1, streams});
    return list;
}

std::vector<Way> kernels() {
    std::vector<Way> list;
    for (int lanes : {16, 8, 1}) {
        list.push_back({fmt::format("{} lanes", lanes), {}});
        list.back().options.lanes = lanes;
    }
    list.push_back({"without intrinsics", {}});
    list.back().options.portable = true;
    list.push_back({"kernels of all features", {}});
    list.back().options.all_features = true;
    return list;
}

void add(Check& check, const DifferingValues& found, const std::string& where) {
    if (found.differing > 0) check.worst_at = where;
    check.value += static_cast<double>(found.differing);
    check.samples += found.values;
}

Check same(const std::string& name) {
    return {.name = name + ": values of other bits", .target = 0, .unit = "values"};
}

} // namespace

Checks row_splitting(StressRun& run) {
    Scene scene = every_kind_scene();
    Image full = image_of(run, scene);
    Checks checks;
    for (const auto& [name, ways] :
         {std::pair{"split in other ways", splits()}, {"other kernels", kernels()}}) {
        Check check = same(name);
        for (const Way& way : ways)
            add(check, differing_values(full, image_of(run, scene, way.options)), way.text);
        checks.push_back(check);
        run.done(0.4 * static_cast<double>(checks.size()));
    }
    Check crops = same("cropped");
    const int windows[][4] = {{0, 0, 40, 30}, {3, 5, 17, 11}, {39, 29, 1, 1}, {8, 0, 4, 30}};
    for (const auto& [x, y, width, height] : windows) {
        Scene part = scene;
        part.film.crop_x = x, part.film.crop_y = y;
        part.film.crop_width = width, part.film.crop_height = height;
        add(crops, differing_values(full, image_of(run, part)),
            fmt::format("crop {},{},{},{}", x, y, width, height));
    }
    checks.push_back(crops);
    return checks;
}

} // namespace parhelion::stress
