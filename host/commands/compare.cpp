// The options and the verdict of `parhelion compare`.
#include "host/commands/compare.h"

#include "host/commands/compare_report.h"
#include "host/error.h"
#include "host/image/exr.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <memory>

namespace parhelion {

namespace {

// ---- limits

/// Largest |relative bias| of a channel.
double worst_bias(const Comparison& comparison) {
    double worst = 0.0;
    for (const ErrorFigures& figures : comparison.metrics.channels)
        worst = std::max(worst, std::abs(figures.relative_bias()));
    return worst;
}

/// A figure that can be limited: the one list of them, for options, judgement and reports.
struct LimitKind {
    const char* name; ///< option without dashes, key in the JSON report
    const char* help;
    std::optional<double> CompareOptions::*limit;
    double (*measure)(const Comparison&);
};

const std::array<LimitKind, 6> limit_kinds{{
    {"rmse", "Largest RMSE over all channels", &CompareOptions::rmse,
     [](const Comparison& c) { return c.metrics.all.rmse; }},
    {"relmse", "Largest relMSE over all channels", &CompareOptions::relmse,
     [](const Comparison& c) { return c.metrics.all.relmse; }},
    {"mae", "Largest mean absolute error over all channels", &CompareOptions::mae,
     [](const Comparison& c) { return c.metrics.all.mae; }},
    {"bias", "Largest |mean A - mean B| / |mean B| of any channel (0.005 is 0.5 %)",
     &CompareOptions::bias, worst_bias},
    {"max", "Largest difference of any value", &CompareOptions::max,
     [](const Comparison& c) { return c.metrics.largest.value; }},
    {"flip", "Largest mean LDR-FLIP, 0 to 1", &CompareOptions::flip,
     [](const Comparison& c) { return c.flip.value().mean; }},
}};

std::vector<Judgement> judge(const CompareOptions& options, const Comparison& comparison) {
    std::vector<Judgement> judgements;
    for (const LimitKind& kind : limit_kinds) {
        const std::optional<double>& limit = options.*kind.limit;
        if (limit) judgements.push_back({kind.name, *limit, kind.measure(comparison)});
    }
    return judgements;
}

bool all_pass(const Comparison& comparison, const std::vector<Judgement>& judgements) {
    const bool limits = std::all_of(judgements.begin(), judgements.end(),
                                    [](const Judgement& judgement) { return judgement.pass(); });
    const auto& test = comparison.z_test;
    return limits && (!test || (test->pixels_pass && test->means_pass));
}

// ---- options

void check(bool good, const std::string& option, const std::string& accepted) {
    if (!good) throw InputError("command line: " + option + " must be " + accepted);
}

bool positive(double value) { return std::isfinite(value) && value > 0.0; }
bool not_negative(double value) { return std::isfinite(value) && value >= 0.0; }

void check_options(const CompareOptions& options) {
    for (const LimitKind& kind : limit_kinds)
        if (const std::optional<double>& limit = options.*kind.limit)
            check(not_negative(*limit), std::string("--") + kind.name, "a number, 0 or more");
    check(not_negative(options.figures.epsilon), "--epsilon", "a number, 0 or more");
    check(positive(options.figures.pixels_per_degree), "--ppd", "a number above 0");
    // Larger ones only make filters that no image is large enough for.
    check(options.figures.pixels_per_degree <= 10000.0, "--ppd", "at most 10000");
    check(positive(options.test.samples), "--spp", "a number above 0");
    check(positive(options.test.reference_samples.value_or(1.0)), "--reference-spp",
          "a number above 0");
    check(options.test.alpha > 0.0 && options.test.alpha < 1.0, "--alpha", "between 0 and 1");
    check(not_negative(options.test.variance_floor), "--variance-floor", "a number, 0 or more");
}

void add_z_test_options(CLI::App& command, CompareOptions& options) {
    CLI::Option* variance = command.add_option(
        "--variance", options.variance,
        "EXR with the variance of one sample of each pixel: z-tests of the pixels and the mean");
    CLI::Option* samples =
        command.add_option("--spp", options.test.samples, "Samples per pixel of A");
    variance->needs(samples);
    samples->needs(variance);
    command
        .add_option("--reference-spp", options.test.reference_samples,
                    "Samples per pixel of B (default: B is exact)")
        ->needs(variance);
    command
        .add_option("--alpha", options.test.alpha,
                    "Chance to fail an image that is right, for each of the two z-tests")
        ->needs(variance)
        ->capture_default_str();
    command
        .add_option("--variance-floor", options.test.variance_floor,
                    "Least variance in the z-test of the pixels")
        ->needs(variance)
        ->capture_default_str();
    command
        .add_flag("--xyz-statistics", options.xyz_statistics,
                  "B and the variance hold XYZ statistics as RGB (Mitsuba's test references): "
                  "test in XYZ")
        ->needs(variance);
}

} // namespace

int run_compare(const CompareOptions& options, std::ostream& out) {
    check_options(options);
    const Image image = read_exr(options.image), reference = read_exr(options.reference);
    Image variance;
    std::optional<VarianceInput> variance_input;
    if (!options.variance.empty()) {
        variance = read_exr(options.variance);
        variance_input.emplace(
            VarianceInput{{options.variance, variance}, options.xyz_statistics, options.test});
    }
    const Comparison comparison = compare_images(
        {options.image, image}, {options.reference, reference}, options.figures, variance_input);
    if (options.flip && !comparison.flip)
        throw InputError(options.image + ": --flip needs R, G and B with finite values");
    const std::vector<Judgement> judgements = judge(options, comparison);
    const bool pass = all_pass(comparison, judgements);
    if (options.json)
        out << comparison_json(options, comparison, judgements, pass) << "\n";
    else
        print_comparison(out, options, comparison, judgements);
    return static_cast<int>(pass ? ExitCode::ok : ExitCode::different);
}

void add_compare_command(CLI::App& app, int& exit_code) {
    CLI::App* command = app.add_subcommand(
        "compare", "Compare two EXR images; exit code 0 within the limits given (or none given), "
                   "1 not, 2 unusable input");
    const auto options = std::make_shared<CompareOptions>();
    command->add_option("A", options->image, "Image (.exr)")->required();
    command->add_option("B", options->reference, "Reference (.exr)")->required();
    command->add_flag("--json", options->json, "Report as one JSON object");
    command->add_option("--layer", options->figures.layer,
                        "Compare the channels NAME.* instead of the main layer");
    command
        ->add_option("--epsilon", options->figures.epsilon,
                     "relMSE is the mean of (A - B)^2 / (B^2 + epsilon)")
        ->capture_default_str();
    command->add_option("--ppd", options->figures.pixels_per_degree, "FLIP's pixels per degree")
        ->capture_default_str();
    for (const LimitKind& kind : limit_kinds)
        command->add_option(std::string("--") + kind.name, (*options).*kind.limit, kind.help);
    add_z_test_options(*command, *options);
    command->callback([options, &exit_code] { exit_code = run_compare(*options, std::cout); });
}

} // namespace parhelion
