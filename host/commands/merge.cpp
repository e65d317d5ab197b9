// `parhelion merge`: films of parts of a render to the picture of the whole.
#include "host/commands/merge.h"

#include "host/commands/message_options.h"
#include "host/commands/render_domains.h"
#include "host/commands/render_messages.h"
#include "host/commands/render_outputs.h"
#include "host/error.h"
#include "host/film/film_parts.h"
#include "host/image/distinct_files.h"
#include "host/progress.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <memory>
#include <mutex>

namespace parhelion {
namespace {

std::vector<UsedFile> inputs_of(const MergeCommand& command) {
    std::vector<UsedFile> inputs;
    inputs.reserve(command.parts.size());
    for (const std::string& part : command.parts)
        inputs.push_back({"a part,", part});
    return inputs;
}

RenderMessages messages_of(const MergeCommand& command) {
    std::vector<UsedFile> others = inputs_of(command);
    others.push_back({"--output", command.output});
    return {command.progress, command.quiet, command.log_file, others};
}

void check_files(const MergeCommand& command) {
    if (is_film_file(command.output))
        check_output_file(command.output, command.force);
    else
        check_output(command.output, command.force);
    if (command.exposure &&
        (is_film_file(command.output) || image_format(command.output) != ImageFormat::png))
        throw InputError("--exposure: is for .png previews; an .exr holds linear values");
    check_picture_form(command.form, command.output);
    check_distinct({{"--output", command.output}}, inputs_of(command));
}

/// Each part stays open: as many as the system lets a process have.
void allow_many_files() {
    rlimit limit{};
    if (getrlimit(RLIMIT_NOFILE, &limit) != 0) return;
    limit.rlim_cur = limit.rlim_max;
    setrlimit(RLIMIT_NOFILE, &limit);
}

std::deque<FilmFile> opened(const MergeCommand& command, Progress& progress) {
    std::deque<FilmFile> parts;
    for (const std::string& file : command.parts) {
        parts.emplace_back(file);
        progress.update(static_cast<double>(parts.size()) /
                        static_cast<double>(command.parts.size()));
    }
    check_parts(parts);
    return parts;
}

/// Sums that tell how far whoever asks for them row by row, from the top, has come. Several threads
/// may ask.
class ToldSums : public FilmSums {
public:
    ToldSums(const FilmSums& sums, int rows, Progress& progress)
        : sums_(sums), rows_(rows), progress_(progress) {}

    void add_row(int channel, int y, SumRow& row) const override {
        sums_.add_row(channel, y, row);
        tell(y);
    }
    void add_coverage(int y, ShapeWeights& row) const override {
        sums_.add_coverage(y, row);
        tell(y);
    }

private:
    void tell(int y) const {
        const std::scoped_lock lock(telling_);
        if (y < next_) return;
        next_ = y + 1;
        progress_.update(static_cast<double>(next_) / rows_);
    }

    const FilmSums& sums_;
    int rows_;
    Progress& progress_;
    mutable std::mutex telling_;
    mutable int next_ = 0; ///< behind the lowest row that was asked for
};

void write_merged(const MergeCommand& command, const FilmHeader& header, const FilmSums& sums) {
    if (is_film_file(command.output)) {
        write_film(command.output, header, sums, existing_files(command.force));
        return;
    }
    static_cast<void>(write_picture(command.output, header, sums,
                                    write_options(command.form, header.content, command.exposure,
                                                  existing_files(command.force)))); // it is told
}

} // namespace

int run_merge(const MergeCommand& command) {
    const RenderMessages messages = messages_of(command);
    check_files(command);
    allow_many_files();
    Progress progress(messages.mode());
    progress.start("reading", fmt::format("{} film{}", command.parts.size(),
                                          command.parts.size() == 1 ? "" : "s"));
    const std::deque<FilmFile> parts = opened(command, progress);
    const FilmHeader header = added_header(parts);
    progress.finish("");
    const std::string missing = missing_text(parts, header);
    if (!missing.empty() && !command.partial && !is_film_file(command.output))
        throw InputError(fmt::format("{} (--partial makes a picture of what there is)", missing));
    if (!missing.empty()) progress.note("note: " + missing);
    std::vector<const FilmSums*> films;
    films.reserve(parts.size());
    for (const FilmFile& part : parts)
        films.push_back(&part);
    // Rows are added up when they are written.
    progress.start("adding and writing", command.output);
    const AddedFilms added(films);
    write_merged(command, header, ToldSums(added, header.content.film.crop_height, progress));
    progress.finish("");
    progress.note("wrote " + command.output);
    return static_cast<int>(ExitCode::ok);
}

Subcommand merge_subcommand() {
    auto c = std::make_shared<MergeCommand>();
    Subcommand merge{
        .name = "merge",
        .summary = "Make one picture of the parts that `render --shard` wrote",
        .examples = "Examples:\n"
                    "  parhelion render scene.xml --shard 1/2 -o part1.film\n"
                    "  parhelion render scene.xml --shard 2/2 -o part2.film\n"
                    "  parhelion merge part1.film part2.film -o image.exr\n"
                    "  parhelion merge part*.film -o look.png --partial\n"
                    "  parhelion merge rack1/*.film -o rack1.film",
        .options =
            {
                {"parts",
                 &c->parts,
                 "Films of parts of one render, in any order",
                 {.required = true, .kind = ValueKind::file}},
                {"-o,--output",
                 &c->output,
                 "Image to write, .exr or .png; or a .film, to be merged again",
                 {.kind = ValueKind::file}},
                {"--partial", &c->partial, "A picture of what there is, though parts are missing"},
                {"--exposure",
                 &c->exposure,
                 "Stops of exposure for .png",
                 {.domain = exposure_domain}},
                {"--force", &c->force, "Overwrite files that exist"},
                log_option(c->log_file),
                quiet_option(c->quiet),
                progress_option(c->progress),
            },
        .run = [c] { return run_merge(*c); },
    };
    for (Option& option : picture_form_options(c->form))
        merge.options.push_back(std::move(option));
    return merge;
}

} // namespace parhelion
