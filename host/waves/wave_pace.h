// How large a wave may be, by how long the launches of those before it took.
#pragma once

namespace parhelion {

/// No launch is to take longer, seconds: a screen that the device draws as well stands still
/// meanwhile, and drivers end what takes seconds.
inline constexpr double longest_launch = 0.1;

/// The limit that a render begins with, blocks times samples: of a device nothing is known yet.
int first_wave_limit(int most);

/// The limit after a wave of `wave` blocks times samples whose longest launch took so many seconds
/// (0: not known): less, where that is near `longest_launch` or above; more, four times the wave at
/// most, where it leaves room. 1 to `most`; of waves under way at once each is told of when it
/// ends.
int next_wave_limit(int limit, int most, int wave, double seconds);

} // namespace parhelion
