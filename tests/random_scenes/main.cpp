// Renders random scenes and says which of them crash, hang, hide a value that is no number, or give
// other bits on the device than on the host.
//
// Each scene runs in a worker process; one that dies or stands still is reported by its number and
// followed by another worker.
#include "host/error.h"
#include "tests/random_scenes/trial.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <map>

namespace {

using namespace parhelion::test;

struct Settings {
    SceneKind kind = SceneKind::small;
    std::uint64_t first = 0, count = 100;
    int seconds = 120; ///< that one scene may take
    bool print = false, refusals = false;
    TrialOptions trial;
};

struct Tally {
    std::uint64_t rendered = 0, on_device = 0, refused = 0, failed = 0;
};

constexpr char verdict_letters[] = "rdxf"; ///< in the order of Verdict

/// In the worker: a line a scene, "<letter> <text>".
[[noreturn]] void work(const Settings& settings, std::uint64_t first, int out) {
    std::set<parhelion::FeatureSet> programs;
    for (std::uint64_t i = first; i < settings.first + settings.count; i++) {
        Outcome outcome = try_scene(random_scene(settings.kind, i), settings.trial, programs);
        std::string line =
            fmt::format("{} {}\n", verdict_letters[static_cast<int>(outcome.verdict)],
                        parhelion::as_one_line(outcome.text));
        if (write(out, line.data(), line.size()) != static_cast<ssize_t>(line.size())) break;
    }
    _exit(0); // the device's driver is not asked to close
}

/// A line of the worker's, or nothing where it has ended or `seconds` have passed.
std::string next_line(int in, int seconds) {
    std::string line;
    pollfd ready{in, POLLIN, 0};
    for (char c = 0; poll(&ready, 1, 1000 * seconds) == 1 && read(in, &c, 1) == 1;) {
        if (c == '\n') return line;
        line += c;
    }
    return "";
}

void count(const std::string& line, std::uint64_t number, const Settings& settings, Tally& tally) {
    switch (line[0]) {
    case 'd':
        tally.on_device++;
        [[fallthrough]];
    case 'r':
        tally.rendered++;
        break;
    case 'x':
        tally.refused++;
        if (settings.refusals) fmt::print("{} refused: {}\n", number, line.substr(2));
        break;
    default:
        tally.failed++;
        fmt::print("{} FAILED: {}\n", number, line.substr(2));
    }
}

std::string end_of(pid_t worker) {
    kill(worker, SIGKILL);
    int status = 0;
    waitpid(worker, &status, 0);
    if (WIFSIGNALED(status) && WTERMSIG(status) != SIGKILL)
        return fmt::format("crashed: {}", strsignal(WTERMSIG(status)));
    return WIFEXITED(status) ? fmt::format("ended with code {}", WEXITSTATUS(status))
                             : "stood still";
}

/// The number after the last scene that a new worker has dealt with.
std::uint64_t run_worker(const Settings& settings, std::uint64_t first, Tally& tally) {
    int ends[2];
    if (pipe(ends) != 0) throw std::runtime_error("no pipe");
    pid_t worker = fork();
    if (worker < 0) throw std::runtime_error("no process");
    if (worker == 0) work(settings, first, ends[1]);
    close(ends[1]);
    std::uint64_t at = first, end = settings.first + settings.count;
    for (std::string line; at < end && !(line = next_line(ends[0], settings.seconds)).empty(); at++)
        count(line, at, settings, tally);
    close(ends[0]);
    usleep(at < end ? 100000 : 0); // one that is dying is let die of its own
    std::string said = end_of(worker);
    if (at == end) return at;
    tally.failed++;
    fmt::print("{} FAILED: the renderer {}\n", at, said);
    return at + 1;
}

int run(const Settings& settings) {
    if (settings.print) {
        RandomScene scene = random_scene(settings.kind, settings.first);
        fmt::print("{}<!-- {}:\n{}-->\n", scene.xml, mesh_file_name, scene.obj);
        return 0;
    }
    Tally tally;
    for (std::uint64_t at = settings.first; at < settings.first + settings.count;)
        at = run_worker(settings, at, tally);
    fmt::print("{} scenes: {} rendered ({} on the device too), {} refused, {} failed\n",
               settings.count, tally.rendered, tally.on_device, tally.refused, tally.failed);
    // Where most are refused little is tried.
    return tally.failed == 0 && tally.rendered * 4 >= settings.count && tally.on_device > 0 ? 0 : 1;
}

} // namespace

int main(int argc, char** argv) {
    Settings settings;
    CLI::App app("Renders random scenes; fails where one crashes, hangs, hides a value that is no "
                 "number, or differs between device and host");
    const std::map<std::string, SceneKind> kinds{{"small", SceneKind::small},
                                                 {"extreme", SceneKind::extreme}};
    settings.trial.most_programs = 40;
    app.add_option("kind", settings.kind, "small or extreme")
        ->required()
        ->transform(CLI::CheckedTransformer(kinds));
    app.add_option("--first", settings.first, "Number of the first scene");
    app.add_option("--count", settings.count, "How many scenes");
    app.add_option("--programs", settings.trial.most_programs,
                   "Sets of features to compile for the device; scenes beyond keep to the host");
    app.add_option("--seconds", settings.seconds, "Time that a scene may take");
    app.add_flag("--print", settings.print, "Print the first scene instead");
    app.add_flag("--refusals", settings.refusals, "Print why scenes were refused");
    CLI11_PARSE(app, argc, argv);
    std::string folder =
        (std::filesystem::temp_directory_path() / "parhelion-scenes-XXXXXX").string();
    if (!mkdtemp(folder.data())) return 2;
    settings.trial.folder = folder;
    setlinebuf(stdout);
    int code = run(settings);
    std::filesystem::remove_all(folder);
    return code;
}
