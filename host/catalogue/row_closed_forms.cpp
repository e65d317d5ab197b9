// Whole images of scenes whose answer is known, over many seeds: the interval of what is left of a
// bias, and whether errors are as large as they say.
#include "host/catalogue/rows.h"

#include "host/catalogue/row_images.h"
#include "host/error.h"
#include "host/numerics/closed_form_truth.h"
#include "host/numerics/statistics.h"
#include "host/scene/load.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace parhelion::stress {
namespace {

constexpr int group_size = 10; // seeds of one t-test

/// scenes/closed_form beside an installed program, or of the source tree that it was built in.
std::filesystem::path scene_folder() {
    namespace fs = std::filesystem;
    fs::path program = fs::read_symlink("/proc/self/exe").parent_path();
    for (const char* way : {"../share/parhelion/scenes/closed_form", "../../scenes/closed_form",
                            "../../../scenes/closed_form"})
        if (fs::is_directory(program / way)) return program / way;
    throw InputError("the scenes of known answers (share/parhelion/scenes/closed_form) are not "
                     "beside the program");
}

Scene load_setting(const closed_form::Setting& setting) {
    Scene scene = load_scene((scene_folder() / setting.folder / "scene.xml").string(),
                             {setting.parameters, false});
    Film& film = scene.film;
    film.crop_x = film.crop_y = 0, film.crop_width = film.width, film.crop_height = film.height;
    scene.sampler.samples_per_pixel = setting.spp;
    scene.integrator.emitter_samples &= setting.next_event;
    return scene;
}

MeanRgb mean_truth(const closed_form::Setting& setting, const Image& image) {
    MeanRgb mean{};
    for (int y = 0; y < image.height; y++)
        for (int x = 0; x < image.width; x++)
            for (int c = 0; c < 3; c++)
                mean[c] += setting.truth(x, y)[c] / static_cast<double>(image.pixel_count());
    return mean;
}

double mean_of(const MeanRgb& v) { return (v[0] + v[1] + v[2]) / 3; }

struct SeedStatistics {
    std::array<Mean, 3> channels;
    Mean all;                     ///< of the channels together
    std::vector<double> p_values; ///< one a group of seeds
    MeanRgb truth{};
    std::uint64_t samples = 0; ///< of one image
    std::uint64_t bad_samples = 0;
};

/// Of the seeds from `first_seed` on.
SeedStatistics render_seeds(StressRun& run, const closed_form::Setting& setting,
                            std::uint64_t first_seed, int seeds) {
    Scene scene = load_setting(setting);
    SeedStatistics s;
    Mean group;
    for (int n = 0; n < seeds; n++) {
        scene.sampler.seed = static_cast<std::uint32_t>(first_seed + n);
        RenderResult result = render_quietly(run, scene);
        s.truth = mean_truth(setting, result.image);
        s.samples = result.image.pixel_count() * static_cast<std::uint64_t>(setting.spp);
        s.bad_samples += result.report.non_finite_samples;
        MeanRgb means = mean_rgb(result.image);
        for (std::size_t c = 0; c < 3; c++)
            s.channels[c].add(means[c]);
        double mean = mean_of(means);
        s.all.add(mean);
        group.add(mean);
        if ((n + 1) % group_size == 0) {
            double t = (group.mean() - mean_of(s.truth)) / group.error();
            s.p_values.push_back(student_two_sided(t, group_size - 1));
            group = Mean();
        }
    }
    return s;
}

/// Whether the errors of seeds, of relative standard deviation `spread`, come from many samples:
/// from more than rounding, and from more than one sample in a million that loses its light. There
/// are such: rays start a little off a curved wall, so that its nearest light points lie below
/// their horizon. A t-test of ten seeds knows no jumps as rare as that.
bool has_variance(const closed_form::Setting& setting, const SeedStatistics& s, double spread) {
    double of_a_sample = spread * std::sqrt(static_cast<double>(s.samples));
    return spread > 20 * (2e-7 + setting.tolerance) && of_a_sample > 1e-3;
}

/// Rounding of a float sum, where a strategy leaves no variance; and what the scene's finite extent
/// takes from the truth.
double allowance(const closed_form::Setting& setting, double truth) {
    return (2e-7 + setting.tolerance) * truth;
}

/// The least p of three t-tests, of a channel each; and the largest standard error.
void add_means(Checks& checks, const closed_form::Setting& setting, const SeedStatistics& s,
               int seeds, double level) {
    Check mean{.name = setting.name + ": means of the channels against the truth, smallest p",
               .value = 1,
               .target = level,
               .at_least = true,
               .unit = "p",
               .samples = static_cast<std::uint64_t>(seeds)};
    Check error{.name = setting.name + ": standard error of a channel's mean",
                .target = 0.02, // or the test could see nothing
                .unit = "relative",
                .samples = static_cast<std::uint64_t>(seeds)};
    for (std::size_t c = 0; c < 3; c++) {
        double truth = s.truth[c], off = s.channels[c].mean() - truth;
        double excess = std::max(0., std::fabs(off) - allowance(setting, truth));
        double p =
            student_two_sided(excess / std::hypot(s.channels[c].error(), 1e-9 * truth), seeds - 1);
        if (p < mean.value) mean.value = p, mean.worst_at = std::string(1, "RGB"[c]);
        error.value = std::max(error.value, s.channels[c].error() / truth);
    }
    double truth = mean_of(s.truth);
    mean.note = fmt::format("bias {:+.2e} +- {:.2e} (95 %), relative", s.all.mean() / truth - 1,
                            1.96 * s.all.error() / truth);
    checks.push_back(mean);
    checks.push_back(error);
}

} // namespace

Checks row_closed_forms(StressRun& run) {
    std::vector<closed_form::Setting> settings;
    for (const closed_form::Setting& setting : closed_form::settings())
        if (setting.judgement == closed_form::Judgement::mean_z_test) settings.push_back(setting);
    if (run.effort == Effort::quick) // every third: twelve and more
        std::erase_if(settings,
                      [&, n = 0](const closed_form::Setting&) mutable { return n++ % 3 != 0; });
    int seeds = static_cast<int>(run.count(32, 40, 1000));
    double level = sidak_level(0.01, settings.size());
    std::vector<double> all_p;
    Checks checks;
    Check bad = bad_samples_check("closed forms");
    for (std::size_t i = 0; i < settings.size(); i++) {
        // Seeds of its own: scenes of the same shape would else err alike, all together.
        SeedStatistics s = render_seeds(run, settings[i], run.seed * 100'000 + i * seeds, seeds);
        add_means(checks, settings[i], s, seeds, sidak_level(0.01, 3 * settings.size()));
        bad.value += static_cast<double>(s.bad_samples), bad.samples += s.samples * seeds;
        if (has_variance(settings[i], s, s.all.error() / mean_of(s.truth) * std::sqrt(seeds))) {
            checks.push_back(
                {.name = settings[i].name + ": p-values of groups of seeds are uniform",
                 .value = kolmogorov_smirnov_p(s.p_values),
                 .target = level,
                 .at_least = true,
                 .unit = "p",
                 .samples = s.p_values.size()});
            all_p.insert(all_p.end(), s.p_values.begin(), s.p_values.end());
        }
        run.done(static_cast<double>(i + 1) / static_cast<double>(settings.size()));
    }
    checks.push_back(bad);
    checks.push_back({.name = "closed forms together: p-values are uniform",
                      .value = kolmogorov_smirnov_p(all_p),
                      .target = 0.01,
                      .at_least = true,
                      .unit = "p",
                      .samples = all_p.size()});
    return checks;
}

} // namespace parhelion::stress
