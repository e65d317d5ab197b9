// The share of light that rough surfaces send on by single scattering, tabulated for the device.
#include "host/flatten/energy_table.h"

#include "host/flatten/material_records.h"
#include "host/flatten/rough_coat.h"
#include "host/parallel.h"

#include <cmath>
#include <map>
#include <span>
#include <tuple>

#include "host/flatten/single_scattering.h" // last: its macros have short names

namespace parhelion {
namespace {

/// Computed entries of a row and of a column; the rest is interpolated by cubics, for the device to
/// interpolate linearly.
constexpr int cosine_knots = 65, anisotropic_cosine_knots = 33;
static_assert((ENERGY_COSINES - 1) % (cosine_knots - 1) == 0);
static_assert((ENERGY_COSINES - 1) % (anisotropic_cosine_knots - 1) == 0);

/// x in [0, 1] where the increasing function f is y.
template<class F>
double inverse_of(const F& f, double y) {
    double low = 0.0, high = 1.0;
    for (int step = 0; step < 60; step++) {
        double middle = 0.5 * (low + high);
        (f(middle) < y ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

/// The direction whose table coordinates these are.
f64::vec3 direction_at(const RoughSide& side, double cosine_coordinate, double azimuth_coordinate) {
    const f64::Material& m = side.material;
    double sine_squared = inverse_of(
        [&](double s) { return f64::energy_azimuth_coordinate(s, m.alpha_u, m.alpha_v); },
        azimuth_coordinate);
    double alpha = std::sqrt(f64::roughness_along(sine_squared, m.alpha_u, m.alpha_v));
    f64::EnergyScale scale = f64::energy_scale(m, alpha);
    double c = inverse_of([&](double x) { return f64::energy_cosine_coordinate(x, scale); },
                          cosine_coordinate);
    double sine = std::sqrt((1.0 - c) * (1.0 + c));
    return {sine * std::sqrt(1.0 - sine_squared), sine * std::sqrt(sine_squared), c};
}

/// Slopes of a curve through evenly spaced values, a step wide: of the parabola through three.
double slope_at(const std::vector<double>& y, std::size_t i) {
    std::size_t last = y.size() - 1;
    if (i == 0) return 0.5 * (4.0 * y[1] - 3.0 * y[0] - y[2]);
    if (i == last) return 0.5 * (3.0 * y[last] - 4.0 * y[last - 1] + y[last - 2]);
    return 0.5 * (y[i + 1] - y[i - 1]);
}

/// `refinement` values for each interval of `y`, on the cubic of its ends' values and slopes.
std::vector<double> refined(const std::vector<double>& y, int refinement) {
    std::vector<double> fine;
    for (std::size_t i = 0; i + 1 < y.size(); i++) {
        double rise = y[i + 1] - y[i], a = slope_at(y, i), b = slope_at(y, i + 1);
        for (int k = 0; k < refinement; k++) {
            double x = static_cast<double>(k) / refinement;
            fine.push_back(y[i] + x * (a + x * (3 * rise - 2 * a - b + x * (a + b - 2 * rise))));
        }
    }
    fine.push_back(y.back());
    return fine;
}

using Rows = std::vector<std::vector<double>>;

Rows transposed(const Rows& rows) {
    Rows columns(rows.front().size(), std::vector<double>(rows.size()));
    for (std::size_t i = 0; i < rows.size(); i++)
        for (std::size_t k = 0; k < columns.size(); k++)
            columns[k][i] = rows[i][k];
    return columns;
}

/// Computed values in rows of equal azimuth, one row where the material is isotropic.
Rows knots(const RoughSide& side, int azimuths, int cosines) {
    Rows rows(static_cast<std::size_t>(azimuths), std::vector<double>(cosines));
    parallel_for(rows.size() * static_cast<std::size_t>(cosines), [&](std::size_t n) {
        int number = static_cast<int>(n), row = number / cosines, column = number % cosines;
        double azimuth = azimuths > 1 ? row / (azimuths - 1.0) : 0.0;
        f64::vec3 wo = direction_at(side, column / (cosines - 1.0), azimuth);
        rows[row][column] = single_scattering(side, wo, azimuths == 1);
    });
    return rows;
}

/// Each row to `count` values.
void refine(Rows& rows, int count) {
    for (std::vector<double>& row : rows)
        row = refined(row, (count - 1) / (static_cast<int>(row.size()) - 1));
}

/// Measured: half of them are enough while one roughness is less than 3 times the other.
int azimuth_knots(const f64::Material& m) {
    double ratio = m.alpha_u / m.alpha_v;
    return ratio < 3.0 && ratio > 1.0 / 3.0 ? (ENERGY_AZIMUTHS + 1) / 2 : ENERGY_AZIMUTHS;
}

Rows table(const RoughSide& side, int azimuths) {
    Rows rows;
    if (side.material.alpha_u == side.material.alpha_v) {
        rows = knots(side, 1, cosine_knots);
        refine(rows, ENERGY_COSINES);
        rows.resize(static_cast<std::size_t>(azimuths), rows.front());
        return rows;
    }
    rows = transposed(knots(side, azimuth_knots(side.material), anisotropic_cosine_knots));
    refine(rows, ENERGY_AZIMUTHS);
    rows = transposed(rows);
    refine(rows, ENERGY_COSINES);
    return rows;
}

void append(std::vector<float>& values, const Rows& rows) {
    for (const std::vector<double>& row : rows)
        values.insert(values.end(), row.begin(), row.end());
}

/// What a coat sends on, of what it receives from outside, and lets through. Compensated, it sends
/// on everything, and lets through as much of that as of single scattering.
std::vector<float> coat_tables(const f64::Material& m, int azimuths, bool compensated) {
    RoughSide side{m, true, f64::material_interface(m, true)};
    side.sent = Sent::refracted;
    Rows let_through = table(side, azimuths);
    Rows sent_on(let_through.size(), std::vector<double>(let_through.front().size(), 1.0));
    if (compensated) {
        side.sent = Sent::all;
        sent_on = table(side, azimuths);
        for (std::size_t row = 0; row < sent_on.size(); row++)
            for (std::size_t i = 0; i < sent_on[row].size(); i++)
                let_through[row][i] /= sent_on[row][i];
    }
    std::vector<float> values;
    append(values, sent_on);
    append(values, let_through);
    return values;
}

/// Which materials have the same tables.
using TableKey = std::tuple<int, int, float, float, float, float, bool>;

TableKey key_of(const MaterialRecord& m, bool compensated) {
    bool interface = (interface_materials >> m.kind) & 1;
    return {m.kind,     m.distribution,         m.alpha_u,
            m.alpha_v,  interface ? m.eb : 0.f, interface ? m.kr : 0.f,
            compensated};
}

} // namespace

std::vector<float> energy_tables(const MaterialRecord& record, int azimuths, bool compensated) {
    std::vector<float> values;
    f64::Material m = widened(record);
    if (record.kind == material_roughplastic) return coat_tables(m, azimuths, compensated);
    bool interface = record.kind == material_roughdielectric;
    for (bool outside : {true, false}) {
        append(values, table({m, interface, f64::material_interface(m, outside)}, azimuths));
        if (!interface) break;
    }
    return values;
}

bool wants_energy_compensation(const Bsdf& bsdf) {
    return std::visit(
        [](const auto& b) {
            // A table is of one roughness and one index.
            if constexpr (requires { b.energy_compensation; })
                return b.energy_compensation && !has_textured_lobe(b) && !has_thin_base(b);
            return false;
        },
        bsdf);
}

void add_energy_tables(const Scene& scene, DeviceScene& out) {
    if (!out.features.has(feature_next_event) && !out.features.has(feature_scattering)) return;
    struct Entry {
        int table;
        double inner_reflectance;
    };
    int azimuths = out.features.has(feature_anisotropy) ? ENERGY_AZIMUTHS : 1;
    std::map<TableKey, Entry> known;
    for (std::size_t i = 0; i < scene.materials.size(); i++) {
        MaterialRecord& m = out.materials[i];
        bool compensated = wants_energy_compensation(scene.materials[i].bsdf);
        bool coat = m.kind == material_roughplastic;
        if (!compensated && !coat) continue;
        int table = static_cast<int>(out.energy_tables.size()) / (ENERGY_COSINES * azimuths);
        auto [entry, is_new] = known.try_emplace(key_of(m, compensated), Entry{table, 0.0});
        if (is_new) {
            std::vector<float> tables = energy_tables(m, azimuths, compensated);
            out.energy_tables.insert(out.energy_tables.end(), tables.begin(), tables.end());
            if (coat)
                entry->second.inner_reflectance =
                    coat_inner_reflectance(m, std::span(tables).last(ENERGY_COSINES), compensated);
        }
        if (coat) m.kg = std::copysign(static_cast<float>(entry->second.inner_reflectance), m.kg);
        m.distribution |= (1 + entry->second.table) << 1;
    }
}

} // namespace parhelion
