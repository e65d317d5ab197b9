// Command lines of `render` and `compare`, one argument a line, up to where files or a device would
// be opened.
#include "host/commands/command_line.h"
#include "host/commands/compare.h"
#include "host/commands/frames.h"
#include "host/commands/number_ranges.h"
#include "host/commands/render.h"
#include "property.h"
#include "targets.h"

namespace parhelion::fuzz {

namespace {

std::vector<std::string> lines_of(std::string_view text) {
    std::vector<std::string> lines;
    for (std::size_t start = 0; start < text.size();) {
        const std::size_t end = std::min(text.find('\n', start), text.size());
        lines.emplace_back(text.substr(start, end - start));
        start = end + 1;
    }
    return lines;
}

void check_film(const Film& film) {
    promise(film.width > 0 && film.height > 0, "the film has pixels");
    promise(film.crop_x >= 0 && film.crop_width > 0 && film.crop_width <= film.width - film.crop_x,
            "the crop lies inside the film's width");
    promise(film.crop_y >= 0 && film.crop_height > 0 &&
                film.crop_height <= film.height - film.crop_y,
            "the crop lies inside the film's height");
}

int use_render(const RenderCommand& all) {
    const Frames frames(all);
    promise(frames.count() > 0 && frames.count() <= most_renders, "there are renders");
    const RenderCommand command = frames.command(frames.count() - 1);
    check_command(command);
    static_cast<void>(parse_definitions(command.definitions));
    Scene scene;
    apply_overrides(command, scene);
    check_film(scene.film);
    promise(scene.sampler.samples_per_pixel > 0, "there are samples");
    return 0;
}

int use_compare(const CompareOptions& options) {
    check_options(options);
    return 0;
}

/// Made once: that takes several times as long as to read a command line.
class Commands {
public:
    void run(std::string_view text) {
        render_ = {};
        compare_ = {};
        reader_.run(lines_of(text));
    }

private:
    RenderCommand render_;
    CompareOptions compare_;
    CommandLine line_{
        .summary = "summary",
        .footer = "footer",
        .version = [] { return std::string("version"); },
        .subcommands = {{.name = "render",
                         .options = render_options(render_),
                         .run = [this] { return use_render(render_); }},
                        {.name = "compare",
                         .options = compare_options(compare_),
                         .run = [this] { return use_compare(compare_); }}},
    };
    CommandLineReader reader_{line_};
};

} // namespace

int fuzz_options(const std::uint8_t* data, std::size_t size) {
    static Commands commands;
    return answer_or_refusal([&] { commands.run(as_text(data, size)); });
}

} // namespace parhelion::fuzz
