// Cryptomatte 1.2 (Friedman and Jones, "Fully automatic ID mattes with support for motion blur and
// transparency", 2015, and Psyop's specification): of every pixel the names that cover it, as
// hashes, with how much of it each covers, the largest first.
#pragma once

#include "host/film/film_sums.h"
#include "host/image/image.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace parhelion {

struct Scene;

inline constexpr int most_cryptomatte_depth = 64;

/// What a layer calls the shapes of a scene.
struct CryptomatteLayer {
    std::string name;               ///< CryptoObject
    std::vector<std::string> names; ///< of each shape
};

struct Cryptomatte {
    int depth = 6; ///< names that are kept of a pixel, at most
    std::vector<CryptomatteLayer> layers;
};

/// What the scene's integrator asks for. Throws InputError for another layer whose name is taken.
Cryptomatte cryptomatte_of(const Scene& scene);

/// MurmurHash3 (x86, 32 bits) of a text, seed 0.
std::uint32_t murmur_hash(std::string_view text);

/// The hash of a name as the bits of a float that is a number: never 0, infinite or subnormal.
std::uint32_t cryptomatte_id(std::string_view name);

/// Names of the channels' layers: <name>00, <name>01, ..., each with two names of a pixel in R, G
/// and B, A.
std::vector<std::string> channel_layers(const CryptomatteLayer& layer, int depth);

/// Adds what the header of a picture says of all layers.
void add_cryptomatte_header(const Cryptomatte& cryptomatte, Image& image);

/// Adds the channels of all layers to an image of the crop's rows from `first_row` on.
void add_cryptomatte(const FilmSums& sums, const Cryptomatte& cryptomatte, int first_row,
                     Image& image);

} // namespace parhelion
