// Colours and spectra as a scene file writes them, and their linear sRGB equivalents.
#pragma once

#include "host/scene/scene.h"

#include <string_view>
#include <vector>

namespace parhelion::mitsuba {

struct RgbValue {
    Rgb color{0.0};
};

/// One value for all wavelengths (`wavelengths` empty), or values at increasing wavelengths in
/// nanometres, linear between them and zero outside.
struct SpectrumValue {
    std::vector<double> wavelengths;
    std::vector<double> values;
};

/// What a spectrum stands for decides its conversion.
enum class SpectrumUse {
    reflectance, ///< seen under D65, within [0, 1]
    unbounded,   ///< seen under D65, no upper bound (indices of refraction)
    emission,    ///< a light's own spectrum: a constant one is not white in sRGB
};

struct ConvertedSpectrum {
    Rgb color;
    bool clamped = false; ///< the colour lies outside sRGB and was moved to its border
};

/// Reads "1", "1 0.5 0.2" or "#rrggbb" (sRGB-encoded bytes). Throws InputError at `place`.
RgbValue parse_rgb(std::string_view text, const SourceLocation& place);

/// The same with numbers that are sRGB-encoded as well, as <srgb> of Mitsuba 0.x has them. Throws
/// InputError at `place`.
RgbValue parse_srgb(std::string_view text, const SourceLocation& place);

/// Radiance of a black body at `kelvins` by Planck's law, in W/(m^2 sr nm).
SpectrumValue blackbody(double kelvins);

/// Reads "0.5" or "400:0.1, 500:0.7, ...". Throws InputError at `place`.
SpectrumValue parse_spectrum(std::string_view text, const SourceLocation& place);

/// Reads the lines "wavelength value" of an .spd file; `#` starts a comment. Throws InputError.
SpectrumValue parse_spectrum_file(std::string_view content, const SourceLocation& place);

/// Linear sRGB by the CIE 1931 2-degree observer, sampled as Mitsuba's RGB mode samples it (1000
/// points from 360 to 830 nm) so that both agree.
ConvertedSpectrum to_rgb(const SpectrumValue& spectrum, SpectrumUse use);

} // namespace parhelion::mitsuba
