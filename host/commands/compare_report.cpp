// The table and the JSON object `parhelion compare` prints.
#include "host/commands/compare_report.h"

#include "host/json_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <ostream>

namespace parhelion {

namespace {

using nlohmann::ordered_json;

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

std::string variances_of(const CompareOptions& options) {
    if (!options.samples) return "the images' own variances";
    const std::optional<double>& reference = options.test.reference_samples;
    return fmt::format("{:g} samples a pixel; B {}", *options.samples,
                       reference ? fmt::format("{:g} samples", *reference) : "exact");
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
    out << fmt::format("{:<24}{}; independent pixels and samples; variance floor {:g} (pixels "
                       "alone){}\n",
                       "  assumed", variances_of(options), options.test.variance_floor,
                       options.xyz_statistics ? "; tested as XYZ" : "");
    if (negative_variances > 0)
        out << fmt::format("{:<24}{} variances are below zero\n", "  note", negative_variances);
}

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
    ordered_json samples = nullptr, reference_samples = nullptr;
    if (options.samples) samples = *options.samples;
    if (options.test.reference_samples) reference_samples = *options.test.reference_samples;
    return {
        {"own_variance", !options.samples},
        {"samples_per_pixel", samples},
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
                     const std::vector<Judgement>& judgements, bool pass) {
    ordered_json channels = ordered_json::array();
    for (std::size_t c = 0; c < comparison.channels.size(); ++c) {
        ordered_json entry{{"channel", comparison.channels[c]}};
        entry.update(to_json(comparison.metrics.channels[c]));
        channels.push_back(entry);
    }
    ordered_json limits = ordered_json::array();
    for (const Judgement& judgement : judgements)
        limits.push_back({{"figure", judgement.name},
                          {"limit", judgement.limit},
                          {"measured", judgement.measured},
                          {"pass", judgement.pass()}});
    ordered_json others = ordered_json::array();
    for (const OtherChannel& other : comparison.others.common)
        others.push_back(
            {{"different_values", other.different}, {"max_error", to_json(other.largest)}});
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
            {"identical", comparison.identical()},
            {"non_finite_equal_values", comparison.non_finite.equal},
            {"relmse_epsilon", comparison.metrics.epsilon},
            {"all", to_json(comparison.metrics.all)},
            {"channels", channels},
            {"max_error", to_json(comparison.metrics.largest)},
            {"other_channels", others},
            {"only_in_image", comparison.others.in_image},
            {"only_in_reference", comparison.others.in_reference},
            {"not_compared", comparison.others.left_out},
            {"flip", flip},
            {"z_test", z_test},
            {"limits", limits},
            {"pass", pass}};
}

void print_others(std::ostream& out, const OtherChannels& others, bool common) {
    for (const OtherChannel& other : others.common)
        out << fmt::format("{:<24}{}\n", other.name,
                           other.different == 0
                               ? "the same"
                               : fmt::format("{} values differ, largest error {:.6g} at {},{}",
                                             other.different, other.largest.value, other.largest.x,
                                             other.largest.y));
    const auto list = [&](const char* label, const std::vector<std::string>& names,
                          const char* remark) {
        if (!names.empty())
            out << fmt::format("{:<24}{}{}\n", label, fmt::join(names, " "), remark);
    };
    list("only in A", others.in_image, common ? "" : ": FAIL");
    list("only in B", others.in_reference, common ? "" : ": FAIL");
    list("not compared", others.left_out, "");
}

} // namespace

void print_comparison(std::ostream& out, const CompareOptions& options,
                      const Comparison& comparison, const std::vector<Judgement>& judgements) {
    out << fmt::format("A  {}\nB  {} (reference)\n{}x{} pixels, linear values as stored\n\n",
                       as_one_line(options.image), as_one_line(options.reference), comparison.width,
                       comparison.height);
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
    print_others(out, comparison.others, options.common);
    if (comparison.z_test)
        print_z_test(out, *comparison.z_test, options, comparison.negative_variances);
    for (const Judgement& judgement : judgements)
        out << fmt::format("{:<24}{:.6g}, limit {:g}: {}\n",
                           fmt::format("limit on {}", judgement.name), judgement.measured,
                           judgement.limit, verdict(judgement.pass()));
    if (comparison.identical())
        out << (comparison.others.left_out.empty() ? "every value is the same\n"
                                                   : "every value compared is the same\n");
}

std::string comparison_json(const CompareOptions& options, const Comparison& comparison,
                            const std::vector<Judgement>& judgements, bool pass) {
    return json_text(to_json(options, comparison, judgements, pass));
}

} // namespace parhelion
