// The in-process benchmarks as a program: progress on stderr, one JSON document on stdout.
#include "benchmarks/native/average.h"
#include "benchmarks/native/build.h"
#include "benchmarks/native/traversal.h"
#include "host/error.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdlib>

using namespace parhelion;
using namespace parhelion::bench;

namespace {

int run(int argc, char** argv) {
    CLI::App app("Rays and trees beside Embree's; ./parhelion bench runs it");
    TraversalOptions traversal;
    BuildOptions build;
    auto* trace = app.add_subcommand("traversal", "rays a second");
    auto* construct = app.add_subcommand("build", "seconds to build a tree");
    trace->add_flag("--quick", traversal.quick);
    trace->add_option("--threads", traversal.threads)->check(CLI::PositiveNumber);
    trace->add_flag("--processor-time", traversal.processor_time);
    construct->add_flag("--quick", build.quick);
    construct->add_option("--threads", build.threads)->check(CLI::PositiveNumber);
    auto* average = app.add_subcommand("average", "the weighted mean of images");
    std::string output;
    std::vector<std::string> files;
    std::vector<double> weights;
    average->add_option("--output", output)->required();
    average->add_option("--image", files)->required();
    average->add_option("--weight", weights)->required();
    app.require_subcommand(1);
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        fmt::print("{}", app.help());
        return static_cast<int>(ExitCode::ok);
    } catch (const CLI::ParseError& e) {
        throw InputError(e.what());
    }
    if (average->parsed()) {
        if (files.size() != weights.size()) throw InputError("as many --weight as --image");
        std::vector<WeightedImage> images;
        for (std::size_t i = 0; i < files.size(); i++)
            images.push_back({files[i], weights[i]});
        average_images(images, output);
        return static_cast<int>(ExitCode::ok);
    }
    // PoCL reads it when it is first asked for devices.
    setenv("POCL_MAX_PTHREAD_COUNT", fmt::format("{}", traversal.threads).c_str(), 1);
    nlohmann::json result = trace->parsed() ? measure_traversal(traversal) : measure_build(build);
    fmt::print("{}\n", result.dump(1));
    return static_cast<int>(ExitCode::ok);
}

int fail(ExitCode code, const char* what) {
    fmt::print(stderr, "parhelion_bench: {}\n", what);
    return static_cast<int>(code);
}

} // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const InputError& e) {
        return fail(ExitCode::bad_input, e.what());
    } catch (const DeviceError& e) {
        return fail(ExitCode::device_failure, e.what());
    } catch (const std::exception& e) {
        return fail(ExitCode::internal_failure, e.what());
    }
}
