// `parhelion merge`: films of parts of a render to the picture of the whole.
#include "host/commands/merge.h"

#include "host/commands/render_domains.h"
#include "host/commands/render_outputs.h"
#include "host/error.h"
#include "host/film/film_parts.h"
#include "host/image/distinct_files.h"
#include "host/progress.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <memory>

namespace parhelion {
namespace {

void check_files(const MergeCommand& command) {
    if (is_film_file(command.output))
        check_output_file(command.output, command.force);
    else
        check_output(command.output, command.force);
    if (command.exposure &&
        (is_film_file(command.output) || image_format(command.output) != ImageFormat::png))
        throw InputError("--exposure: is for .png previews; an .exr holds linear values");
    check_picture_form(command.form, command.output);
    std::vector<UsedFile> inputs;
    for (const std::string& part : command.parts)
        inputs.push_back({"a part,", part});
    check_distinct({{"--output", command.output}}, inputs);
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
    check_files(command);
    allow_many_files();
    Progress progress = Progress::standard(command.quiet);
    progress.start("opening", fmt::format("{} film{}", command.parts.size(),
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
    progress.start("merging");
    write_merged(command, header, AddedFilms(films));
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
                {"-q,--quiet", &c->quiet, "No progress and notes; warnings and errors are told"},
            },
        .run = [c] { return run_merge(*c); },
    };
    for (Option& option : picture_form_options(c->form))
        merge.options.push_back(std::move(option));
    return merge;
}

} // namespace parhelion
