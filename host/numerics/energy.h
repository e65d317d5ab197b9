// Materials with energy compensation on the host: what kernels/device/energy_table.h does, without
// pointers to buffers.
#pragma once

#include "host/flatten/energy_table.h"
#include "host/flatten/material_records.h"
#include "host/flatten/rough_coat.h"
#include "host/numerics/materials.h"

#include <span>
#include <vector>

namespace parhelion::numerics {

inline MaterialRecord record_of(const f32::Material& m) {
    MaterialRecord record{};
#define COPY_FIELD(type, name) record.name = m.name;
    MATERIAL_FIELDS(COPY_FIELD)
#undef COPY_FIELD
    return record;
}

/// What stands in a material's tables for w, `further` of them behind the first.
template<class M, class V>
auto tabulated_share(const std::vector<float>& tables, const M& m, V w, int further = 0) {
    using Real = decltype(w.x);
    auto place = energy_place(m, w);
    auto between = [&](int at) {
        Real low = Real(tables.at(at)), high = Real(tables.at(at + 1));
        return low + place.along_cosine * (high - low);
    };
    int at = place.at + further * ENERGY_COSINES * ENERGY_AZIMUTHS;
    Real here = between(at), next = between(at + ENERGY_COSINES);
    return here + place.along_azimuth * (next - here);
}

/// A rough plastic as the viewer at wo sees it, in light from wi.
template<class M, class V>
M coated(const std::vector<float>& tables, M m, V wo, V wi) {
    if (m.kind != material_roughplastic) return m;
    m.kb = tabulated_share(tables, m, wo, 1) * tabulated_share(tables, m, wo);
    m.eg = tabulated_share(tables, m, wi, 1);
    return m;
}

/// A rough material and its tables. Its average reflectance, if it is a conductor, is what the case
/// has as a transmittance: 1 where it is lossless.
template<class P>
class CompensatedMaterial {
public:
    using Real = typename P::Real;
    using Vec3 = typename P::Vec3;

    explicit CompensatedMaterial(const MaterialCase& c)
        : material_(make_material<P>(c)),
          tables_(energy_tables(record_of(make_material<F32>(c)), ENERGY_AZIMUTHS)) {
        if (c.kind == material_roughplastic)
            material_.kg = Real(coat_inner_reflectance(
                record_of(make_material<F32>(c)), std::span(tables_).last(ENERGY_COSINES), true));
        material_.distribution |= 1 << 1; // the first table
    }

    Vec3 gain(Vec3 wo) const {
        return energy_gain(material_, tabulated_share(tables_, material_, wo));
    }

    /// As bsdf_sample, without the gain.
    auto sample(Vec3 wo, typename P::Vec2 u, Real lobe) const {
        auto s = bsdf_sample(coated(tables_, material_, wo, Vec3{0, 0, 1}), wo, u, lobe);
        if (material_.kind == material_roughplastic && s.pdf > 0) {
            auto e = bsdf_eval(coated(tables_, material_, wo, s.wi), wo, s.wi);
            s.weight = {e.f.x / e.pdf, e.f.y / e.pdf, e.f.z / e.pdf};
        }
        return s;
    }

private:
    typename P::Material material_;
    std::vector<float> tables_;
};

inline bool is_rough(int kind) { return (rough_materials >> kind) & 1; }

} // namespace parhelion::numerics
