// One random scene, rendered in every way there is.
#pragma once

#include "host/feature_set.h"
#include "tests/random_scenes/random_scene.h"

#include <filesystem>
#include <set>
#include <string>

namespace parhelion::test {

enum class Verdict { rendered, on_device_too, refused, failed };

struct Outcome {
    Verdict verdict;
    std::string text; ///< why it was refused, or what is wrong; one line
};

/// What scenes may cost: each set of features is a program, which takes seconds to compile.
struct TrialOptions {
    std::filesystem::path folder;  ///< for the scene's files; exists
    std::size_t most_programs = 0; ///< beyond so many sets of features, scenes keep to the host
};

/// Loads and renders on the host, in single and double precision, and on the device. It fails where
/// device and host differ in a bit, a value is not finite and nobody is told when it is written, or
/// anything but a refusal is thrown. `programs`: sets of features so far.
Outcome try_scene(const RandomScene& scene, const TrialOptions& options,
                  std::set<parhelion::FeatureSet>& programs);

} // namespace parhelion::test
