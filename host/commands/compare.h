// `parhelion compare`: two images, their differences, and whether those are within limits.
#pragma once

#include "host/commands/command_line.h"
#include "host/image/comparison.h"

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace parhelion {

struct CompareOptions {
    std::string image, reference;
    ComparisonOptions figures;
    bool json = false;
    bool common = false; ///< a channel that one image alone has is no difference

    /// Largest values accepted; absent: reported, not judged.
    std::optional<double> rmse, relmse, mae, bias, max, flip;

    std::string difference_file, flip_file; ///< pictures to write; empty: none
    bool force = false;                     ///< they may replace files

    std::string variance; ///< file of per-sample variances, or own_variance; empty: no z-test
    bool xyz_statistics = false;
    std::optional<double> samples; ///< per pixel of the image; absent: its own layer's
    ZTestOptions test;
};

/// Compares, prints the report and returns the exit code: ok where everything asked for is within
/// its limit (or no limit was given), different where not, where one image alone has a channel, or
/// where the figures show no difference and another channel does. Throws InputError (exit code
/// bad_input) for files that cannot be compared or written; nothing has been printed then.
int run_compare(const CompareOptions& options, std::ostream& out);

/// The options of `compare`, which write to `options`.
std::vector<Option> compare_options(CompareOptions& options);

/// Throws InputError for what cannot be, whatever the images.
void check_options(const CompareOptions& options);

/// Its run prints to standard output.
Subcommand compare_subcommand();

} // namespace parhelion
