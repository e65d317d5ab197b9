// The pictures of a comparison: the one list of them, and their files.
#include "host/commands/compare_pictures.h"

#include "host/error.h"
#include "host/image/distinct_files.h"
#include "host/image/output.h"
#include "host/image/write_image.h"

#include <array>
#include <cmath>
#include <utility>

namespace parhelion {

namespace {

/// |A - B| of each channel that the figures are of.
Image difference_of(const Image& image, const Image& reference, const Comparison& comparison) {
    Image made = make_image(comparison.width, comparison.height);
    for (const std::string& name : comparison.channels) {
        const auto &a = find_channel(image, name)->values,
                   &b = find_channel(reference, name)->values;
        std::vector<float> values(a.size());
        for (std::size_t i = 0; i < values.size(); i++)
            values[i] = std::abs(a[i] - b[i]);
        add_channel(made, name, std::move(values));
    }
    return made;
}

/// LDR-FLIP of each pixel, as grey.
Image flip_of(const Image&, const Image&, const Comparison& comparison) {
    if (!comparison.flip)
        throw InputError("--flip-image: FLIP needs R, G and B with finite values");
    const std::vector<double>& errors = comparison.flip->of_pixels;
    Image made = make_image(comparison.width, comparison.height);
    add_channel(made, "Y", std::vector<float>(errors.begin(), errors.end()));
    return made;
}

struct PictureKind {
    const char* option;
    const char* help;
    std::string CompareOptions::*file;
    Image (*draw)(const Image&, const Image&, const Comparison&);
};

const std::array<PictureKind, 2> picture_kinds{{
    {"--difference-image", "Write |A - B| to this file, .exr or .png",
     &CompareOptions::difference_file, difference_of},
    {"--flip-image", "Write FLIP of each pixel to this file, .exr or .png, black (0) to white (1)",
     &CompareOptions::flip_file, flip_of},
}};

} // namespace

std::vector<Option> picture_options(CompareOptions& options) {
    std::vector<Option> made;
    made.reserve(picture_kinds.size() + 1);
    for (const PictureKind& kind : picture_kinds)
        made.push_back({kind.option, &(options.*kind.file), kind.help, {.kind = ValueKind::file}});
    made.push_back({"--force", &options.force, "Overwrite files that exist"});
    return made;
}

void check_pictures(const CompareOptions& options) {
    std::vector<UsedFile> outputs;
    for (const PictureKind& kind : picture_kinds) {
        const std::string& file = options.*kind.file;
        if (file.empty()) continue;
        check_output(file, options.force);
        outputs.push_back({kind.option, file});
    }
    check_distinct(
        outputs,
        {{"A", options.image}, {"B", options.reference}, {"--variance", options.variance}});
}

void write_pictures(const CompareOptions& options, const Image& image, const Image& reference,
                    const Comparison& comparison) {
    std::vector<std::pair<std::string, Image>> pictures; // all, before one is written
    pictures.reserve(picture_kinds.size());
    for (const PictureKind& kind : picture_kinds)
        if (const std::string& file = options.*kind.file; !file.empty())
            pictures.emplace_back(file, kind.draw(image, reference, comparison));
    for (const auto& [file, drawn] : pictures) {
        // Values that are not finite are the same in both images, and the report counts them.
        static_cast<void>(write_image(file, WholeImage(drawn),
                                      {.exr = {.existing = existing_files(options.force)}}));
    }
}

} // namespace parhelion
