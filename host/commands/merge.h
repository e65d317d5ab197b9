// `parhelion merge`: films of parts of a render to the picture of the whole.
#pragma once

#include "host/commands/command_line.h"
#include "host/commands/picture_form.h"

#include <optional>
#include <string>
#include <vector>

namespace parhelion {

struct MergeCommand {
    std::vector<std::string> parts;
    std::string output = "out.exr", log_file, progress = "auto";
    std::optional<double> exposure;
    PictureForm form;
    bool partial = false, force = false, quiet = false;
};

/// The exit code. Throws InputError where the films are not the parts of one render, naming which
/// are double, of another render, or missing, and OutputError.
int run_merge(const MergeCommand& command);

Subcommand merge_subcommand();

} // namespace parhelion
