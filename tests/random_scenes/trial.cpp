// One random scene, rendered in every way there is.
#include "tests/random_scenes/trial.h"

#include "host/error.h"
#include "host/image/exr.h"
#include "host/render/host_render.h"
#include "tests/support/render_scene.h"

#include <bit>
#include <fstream>

namespace parhelion::test {
namespace {

void write(const std::filesystem::path& file, const std::string& text) {
    std::ofstream out(file, std::ios::binary);
    out << text;
    if (!out.flush()) throw std::runtime_error("cannot write " + file.string());
}

/// How many values differ in a bit, other than NaNs among each other.
std::uint64_t differing_bits(const Image& a, const Image& b) {
    std::uint64_t differing = 0;
    for (std::size_t c = 0; c < a.channels.size(); c++)
        for (std::size_t i = 0; i < a.channels[c].values.size(); i++) {
            float x = a.channels[c].values[i], y = b.channels[c].values[i];
            if (std::isnan(x) && std::isnan(y)) continue;
            differing += std::bit_cast<std::uint32_t>(x) != std::bit_cast<std::uint32_t>(y);
        }
    return differing;
}

std::uint64_t not_finite(const Image& image) {
    std::uint64_t count = 0;
    for (const Channel& channel : image.channels)
        for (float value : channel.values)
            count += !std::isfinite(value);
    return count;
}

/// What is wrong where those who write an image are not told of each value that is no number.
std::string silence(const char* where, const Image& image, const TrialOptions& options) {
    std::uint64_t bad = not_finite(image);
    std::uint64_t told = misfit_count(write_exr((options.folder / "image.exr").string(), image));
    if (bad == told) return "";
    return fmt::format("{}: {} values not finite, {} told of", where, bad, told);
}

std::string on_the_host(const Scene& scene, const TrialOptions& trial, Image& single,
                        std::uint64_t& bad_samples) {
    Progress quiet(Progress::Mode::quiet);
    RenderOptions options;
    options.all_features = true;
    RenderResult result = render_on_host(scene, options, Precision::single_precision, quiet);
    single = result.image, bad_samples = result.report.non_finite_samples;
    std::string wrong = silence("single precision", single, trial);
    if (!wrong.empty()) return wrong;
    return silence("double precision",
                   render_on_host(scene, options, Precision::double_precision, quiet).image, trial);
}

std::string on_the_device(const Scene& scene, const Image& host, std::uint64_t bad_samples) {
    RenderOptions options;
    options.all_features = true;
    RenderResult device = render_quietly(scene, options);
    std::uint64_t differing = differing_bits(device.image, host);
    if (differing > 0) return fmt::format("device and host differ in {} values", differing);
    if (device.report.non_finite_samples != bad_samples)
        return fmt::format("{} bad samples on the device, {} on the host",
                           device.report.non_finite_samples, bad_samples);
    return "";
}

Outcome render_everywhere(const Scene& scene, const TrialOptions& options,
                          std::set<FeatureSet>& programs) {
    Image host;
    std::uint64_t bad_samples = 0;
    std::string wrong = on_the_host(scene, options, host, bad_samples);
    if (!wrong.empty()) return {Verdict::failed, wrong};
    RenderOptions all;
    all.all_features = true;
    FeatureSet features = render_features(make_device_scene(scene), all);
    if (!programs.contains(features) && programs.size() >= options.most_programs)
        return {Verdict::rendered, ""};
    programs.insert(features);
    wrong = on_the_device(scene, host, bad_samples);
    if (!wrong.empty()) return {Verdict::failed, wrong};
    return {Verdict::on_device_too, ""};
}

} // namespace

Outcome try_scene(const RandomScene& scene, const TrialOptions& options,
                  std::set<FeatureSet>& programs) {
    RenderCommand command;
    command.scene_file = (options.folder / "scene.xml").string();
    write(command.scene_file, scene.xml);
    write(options.folder / mesh_file_name, scene.obj);
    try {
        return render_everywhere(load(command), options, programs);
    } catch (const InputError& refusal) {
        return {Verdict::refused, refusal.what()};
    } catch (const std::exception& error) {
        return {Verdict::failed, as_one_line(error.what())};
    }
}

} // namespace parhelion::test
