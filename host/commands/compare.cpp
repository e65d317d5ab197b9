// The options and the verdict of `parhelion compare`.
#include "host/commands/compare.h"

#include "host/commands/compare_pictures.h"
#include "host/commands/compare_report.h"
#include "host/error.h"
#include "host/image/exr.h"
#include "host/image/own_variance.h"
#include "host/streams.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <sstream>

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
    {"max", "Largest difference of any value of any channel", &CompareOptions::max,
     [](const Comparison& c) { return std::max(c.metrics.largest.value, c.others.largest()); }},
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

/// What no figure shows: a channel that one image lacks, and other layers where the figures say
/// that there is no difference.
bool others_pass(const CompareOptions& options, const Comparison& comparison) {
    if (!options.common && !comparison.others.none_missing()) return false;
    return !comparison.equal || comparison.others.all_equal();
}

bool all_pass(const CompareOptions& options, const Comparison& comparison,
              const std::vector<Judgement>& judgements) {
    const bool limits = std::all_of(judgements.begin(), judgements.end(),
                                    [](const Judgement& judgement) { return judgement.pass(); });
    const auto& test = comparison.z_test;
    return limits && others_pass(options, comparison) &&
           (!test || (test->pixels_pass && test->means_pass));
}

// ---- options

/// Samples of a pixel may be no whole number: a filter weighs them.
constexpr Domain samples_domain = greater_than(0);

/// Own variances come with their samples; those of a file do not.
void check_variance(const CompareOptions& options) {
    if (options.variance.empty()) return;
    const bool own = options.variance == own_variance;
    if (own && (options.samples || options.test.reference_samples || options.xyz_statistics))
        throw InputError("command line: --variance own: takes the samples of the images' own "
                         "layers, in RGB; no --spp, --reference-spp or --xyz-statistics");
    if (!own && !options.samples) throw InputError("command line: --variance: a file needs --spp");
}

std::vector<Option> limit_options(CompareOptions& c) {
    std::vector<Option> options;
    options.reserve(limit_kinds.size());
    for (const LimitKind& kind : limit_kinds)
        options.push_back(
            {std::string("--") + kind.name, &(c.*kind.limit), kind.help, {.domain = at_least(0)}});
    return options;
}

std::vector<Option> z_test_options(CompareOptions& c) {
    return {
        {"--variance",
         &c.variance,
         "EXR with the variance of one sample of each pixel (with --spp), or `own`, the layers "
         "variance and samples of A, and of B if it has them: z-tests of the pixels and the mean",
         {.kind = ValueKind::file}},
        {"--spp",
         &c.samples,
         "Samples per pixel of A",
         {.needs = {"--variance"}, .domain = samples_domain}},
        {"--reference-spp",
         &c.test.reference_samples,
         "Samples per pixel of B (default: B is exact)",
         {.needs = {"--variance"}, .domain = samples_domain}},
        {"--alpha",
         &c.test.alpha,
         "Chance to fail an image that is right, for each of the two z-tests",
         {.needs = {"--variance"}, .domain = strictly_between(0, 1)}},
        {"--variance-floor",
         &c.test.variance_floor,
         "Least variance in the z-test of the pixels",
         {.needs = {"--variance"}, .domain = at_least(0)}},
        {"--xyz-statistics",
         &c.xyz_statistics,
         "B and the variance hold XYZ statistics as RGB (Mitsuba's test references): test in XYZ",
         {.needs = {"--variance"}}},
    };
}

} // namespace

std::vector<Option> compare_options(CompareOptions& c) {
    std::vector<Option> options{
        {"A", &c.image, "Image (.exr)", {.required = true, .kind = ValueKind::file}},
        {"B", &c.reference, "Reference (.exr)", {.required = true, .kind = ValueKind::file}},
        {"--json", &c.json, "Report as one JSON object"},
        {"--layer", &c.figures.layer, "Compare the channels NAME.* alone"},
        {"--common", &c.common, "Channels that only one of the images has are no difference"},
        {"--epsilon",
         &c.figures.epsilon,
         "relMSE is the mean of (A - B)^2 / (B^2 + epsilon)",
         {.domain = at_least(0)}},
        // Of fewer, filters are narrower than a pixel and have no slope; of more, larger than
        // images.
        {"--ppd",
         &c.figures.pixels_per_degree,
         "FLIP's pixels per degree",
         {.domain = between(1, 10000)}}};
    for (const std::vector<Option>& more :
         {picture_options(c), limit_options(c), z_test_options(c)})
        options.insert(options.end(), more.begin(), more.end());
    return options;
}

void check_options(const CompareOptions& options) { check_variance(options); }

int run_compare(const CompareOptions& options, std::ostream& out) {
    check_options(options);
    check_pictures(options);
    const Image image = read_exr(options.image), reference = read_exr(options.reference);
    const NamedImage a{options.image, image}, b{options.reference, reference};
    Image variance;
    std::optional<VarianceInput> variance_input;
    if (options.variance == own_variance) {
        variance = variance_of_difference(a, b);
        variance_input.emplace(
            VarianceInput{{a.name, variance}, false, own_variance_test(options.test, image)});
    } else if (!options.variance.empty()) {
        variance = read_exr(options.variance);
        variance_input.emplace(
            VarianceInput{{options.variance, variance}, options.xyz_statistics, options.test});
        variance_input->test.samples = options.samples.value();
    }
    ComparisonOptions figures = options.figures;
    if (options.variance == own_variance)
        figures.left_out_layers.assign(own_variance_layers.begin(), own_variance_layers.end());
    const Comparison comparison = compare_images(a, b, figures, variance_input);
    if (options.flip && !comparison.flip)
        throw InputError(options.image + ": --flip needs R, G and B with finite values");
    write_pictures(options, image, reference, comparison);
    const std::vector<Judgement> judgements = judge(options, comparison);
    const bool pass = all_pass(options, comparison, judgements);
    if (options.json)
        out << comparison_json(options, comparison, judgements, pass);
    else
        print_comparison(out, options, comparison, judgements);
    return static_cast<int>(pass ? ExitCode::ok : ExitCode::different);
}

Subcommand compare_subcommand() {
    const auto c = std::make_shared<CompareOptions>();
    return {
        .name = "compare",
        .summary = "Compare two EXR images; exit code 0 within the limits given (or none given), "
                   "1 not, or channels differ that the figures are not of, 2 unusable input",
        .examples =
            "Examples:\n"
            "  parhelion compare image.exr reference.exr\n"
            "  parhelion compare image.exr reference.exr --relmse 1e-3 --bias 0.005 --json\n"
            "  parhelion compare image.exr reference.exr --flip-image where.png\n"
            "  parhelion compare image.exr reference.exr --variance own\n"
            "  parhelion compare image.exr reference.exr --variance variance.exr --spp 64",
        .options = compare_options(*c),
        .run =
            [c] {
                std::ostringstream text;
                const int code = run_compare(*c, text);
                print(text.str());
                return code;
            },
    };
}

} // namespace parhelion
