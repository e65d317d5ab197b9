// What a render writes at its end, and what may be there before.
#include "host/commands/render_outputs.h"

#include "host/commands/misfit_warning.h"
#include "host/commands/picture_form.h"
#include "host/commands/render_key.h"
#include "host/error.h"
#include "host/film/film_image.h"
#include "host/image/png_file.h"
#include "host/streams.h"
#include "parhelion_version.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>

namespace parhelion {
namespace {

// Attributes of a picture.
constexpr const char* digest_attribute = "render";
constexpr const char* unfinished_attribute = "unfinished";
constexpr const char* exposure_attribute = "exposure"; // of previews, whose values depend on it

std::string exposure_text(double stops) { return fmt::format("{}", stops); }

bool exists(const std::string& file) {
    std::error_code error;
    return std::filesystem::exists(file, error);
}

bool goes_on(const RenderCommand& command) { return !command.resume.empty() || command.goes_on; }

void check_film_output(const std::string& file, bool force) {
    if (!is_film_file(file))
        throw InputError(file + ": a part of a render (--shard) is a film, whose file must end in "
                                ".film; `parhelion merge` makes a picture of all parts");
    check_output_file(file, force);
}

enum class Left { other, unfinished, whole };

/// `picture_form`: whether it is written as asked for.
Left left_by_picture(const std::string& its_digest, const std::string& digest,
                     const std::string& unfinished, bool picture_form) {
    if (its_digest != digest) return Left::other;
    return unfinished.empty() && picture_form ? Left::whole : Left::unfinished;
}

Left left_by_film(const RenderCommand& command, const std::string& digest) {
    try {
        const FilmFile left(command.output);
        const FilmHeader& header = left.header();
        if (render_digest(header.key, header.samples_per_pixel) != digest ||
            header.part_name != part_name(shard_of(command)))
            return Left::other;
        return header.state.samples == header.part ? Left::whole : Left::unfinished;
    } catch (const InputError&) {
        return Left::other;
    }
}

/// What the output that is there is to the render of that digest: not whole where it is not as
/// `form`, or the exposure, says.
Left left_by(const RenderCommand& command, const std::string& digest, const ExrOptions& form) {
    const std::string& file = command.output;
    if (writes_film(command)) return left_by_film(command, digest);
    if (image_format(file) == ImageFormat::png)
        return left_by_picture(png_attribute(file, digest_attribute), digest,
                               png_attribute(file, unfinished_attribute),
                               png_attribute(file, exposure_attribute) ==
                                   exposure_text(command.exposure.value_or(0.0)));
    return left_by_picture(exr_attribute(file, digest_attribute), digest,
                           exr_attribute(file, unfinished_attribute), is_written_as(file, form));
}

/// Of a film whose samples are not all there: that, for whoever finds the picture.
void add_unfinished(const FilmHeader& header, Image& image) {
    const SampleSet all = header.all();
    if (header.state.samples == all) return;
    const double mean = static_cast<double>(sample_count(header.state.samples)) / header.blocks;
    image.metadata.emplace_back(unfinished_attribute,
                                fmt::format("{:.2f} of {} samples a pixel, at least {}", mean,
                                            header.samples_per_pixel,
                                            fewest_samples(header.state.samples, header.blocks)));
}

} // namespace

bool writes_film(const RenderCommand& command) { return command.shard.has_value(); }

void check_outputs(const RenderCommand& command) {
    const bool may_exist = command.force || goes_on(command) || command.skip_existing;
    const bool left = command.skip_existing && exists(command.output); // of a render like this one
    if (writes_film(command))
        check_film_output(command.output, may_exist);
    else
        check_output(command.output, may_exist);
    if (!command.scratch.empty()) check_folder("--scratch", command.scratch);
    if (!command.stats_file.empty()) check_output_file(command.stats_file, command.force || left);
    if (!command.checkpoint.empty())
        check_output_file(command.checkpoint,
                          may_exist && (command.goes_on || command.resume == command.checkpoint ||
                                        command.force || left));
}

std::optional<Existing> check_left_over(const RenderCommand& command, const std::string& digest,
                                        const ExrOptions& form) {
    if (command.force && !command.skip_existing) return Existing::replace;
    if (!exists(command.output)) return Existing::keep;
    switch (left_by(command, digest, form)) {
    case Left::unfinished:
        return Existing::replace;
    case Left::whole:
        return std::nullopt;
    case Left::other:
        break;
    }
    if (command.force) return Existing::replace;
    throw InputError(command.output + ": exists, and is not what this render made or left when it "
                                      "was stopped; give --force to replace it");
}

std::vector<std::pair<std::string, MetadataValue>>
metadata_of(const Scene& scene, const RenderReport& report, const std::string& digest) {
    std::vector<std::pair<std::string, MetadataValue>> metadata{
        {"software", fmt::format("parhelion {}", version_number)},
        {"commit", std::string(version_commit)},
        {"scene", scene.file},
        {"samplesPerPixel", static_cast<std::int64_t>(scene.sampler.samples_per_pixel)},
        {"seed", static_cast<std::int64_t>(scene.sampler.seed)},
        {"device", report.device},
        {digest_attribute, digest}};
    if (report.lenient)
        metadata.emplace_back("notes", fmt::format("{}", fmt::join(report.notes, "\n")));
    return metadata;
}

FilmHeader header_of(const RenderCommand& command, const Scene& scene, const RenderKey& key,
                     const OpenedRender& opened) {
    const Shard shard = shard_of(command);
    FilmHeader header;
    header.key = key;
    header.content = opened.content;
    header.blocks = opened.blocks;
    header.samples_per_pixel = opened.samples_per_pixel;
    header.part_name = part_name(shard);
    header.part = shard_samples(shard, opened.blocks, opened.samples_per_pixel);
    header.metadata =
        metadata_of(scene, opened.report, render_digest(key, opened.samples_per_pixel));
    return header;
}

std::vector<Misfits> write_picture(const std::string& file, const FilmHeader& header,
                                   const FilmSums& sums, const WriteOptions& options) {
    FilmPicture image(sums, header.content);
    auto& metadata = image.frame().metadata;
    metadata.insert(metadata.begin(), header.metadata.begin(), header.metadata.end());
    add_unfinished(header, image.frame());
    if (image_format(file) == ImageFormat::png)
        metadata.emplace_back(exposure_attribute, exposure_text(options.exposure));
    RenderReport report;
    report.misfits = write_image(file, image, options);
    if (!report.misfits.empty()) say(misfit_warning(file, options.exr, report));
    return report.misfits;
}

} // namespace parhelion
