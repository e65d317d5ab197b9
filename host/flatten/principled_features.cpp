// Which lobes of Burley's materials a scene needs.
#include "host/flatten/principled_features.h"

#include "host/flatten/feature_counts.h"
#include "host/flatten/material_records.h"

namespace parhelion {

void decide_principled_features(const DeviceScene& records, FeatureDecisions& out) {
    auto decide = [&](Feature f, auto needs) {
        decide_by_count(out, f, records.materials, "materials", needs);
    };
    decide(feature_clearcoat, [](const MaterialRecord& m) {
        return m.kind == material_principled && CLEARCOAT(m) != 0.f;
    });
    decide(feature_spec_trans,
           [](const MaterialRecord& m) { return is_principled(m) && SPEC_TRANS(m) != 0.f; });
    decide(feature_sheen,
           [](const MaterialRecord& m) { return is_principled(m) && SHEEN(m) != 0.f; });
}

} // namespace parhelion
