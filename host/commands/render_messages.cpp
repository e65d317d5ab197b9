// Where a render, or a merge, tells what it has to say: --progress, --quiet, --log.
#include "host/commands/render_messages.h"

#include "host/error.h"
#include "host/message_log.h"
#include "host/streams.h"

namespace parhelion {
namespace {

std::vector<UsedFile> files_beside_log(const RenderCommand& command) {
    std::vector<UsedFile> files{{"the scene", command.scene_file},
                                {"--output", command.output},
                                {"--stats", command.stats_file},
                                {"--json", command.json_file}};
    for (const std::string& scene : command.scenes)
        files.push_back({"the scene", scene});
    return files;
}

} // namespace

RenderMessages::RenderMessages(const std::string& progress, bool quiet, const std::string& log_file,
                               const std::vector<UsedFile>& others)
    : mode_(Progress::mode_of(progress, quiet)), log_file_(log_file) {
    close_message_log();
    tell_messages_as(mode_ == Progress::Mode::json ? MessageForm::json : MessageForm::text);
    if (log_file_.empty()) return;
    check_distinct({{"--log", log_file_}}, others);
    open_message_log(log_file_);
}

RenderMessages::RenderMessages(const RenderCommand& command)
    : RenderMessages(command.progress, command.quiet, command.log_file, files_beside_log(command)) {
}

LoadOptions RenderMessages::guarded(LoadOptions options) const {
    options.check_file = [this](const std::string& file) {
        check_distinct_from({{"a file of the scene,", file}});
    };
    return options;
}

void RenderMessages::check_distinct_from(const std::vector<UsedFile>& files) const {
    if (log_file_.empty()) return;
    try {
        check_distinct({{"--log", log_file_}}, files);
    } catch (const InputError&) {
        close_message_log();
        throw;
    }
}

} // namespace parhelion
