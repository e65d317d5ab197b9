// Where a render tells what it has to say: --progress, --quiet, --log.
#include "host/commands/render_messages.h"

#include "host/message_log.h"
#include "host/progress.h"
#include "host/streams.h"

namespace parhelion {

RenderMessages::RenderMessages(const RenderCommand& command) : log_file_(command.log_file) {
    close_message_log();
    const Progress::Mode mode = Progress::mode_of(command.progress, command.quiet);
    tell_messages_as(mode == Progress::Mode::json ? MessageForm::json : MessageForm::text);
    check_distinct_from({{"the scene", command.scene_file},
                         {"--output", command.output},
                         {"--stats", command.stats_file},
                         {"--json", command.json_file}});
    if (!log_file_.empty()) open_message_log(log_file_);
}

RenderMessages::~RenderMessages() {
    try {
        release_message_log();
    } catch (const std::exception&) { // no memory: the log stays as it is
    }
}

void RenderMessages::check_distinct_from(const std::vector<UsedFile>& files) const {
    try {
        check_distinct({{"--log", log_file_}}, files);
    } catch (const InputError&) {
        close_message_log();
        throw;
    }
    release_message_log();
}

} // namespace parhelion
