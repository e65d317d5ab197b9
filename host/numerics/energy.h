// Materials with energy compensation on the host: what kernels/device/energy_table.h does, without
// pointers to buffers.
#pragma once

#include "host/flatten/energy_table.h"
#include "host/flatten/material_records.h"
#include "host/numerics/materials.h"

namespace parhelion::numerics {

inline MaterialRecord record_of(const f32::Material& m) {
    MaterialRecord record{};
#define COPY_FIELD(type, name) record.name = m.name;
    MATERIAL_FIELDS(COPY_FIELD)
#undef COPY_FIELD
    return record;
}

/// A rough material and its tables. Its average reflectance, if it is a conductor, is what the case
/// has as a transmittance: 1 where it is lossless.
template<class P>
class CompensatedMaterial {
public:
    explicit CompensatedMaterial(const MaterialCase& c)
        : material_(make_material<P>(c)),
          tables_(energy_tables(record_of(make_material<F32>(c)), ENERGY_AZIMUTHS)) {
        material_.distribution |= 1 << 1; // the first table
    }

    typename P::Vec3 gain(typename P::Vec3 wo) const {
        using Real = typename P::Real;
        auto place = energy_place(material_, wo);
        auto between = [&](int at) {
            return Real(tables_.at(at)) +
                   place.along_cosine * (Real(tables_.at(at + 1)) - Real(tables_.at(at)));
        };
        Real here = between(place.at), next = between(place.at + ENERGY_COSINES);
        return energy_gain(material_, here + place.along_azimuth * (next - here));
    }

private:
    typename P::Material material_;
    std::vector<float> tables_;
};

inline bool is_rough(int kind) { return (rough_materials >> kind) & 1; }

} // namespace parhelion::numerics
