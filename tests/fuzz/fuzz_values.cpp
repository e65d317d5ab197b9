// The values of a scene that are texts: colours, spectra, vectors, matrices, and the steps of a
// transform made of them.
#include "host/scene/mitsuba/spectrum.h"
#include "host/scene/mitsuba/transforms.h"
#include "property.h"
#include "targets.h"

#include <array>
#include <cmath>

namespace parhelion::fuzz {

namespace {

const SourceLocation place{"scene.xml", 1};

bool is_finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void read_rgb(std::string_view text) {
    promise(is_finite(mitsuba::parse_rgb(text, place).color), "colours are finite");
}

void convert(const mitsuba::SpectrumValue& spectrum) {
    using enum mitsuba::SpectrumUse;
    for (const mitsuba::SpectrumUse use : {reflectance, emission})
        static_cast<void>(mitsuba::to_rgb(spectrum, use));
}

void read_spectrum(std::string_view text) { convert(mitsuba::parse_spectrum(text, place)); }

void read_spectrum_file(std::string_view text) {
    convert(mitsuba::parse_spectrum_file(text, {"spectrum.spd", 0}));
}

void read_matrix(std::string_view text) {
    const glm::dmat4 matrix = mitsuba::parse_matrix(text, place);
    for (int column = 0; column < 4; ++column)
        promise(is_finite(glm::dvec3(matrix[column])), "matrices are finite");
}

/// The vector as an axis of rotation and as a target.
void read_vector(std::string_view text) {
    const glm::dvec3 v = mitsuba::parse_vector(text, "vector", place);
    promise(is_finite(v), "vectors are finite");
    const glm::dmat4 view = mitsuba::look_at(glm::dvec3(0.0), v, glm::dvec3(0, 0, 1), place);
    promise(is_finite(glm::dvec3(view[0])), "views are finite");
    static_cast<void>(mitsuba::rotation(v, v.x));
}

constexpr std::array readers{read_rgb, read_spectrum, read_spectrum_file, read_matrix, read_vector};

} // namespace

/// The first byte chooses the kind of value: '0' a colour, ... in the order of `readers`.
int fuzz_values(const std::uint8_t* data, std::size_t size) {
    if (size == 0 || data[0] < '0' || data[0] >= '0' + readers.size()) return 0;
    return answer_or_refusal([&] { readers[data[0] - '0'](as_text(data + 1, size - 1)); });
}

} // namespace parhelion::fuzz
