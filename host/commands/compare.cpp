// Options, limits and the two reports (table and JSON) of `parhelion compare`.
#include "host/commands/compare.h"

#include "host/error.h"
#include "host/image/exr.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <memory>

namespace parhelion {

namespace {

using nlohmann::ordered_json;

// -------------------------------------------------------------------------------------------
// limits

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

struct Judgement {
    const LimitKind* kind;
    double limit, measured;

    bool pass() const { return measured <= limit; }
};

std::vector<Judgement> judge(const CompareOptions& options, const Comparison& comparison) {
    std::vector<Judgement> judgements;
    for (const LimitKind& kind : limit_kinds) {
        const std::optional<double>& limit = options.*kind.limit;
        if (limit) judgements.push_back({&kind, *limit, kind.measure(comparison)});
    }
    return judgements;
}

bool all_pass(const Comparison& comparison, const std::vector<Judgement>& judgements) {
    const bool limits = std::all_of(judgements.begin(), judgements.end(),
                                    [](const Judgement& judgement) { return judgement.pass(); });
    const auto& test = comparison.z_test;
    return limits && (!test || (test->pixels_pass && test->means_pass));
}

// ------------------------------------------------------------------------------------- human
// report

constexpr const char* flip_note = "LDR, exposure 0, linear values clamped to [0, 1]";

std::string verdict(bool pass) { return pass ? "pass" : "FAIL"; }

void print_figures(std::ostream& out, const Comparison& comparison) {
    struct Row {
        std::string name;
        double (*value)(const ErrorFigures&);
    };
    const Metrics& metrics = comparison.metrics;
    const std::array<Row, 7> rows{{
        {"RMSE", [](const ErrorFigures& f) { return f.rmse; }},
        {fmt::format("relMSE (epsilon {:g})", metrics.epsilon),
         [](const ErrorFigures& f) { return f.relmse; }},
        {"MAE", [](const ErrorFigures& f) { return f.mae; }},
        {"mean of A", [](const ErrorFigures& f) { return f.mean_image; }},
        {"mean of B", [](const ErrorFigures& f) { return f.mean_reference; }},
        {"bias (A - B)", [](const ErrorFigures& f) { return f.bias(); }},
        {"relative bias", [](const ErrorFigures& f) { return f.relative_bias(); }},
    }};
    out << fmt::format("{:<24}", "");
    for (const std::string& name : comparison.channels)
        out << fmt::format("{:>14}", name);
    out << fmt::format("{:>14}\n", "all");
    for (const Row& row : rows) {
        out << fmt::format("{:<24}", row.name);
        for (const ErrorFigures& figures : metrics.channels)
            out << fmt::format("{:>14.6g}", row.value(figures));
        out << fmt::format("{:>14.6g}\n", row.value(metrics.all));
    }
}

void print_z_test(std::ostream& out, const ZTest& test, const CompareOptions& options,
                  std::size_t negative_variances) {
    const PixelTest& pixels = test.pixels;
    out << fmt::format("{:<24}{:.4f} % of {} values have p > {:.3g}, {:g} % needed: {}\n",
                       "z-test of pixels", 100.0 * pixels.fraction(), pixels.values, pixels.alpha,
                       100.0 * options.test.required_fraction, verdict(test.pixels_pass));
    out << fmt::format("{:<24}{:.4g} at {},{} in {}\n", "  largest |z|", pixels.largest.value,
                       pixels.largest.x, pixels.largest.y, pixels.largest.channel);
    for (const MeanTest& mean : test.means)
        out << fmt::format("{:<24}{:.6g} +- {:.3g}, z {:.3f}, p {:.3g}, more than {:.3g} needed: "
                           "{}\n",
                           "z-test of mean " + mean.channel, mean.difference, mean.standard_error,
                           mean.z, mean.p, test.mean_alpha, verdict(mean.p > test.mean_alpha));
    out << fmt::format("{:<24}{:g} samples a pixel; B {}; independent pixels; variance floor {:g} "
                       "(pixels alone){}\n",
                       "  assumed", options.test.samples,
                       options.test.reference_samples
                           ? fmt::format("{:g} samples", *options.test.reference_samples)
                           : std::string("exact"),
                       options.test.variance_floor,
                       options.xyz_statistics ? "; tested as XYZ" : "");
    if (negative_variances > 0)
        out << fmt::format("{:<24}{} variances are below zero\n", "  note", negative_variances);
}

void print_report(std::ostream& out, const CompareOptions& options, const Comparison& comparison,
                  const std::vector<Judgement>& judgements) {
    out << fmt::format("A  {}\nB  {} (reference)\n{}x{} pixels, linear values as stored\n\n",
                       options.image, options.reference, comparison.width, comparison.height);
    print_figures(out, comparison);
    const LargestError& largest = comparison.metrics.largest;
    out << fmt::format("\n{:<24}{:.6g} at {},{} in {}\n", "largest error", largest.value, largest.x,
                       largest.y, largest.channel);
    if (comparison.flip)
        out << fmt::format("{:<24}{:.6f}, largest {:.4f} ({}, {:.2f} pixels per degree)\n", "FLIP",
                           comparison.flip->mean, comparison.flip->largest, flip_note,
                           options.figures.pixels_per_degree);
    else
        out << fmt::format("{:<24}not defined without R, G, B or with values not finite\n", "FLIP");
    if (comparison.non_finite.equal > 0)
        out << fmt::format("{:<24}{} values, the same in both, left out\n", "not finite",
                           comparison.non_finite.equal);
    if (comparison.z_test)
        print_z_test(out, *comparison.z_test, options, comparison.negative_variances);
    for (const Judgement& judgement : judgements)
        out << fmt::format("{:<24}{:.6g}, limit {:g}: {}\n",
                           fmt::format("limit on {}", judgement.kind->name), judgement.measured,
                           judgement.limit, verdict(judgement.pass()));
    if (comparison.identical) out << "every value is the same\n";
}

// -------------------------------------------------------------------------------------- JSON
// report

ordered_json to_json(const ErrorFigures& figures) {
    return {{"rmse", figures.rmse},
            {"relmse", figures.relmse},
            {"mae", figures.mae},
            {"mean_image", figures.mean_image},
            {"mean_reference", figures.mean_reference},
            {"bias", figures.bias()},
            {"bias_relative", figures.relative_bias()}};
}

ordered_json to_json(const LargestError& largest) {
    return {{"value", largest.value},
            {"channel", largest.channel},
            {"x_px", largest.x},
            {"y_px", largest.y}};
}

ordered_json to_json(const ZTest& test, const CompareOptions& options,
                     std::size_t negative_variances) {
    ordered_json means = ordered_json::array();
    for (const MeanTest& mean : test.means)
        means.push_back({{"channel", mean.channel},
                         {"difference", mean.difference},
                         {"standard_error", mean.standard_error},
                         {"z", mean.z},
                         {"p", mean.p},
                         {"pass", mean.p > test.mean_alpha}});
    ordered_json reference_samples = nullptr;
    if (options.test.reference_samples) reference_samples = *options.test.reference_samples;
    return {
        {"samples_per_pixel", options.test.samples},
        {"reference_samples_per_pixel", reference_samples},
        {"alpha", options.test.alpha},
        {"variance_floor", options.test.variance_floor},
        {"xyz_statistics", options.xyz_statistics},
        {"negative_variances", negative_variances},
        {"pixels",
         {{"values", test.pixels.values},
          {"passed", test.pixels.passed},
          {"passed_fraction", test.pixels.fraction()},
          {"required_fraction", options.test.required_fraction},
          {"alpha_per_value", test.pixels.alpha},
          {"largest_z", to_json(test.pixels.largest)},
          {"pass", test.pixels_pass}}},
        {"mean",
         {{"alpha_per_channel", test.mean_alpha}, {"channels", means}, {"pass", test.means_pass}}}};
}

ordered_json to_json(const CompareOptions& options, const Comparison& comparison,
                     const std::vector<Judgement>& judgements) {
    ordered_json channels = ordered_json::array();
    for (std::size_t c = 0; c < comparison.channels.size(); ++c) {
        ordered_json entry{{"channel", comparison.channels[c]}};
        entry.update(to_json(comparison.metrics.channels[c]));
        channels.push_back(entry);
    }
    ordered_json limits = ordered_json::array();
    for (const Judgement& judgement : judgements)
        limits.push_back({{"figure", judgement.kind->name},
                          {"limit", judgement.limit},
                          {"measured", judgement.measured},
                          {"pass", judgement.pass()}});
    ordered_json flip = nullptr;
    if (comparison.flip)
        flip = {{"mean", comparison.flip->mean},
                {"largest", comparison.flip->largest},
                {"pixels_per_degree", options.figures.pixels_per_degree},
                {"exposure_stops", 0},
                {"kind", flip_note}};
    ordered_json z_test = nullptr;
    if (comparison.z_test)
        z_test = to_json(*comparison.z_test, options, comparison.negative_variances);
    return {{"image_file", options.image},
            {"reference_file", options.reference},
            {"layer", options.figures.layer},
            {"width_px", comparison.width},
            {"height_px", comparison.height},
            {"value_unit", "linear, as stored"},
            {"identical", comparison.identical},
            {"non_finite_equal_values", comparison.non_finite.equal},
            {"relmse_epsilon", comparison.metrics.epsilon},
            {"all", to_json(comparison.metrics.all)},
            {"channels", channels},
            {"max_error", to_json(comparison.metrics.largest)},
            {"flip", flip},
            {"z_test", z_test},
            {"limits", limits},
            {"pass", all_pass(comparison, judgements)}};
}

// ------------------------------------------------------------------------------------------
// options

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
    if (options.json)
        // A file name need not be UTF-8.
        out << to_json(options, comparison, judgements)
                   .dump(2, ' ', false, ordered_json::error_handler_t::replace)
            << "\n";
    else
        print_report(out, options, comparison, judgements);
    return static_cast<int>(all_pass(comparison, judgements) ? ExitCode::ok : ExitCode::different);
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
