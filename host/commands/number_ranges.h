// Many numbers in one text of the command line: frames, and values of a sweep.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace parhelion {

/// Of one list, and of all lists together.
inline constexpr std::size_t most_renders = 100'000;

/// The frames of "7", "1-10", "1,3,7-20", "1-100x10" (every tenth), "10-1" (the last first),
/// "-5-5", in their order. Throws InputError for another text, a frame twice, one of more than nine
/// digits, or too many.
std::vector<std::int64_t> parse_frames(const std::string& text);

/// The values of "from:step:to", as "0:10:90", "0:0.1:1" or "90:-10:0": from and all that lie whole
/// steps further on and not beyond to, without rounding, written as short as they can be. Nothing
/// for a text that is not three numbers: it is no sweep. Throws InputError, with `name` before it,
/// for one that has no value, too many, or more digits than can be counted with.
std::vector<std::string> parse_sweep(const std::string& name, const std::string& text);

} // namespace parhelion
