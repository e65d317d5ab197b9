// Where a render tells what it has to say: --progress, --quiet, --log.
#include "host/commands/render_messages.h"

#include "host/error.h"
#include "host/message_log.h"
#include "host/progress.h"
#include "host/streams.h"

namespace parhelion {

RenderMessages::RenderMessages(const RenderCommand& command) : log_file_(command.log_file) {
    close_message_log();
    const Progress::Mode mode = Progress::mode_of(command.progress, command.quiet);
    tell_messages_as(mode == Progress::Mode::json ? MessageForm::json : MessageForm::text);
    if (log_file_.empty()) return;
    std::vector<UsedFile> others{{"the scene", command.scene_file},
                                 {"--output", command.output},
                                 {"--stats", command.stats_file},
                                 {"--json", command.json_file}};
    for (const std::string& scene : command.scenes)
        others.push_back({"the scene", scene});
    check_distinct({{"--log", log_file_}}, others);
    open_message_log(log_file_);
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
