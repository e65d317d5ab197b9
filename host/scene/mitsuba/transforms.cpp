// The elements inside <transform>, each as a 4x4 matrix.
#include "host/scene/mitsuba/transforms.h"

#include "host/scene/mitsuba/number_parameters.h"
#include "host/scene/text.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace parhelion::mitsuba {

namespace {

constexpr std::string_view separators = ", \t\r\n";

bool is_finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// `v`, made longer or shorter where its square would be no number.
glm::dvec3 of_usual_length(const glm::dvec3& v) {
    const double length = glm::length(v);
    if (length > 1e-150 && length < 1e150) return v;
    const glm::dvec3 size = glm::abs(v);
    return v / std::max({size.x, size.y, size.z});
}

/// A finite number in the domain that the element has for it.
double step_number(std::string_view part, const char* element, const char* attribute,
                   const SourceLocation& place) {
    const Domain& domain = step_domain(element, attribute);
    std::optional<double> value = parse_number(part);
    if (value) value = placed(domain, *value);
    if (!value)
        refuse(place, std::string("<") + element + ">: " + in_quotes(part) +
                          " (accepted: " + accepted_text(domain) + ")");
    return *value;
}

/// Whether the last row is 0 0 0 1 but for the rounding of single precision, in which programs
/// write matrices: of each entry relative to the largest of its column.
bool is_affine(const glm::dmat4& m) {
    constexpr double rounding = 1e-6;
    for (int column = 0; column < 3; ++column) {
        const glm::dvec3 above = glm::abs(glm::dvec3(m[column]));
        const double size = std::max({above.x, above.y, above.z});
        if (!(std::abs(m[column][3]) <= rounding * size)) return false;
    }
    return std::abs(m[3][3] - 1.0) <= rounding;
}

/// Some unit vector perpendicular to the unit vector `n` (Duff et al. 2017).
glm::dvec3 perpendicular(const glm::dvec3& n) {
    const double sign = std::copysign(1.0, n.z);
    const double a = -1.0 / (sign + n.z);
    return {1.0 + sign * n.x * n.x * a, sign * n.x * n.y * a, -sign * n.x};
}

} // namespace

glm::dvec3 unit_vector(const glm::dvec3& v) { return glm::normalize(of_usual_length(v)); }

glm::dmat4 rotation(const glm::dvec3& axis, double degrees) {
    // Quarter turns are common in hand-written scenes and should be exact.
    const double turn = std::remainder(degrees, 360.0);
    if (std::remainder(turn, 90.0) != 0.0)
        return glm::rotate(glm::dmat4(1.0), glm::radians(turn), of_usual_length(axis));
    const double c = turn == 0.0 ? 1.0 : std::abs(turn) == 180.0 ? -1.0 : 0.0;
    const double s = c != 0.0 ? 0.0 : std::copysign(1.0, turn);
    const glm::dvec3 a = unit_vector(axis);
    const glm::dmat3 cross(0, a.z, -a.y, -a.z, 0, a.x, a.y, -a.x, 0);
    const glm::dmat3 outer = glm::outerProduct(a, a);
    return glm::dmat4(glm::dmat3(1.0) * c + cross * s + outer * (1.0 - c));
}

glm::dmat4 look_at(const glm::dvec3& origin, const glm::dvec3& target, const glm::dvec3& up,
                   const SourceLocation& place) {
    const glm::dvec3 forward = unit_vector(target - origin);
    if (!is_finite(forward)) refuse(place, "<lookat>: origin and target are the same point");
    const bool free_up = up == glm::dvec3(0.0);
    const glm::dvec3 left = free_up ? glm::cross(perpendicular(forward), forward)
                                    : unit_vector(glm::cross(unit_vector(up), forward));
    if (!is_finite(left)) refuse(place, "<lookat>: up is parallel to the direction of view");
    const glm::dvec3 true_up = glm::cross(forward, left);
    return {glm::dvec4(left, 0), glm::dvec4(true_up, 0), glm::dvec4(forward, 0),
            glm::dvec4(origin, 1)};
}

glm::dmat4 parse_matrix(std::string_view text, const SourceLocation& place) {
    const std::vector<std::string_view> parts = split(text, separators);
    if (parts.size() != 9 && parts.size() != 16)
        refuse(place, "<matrix> takes 9 or 16 values, found " + std::to_string(parts.size()));
    const std::size_t side = parts.size() == 9 ? 3 : 4;
    glm::dmat4 result(1.0);
    for (std::size_t row = 0; row < side; ++row)
        for (std::size_t column = 0; column < side; ++column) {
            const std::string_view part = parts[row * side + column];
            result[column][row] = step_number(part, "matrix", "value", place);
        }
    if (!is_affine(result))
        refuse(place, "the last row of a <matrix> must be 0 0 0 1, to the rounding of single "
                      "precision");
    for (int column = 0; column < 4; ++column)
        result[column][3] = column == 3 ? 1.0 : 0.0;
    return result;
}

glm::dvec3 parse_vector(std::string_view text, const char* what, const SourceLocation& place) {
    const std::vector<std::string_view> parts = split(text, separators);
    if (parts.size() != 3)
        refuse(place, std::string(what) + " takes three values, found " + in_quotes(text));
    glm::dvec3 result;
    for (int i = 0; i < 3; ++i) {
        const std::optional<double> value = parse_number(parts[i]);
        if (!value)
            refuse(place,
                   std::string(what) + " " + in_quotes(parts[i]) + " is not a finite number");
        result[i] = *value;
    }
    return result;
}

} // namespace parhelion::mitsuba
