// The table of lights: what of each row the device gets, and how one of them is picked.
#include "host/flatten/light_table.h"

#include "host/error.h"
#include "host/flatten/aov_plan.h"
#include "host/flatten/kind_names.h"
#include "host/flatten/light_bounds.h"
#include "host/flatten/light_rows.h"
#include "host/flatten/radiance_unit.h"
#include "kernels/device/buffers.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <limits>

namespace parhelion {
namespace {

LightRecord light_record(const LightRow& row, double pmf) {
    auto single = [](double v) { return static_cast<float>(v); };
    LightRecord l{};
    l.kind = row.kind;
    l.ax = single(row.a.x), l.ay = single(row.a.y), l.az = single(row.a.z);
    l.bx = single(row.b.x), l.by = single(row.b.y), l.bz = single(row.b.z);
    l.cx = single(row.c.x), l.cy = single(row.c.y), l.cz = single(row.c.z);
    const Rgb radiance = row.texture < 0 ? row.radiance : row.told;
    l.r = single(radiance.r), l.g = single(radiance.g), l.b = single(radiance.b);
    l.pmf = single(pmf), l.area = single(row.area), l.extra = single(row.extra);
    return l;
}

/// Intensities grow with the square of the scene's unit: of a scene small enough they are beyond
/// all numbers.
void check_range(const LightRow& row, const std::string& file) {
    if (!std::isfinite(brightness(row.radiance)))
        throw InputError(fmt::format("{}: a light is too bright for the unit that the scene is "
                                     "rendered in (accepted: radiance and intensity up to {:.0e} "
                                     "there)",
                                     file, std::numeric_limits<double>::max() / 3));
}

/// Of lights all too dim for the numbers of the image: the unit is 2^19 to 2^20 times the
/// brightest.
void note_dim_lights(const Scene& scene, double unit, std::vector<std::string>& notes) {
    bool half = scene.film.component_format == ComponentFormat::float16;
    double least = half ? 0x1p-24 : 0x1p-149;
    if (unit < 1.0 && unit * 0x1p-19 <= least)
        notes.push_back(fmt::format("{}: all lights are dimmer than the least number of an image "
                                    "of {} ({:.2g}), which stays black",
                                    scene.file, half ? "float16" : "float32", least));
}

std::vector<LightBounds> bounds_of(const std::vector<LightRow>& rows, double total) {
    // Only ratios of powers count. In units of a power of two near their sum, which changes no bit,
    // they are single-precision numbers however bright the lights are.
    int unit = rows.empty() ? 0 : std::ilogb(total);
    std::vector<LightBounds> bounds;
    for (const LightRow& row : rows) {
        LightBounds b = light_bounds(row);
        b.power = std::scalbn(b.power, -unit), b.intensity = std::scalbn(b.intensity, -unit);
        bounds.push_back(b);
    }
    return bounds;
}

void add_frame(const LightRow& row, std::vector<float>& frames) {
    for (int axis = 0; axis < 3; axis++)
        frames.push_back(static_cast<float>(row.across[axis]));
    frames.push_back(static_cast<float>(row.aspect));
}

void add_light_textures(const std::vector<LightRow>& rows, DeviceScene& out) {
    auto has_one = [](const LightRow& row) { return row.texture >= 0; };
    if (std::none_of(rows.begin(), rows.end(), has_one)) return;
    std::vector<float> frames;
    for (const LightRow& row : rows) {
        int words[LIGHT_TEXTURE_WORDS] = {row.texture, row.first_primitive, row.primitive_count};
        if (row.first_primitive < 0) {
            words[1] = static_cast<int>(LIGHT_TEXTURE_WORDS * rows.size() + frames.size());
            words[2] = 0;
            if (row.texture >= 0) add_frame(row, frames);
        }
        out.light_textures.insert(out.light_textures.end(), std::begin(words), std::end(words));
    }
    for (float word : frames)
        out.light_textures.push_back(std::bit_cast<int>(word));
}

void add_light_groups(const Scene& scene, const std::vector<LightRow>& rows, DeviceScene& out) {
    if (scene.integrator.light_groups.empty()) return;
    const AovPlan plan = plan_aovs(scene);
    for (const LightRow& row : rows)
        out.light_groups.push_back(
            AOV_CHANNEL(plan.light_groups[static_cast<std::size_t>(row.group)].channel));
}

} // namespace

void add_light_table(const Scene& scene, LightChoice choice, DeviceScene& out) {
    std::vector<LightRow> rows = light_rows(scene, out, out.notes);
    out.frame.radiance_unit = radiance_unit(rows);
    note_dim_lights(scene, out.frame.radiance_unit, out.notes);
    double total = 0.0;
    for (LightRow& row : rows) {
        row.radiance /= out.frame.radiance_unit;
        row.told /= out.frame.radiance_unit;
        check_range(row, scene.file);
        total += power(row);
    }
    for (std::size_t i = 0; i < rows.size(); i++) {
        const LightRow& row = rows[i];
        for (int k = 0; row.first_primitive >= 0 && k < row.primitive_count; k++)
            out.geometry.primitives[row.first_primitive + k].light = static_cast<int>(i);
        if (emitter_places[row.kind] == place_all_around) out.sky_light = static_cast<int>(i);
        out.lights.push_back(light_record(row, power(row) / total));
    }
    add_light_textures(rows, out);
    add_light_groups(scene, rows, out);
    out.light_tree = build_light_tree(bounds_of(rows, total), choice);
}

} // namespace parhelion
