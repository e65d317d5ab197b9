// Names of features, and a set of them as the compiler of the kernels gets it.
#include "host/feature_set.h"

#include "host/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace parhelion {
namespace {

#define MATERIAL_NAME(name, ...) "bsdf_" #name,
#define EMITTER_NAME(name, ...) "emitter_" #name,
#define GEOMETRY_NAME(name) "shape_" #name,
#define TEXTURE_NAME(name, ...) "texture_" #name,
#define OTHER_NAME(name) #name,
/// In the order of enum Feature.
constexpr std::array feature_names{MATERIALS(MATERIAL_NAME) EMITTERS(EMITTER_NAME) GEOMETRIES(
    GEOMETRY_NAME) TEXTURES(TEXTURE_NAME) OTHER_FEATURES(OTHER_NAME)};
static_assert(feature_names.size() == feature_count);

} // namespace

const char* feature_name(Feature f) { return feature_names[f]; }

std::vector<std::string> FeatureSet::names() const {
    std::vector<std::string> names;
    for (int f = 0; f < feature_count; f++)
        if (has(static_cast<Feature>(f))) names.emplace_back(feature_names[f]);
    return names;
}

FeatureSet FeatureSet::of(const std::vector<std::string>& names) {
    FeatureSet features;
    for (const std::string& name : names) {
        auto found = std::find(feature_names.begin(), feature_names.end(), name);
        if (found == feature_names.end())
            throw InputError(fmt::format("'{}' is no feature of kernels; there are {}", name,
                                         fmt::join(feature_names, " ")));
        features.set(static_cast<Feature>(found - feature_names.begin()));
    }
    return features;
}

std::string FeatureSet::definitions() const {
    std::string text;
    for (std::size_t k = 0; k < word_count; k++)
        text += fmt::format("{}-DFEATURES_{}=0x{:x}ul", k > 0 ? " " : "", k, words_[k]);
    return text;
}

} // namespace parhelion
