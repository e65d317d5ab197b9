// Digests of what a render is made from.
#include "host/digest.h"

#include "host/error.h"

#include <fmt/format.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <array>
#include <fstream>
#include <memory>

namespace parhelion {
namespace {

std::string text_of(XXH128_hash_t hash) {
    return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

} // namespace

std::string digest_of(std::string_view bytes) {
    return text_of(XXH3_128bits(bytes.data(), bytes.size()));
}

std::string digest_of_file(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(),
                                                                         &XXH3_freeState);
    XXH3_128bits_reset(state.get());
    std::vector<char> part(std::size_t{1} << 20);
    while (in) {
        in.read(part.data(), static_cast<std::streamsize>(part.size()));
        XXH3_128bits_update(state.get(), part.data(), static_cast<std::size_t>(in.gcount()));
    }
    if (!in.eof()) throw InputError(file.string() + ": cannot be read");
    return text_of(XXH3_128bits_digest(state.get()));
}

std::uint64_t checksum_of(std::span<const std::uint32_t> words, std::uint64_t said) {
    return XXH3_64bits_withSeed(words.data(), words.size_bytes(), said);
}

} // namespace parhelion
