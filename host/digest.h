// Digests of what a render is made from: two that differ are of different contents, two that are
// the same of the same ones (128 bits of XXH3; nobody who wants to deceive is kept out).
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace parhelion {

/// 32 hexadecimal digits.
std::string digest_of(std::string_view bytes);
/// Of a file's bytes. Throws InputError where it cannot be read.
std::string digest_of_file(const std::filesystem::path& file);

/// Against damage, of the words and of what is said of them.
std::uint64_t checksum_of(std::span<const std::uint32_t> words, std::uint64_t said = 0);

} // namespace parhelion
