// Colours and spectra as a scene file writes them, and their linear sRGB equivalents.
#include "host/scene/mitsuba/spectrum.h"

#include "host/scene/mitsuba/cie_tables.h"
#include "host/scene/mitsuba/number_parameters.h"
#include "host/scene/text.h"

#include <fmt/format.h>

#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cmath>

namespace parhelion::mitsuba {

namespace {

constexpr std::string_view separators = ", \t\r\n";

double number_or_refuse(std::string_view text, const char* what, const SourceLocation& place) {
    const std::optional<double> value = parse_number(text);
    if (!value)
        refuse(place, std::string(what) + " " + in_quotes(text) + " is not a finite number");
    return *value;
}

/// IEC 61966-2-1 decoding.
double srgb_decode(double v) {
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

Rgb parse_hex_color(std::string_view digits, const SourceLocation& place) {
    const auto nibble = [&](char c) {
        if (c >= '0' && c <= '9') return c - '0';
        if (c >= 'a' && c <= 'f') return c - 'a' + 10;
        if (c >= 'A' && c <= 'F') return c - 'A' + 10;
        refuse(place, "colour " + in_quotes("#" + std::string(digits)) + " is not #rrggbb");
    };
    if (digits.size() != 6) nibble('?');
    Rgb color;
    for (int i = 0; i < 3; ++i)
        color[i] = srgb_decode((16 * nibble(digits[2 * i]) + nibble(digits[2 * i + 1])) / 255.0);
    return color;
}

void check_wavelengths(const SpectrumValue& spectrum, const SourceLocation& place) {
    const Domain& domain = number_parameter("spectrum", "value", "wavelength").domain;
    for (const double nm : spectrum.wavelengths)
        if (!placed(domain, nm))
            refuse(place, fmt::format("the wavelength {} of a spectrum (accepted: {})", nm,
                                      accepted_text(domain)));
    if (spectrum.wavelengths.size() < 2)
        refuse(place, "a spectrum needs at least two wavelength:value pairs");
    for (std::size_t i = 1; i < spectrum.wavelengths.size(); ++i)
        if (spectrum.wavelengths[i] <= spectrum.wavelengths[i - 1])
            refuse(place, "the wavelengths of a spectrum must increase");
}

/// Linear in a table with samples every 5 nm from 360 to 830 nm.
double table_lookup(const CieTable& table, double wavelength) {
    const double t = (wavelength - cie_first_nm) / cie_step_nm;
    const auto index = std::min(static_cast<std::size_t>(t), table.size() - 2);
    const double w = t - static_cast<double>(index);
    return table[index] * (1.0 - w) + table[index + 1] * w;
}

double evaluate(const SpectrumValue& spectrum, double wavelength) {
    const auto& nm = spectrum.wavelengths;
    if (wavelength < nm.front() || wavelength > nm.back()) return 0.0;
    const auto upper = std::upper_bound(nm.begin(), nm.end() - 1, wavelength);
    const auto i = static_cast<std::size_t>(upper - nm.begin());
    const double w = (wavelength - nm[i - 1]) / (nm[i] - nm[i - 1]);
    return spectrum.values[i - 1] * (1.0 - w) + spectrum.values[i] * w;
}

/// Tristimulus values; the observer is scaled so that the integral of its y curve is 1.
glm::dvec3 integrate(const SpectrumValue& spectrum, bool under_d65) {
    constexpr int steps = 1000;
    glm::dvec3 xyz(0.0);
    for (int i = 0; i < steps; ++i) {
        const double nm = cie_first_nm + (cie_last_nm - cie_first_nm) * i / (steps - 1);
        double value = evaluate(spectrum, nm);
        if (under_d65) value *= table_lookup(cie_d65, nm) * d65_scale;
        xyz += value * glm::dvec3(table_lookup(cie_x, nm), table_lookup(cie_y, nm),
                                  table_lookup(cie_z, nm));
    }
    return xyz * (cie_y_scale * (cie_last_nm - cie_first_nm) / steps);
}

/// ITU-R BT.709 primaries, D65 white.
Rgb xyz_to_srgb(const glm::dvec3& xyz) {
    return {3.240479 * xyz.x - 1.537150 * xyz.y - 0.498535 * xyz.z,
            -0.969256 * xyz.x + 1.875991 * xyz.y + 0.041556 * xyz.z,
            0.055648 * xyz.x - 0.204043 * xyz.y + 1.057311 * xyz.z};
}

} // namespace

RgbValue parse_rgb(std::string_view text, const SourceLocation& place) {
    const std::vector<std::string_view> parts = split(text, separators);
    if (parts.size() == 1 && parts[0][0] == '#')
        return {parse_hex_color(parts[0].substr(1), place)};
    if (parts.size() != 1 && parts.size() != 3)
        refuse(place, "<rgb> takes one or three values or #rrggbb, found " + in_quotes(text));
    Rgb color;
    for (int i = 0; i < 3; ++i)
        color[i] = number_or_refuse(parts[parts.size() == 1 ? 0 : i], "colour value", place);
    return {color};
}

RgbValue parse_srgb(std::string_view text, const SourceLocation& place) {
    RgbValue value = parse_rgb(text, place);
    if (text.find('#') != std::string_view::npos) return value;
    for (int i = 0; i < 3; ++i)
        value.color[i] = srgb_decode(value.color[i]);
    return value;
}

SpectrumValue blackbody(double kelvins) {
    constexpr double light_speed = 299792458.0, planck = 6.62607015e-34, boltzmann = 1.380649e-23;
    SpectrumValue result;
    for (double nm = cie_first_nm; nm <= cie_last_nm; nm += 1.0) {
        const double metres = nm * 1e-9;
        const double quantum = planck * light_speed / (metres * boltzmann * kelvins);
        const double per_metre =
            2.0 * planck * light_speed * light_speed / std::pow(metres, 5.0) / std::expm1(quantum);
        result.wavelengths.push_back(nm);
        result.values.push_back(per_metre * 1e-9);
    }
    return result;
}

SpectrumValue parse_spectrum(std::string_view text, const SourceLocation& place) {
    const std::vector<std::string_view> parts = split(text, separators);
    if (parts.empty()) refuse(place, "<spectrum> holds no value");
    SpectrumValue result;
    if (parts.size() == 1 && parts[0].find(':') == std::string_view::npos) {
        result.values.push_back(number_or_refuse(parts[0], "spectrum value", place));
        return result;
    }
    for (const std::string_view part : parts) {
        const std::size_t colon = part.find(':');
        if (colon == std::string_view::npos)
            refuse(place, "spectrum value " + in_quotes(part) +
                              " is not a wavelength:value pair (accepted: one value, or pairs; a "
                              "colour of three values is an <rgb>)");
        result.wavelengths.push_back(number_or_refuse(part.substr(0, colon), "wavelength", place));
        result.values.push_back(number_or_refuse(part.substr(colon + 1), "spectrum value", place));
    }
    check_wavelengths(result, place);
    return result;
}

SpectrumValue parse_spectrum_file(std::string_view content, const SourceLocation& place) {
    SpectrumValue result;
    SourceLocation line_place = place;
    line_place.line = 0;
    for (std::size_t start = 0; start < content.size();) {
        const std::size_t end = std::min(content.find('\n', start), content.size());
        std::string_view line = content.substr(start, end - start);
        line = line.substr(0, line.find('#'));
        start = end + 1;
        ++line_place.line;
        const std::vector<std::string_view> parts = split(line, " \t\r");
        if (parts.empty()) continue;
        if (parts.size() != 2)
            refuse(line_place, "expected a wavelength and a value, found " + in_quotes(line));
        result.wavelengths.push_back(number_or_refuse(parts[0], "wavelength", line_place));
        result.values.push_back(number_or_refuse(parts[1], "spectrum value", line_place));
    }
    check_wavelengths(result, {place.file, 0});
    return result;
}

ConvertedSpectrum to_rgb(const SpectrumValue& spectrum, SpectrumUse use) {
    const bool emission = use == SpectrumUse::emission;
    if (spectrum.wavelengths.empty()) {
        const double value = spectrum.values.front();
        return {emission ? value * xyz_to_srgb(glm::dvec3(1.0)) : Rgb(value), false};
    }
    const Rgb color = xyz_to_srgb(integrate(spectrum, !emission));
    const double top = use == SpectrumUse::reflectance ? 1.0 : std::numeric_limits<double>::max();
    const Rgb inside = glm::clamp(color, Rgb(0.0), Rgb(top));
    return {inside, inside != color};
}

} // namespace parhelion::mitsuba
