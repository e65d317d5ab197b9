// What of a scene file can be rendered as it is written.
#include "host/commands/scene_check.h"

#include "host/flatten/device_scene.h"
#include "host/safe_text.h"
#include "host/scene/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace parhelion {
namespace {

enum Status : std::size_t { exact, approximated, refused };
constexpr std::array status_names{"exact", "approximated", "refused"};

/// What reading a scene had to say.
struct Reading {
    std::vector<std::string> notes, problems;
};

/// As far as the kernels' records: values of images and sizes are seen only there.
Reading read(const std::string& file, const LoadOptions& options) {
    Reading reading;
    try {
        const Scene scene = load_scene(file, options);
        reading.notes = scene.notes;
        const DeviceScene flat = flatten_scene(scene);
        reading.notes.insert(reading.notes.end(), flat.notes.begin(), flat.notes.end());
    } catch (const InputError& error) {
        const std::string_view lines = error.what();
        const auto problems = split(lines, "\n");
        reading.problems.assign(problems.begin(), problems.end());
    }
    return reading;
}

/// None of what is no scene file; reading it says why.
std::vector<Construct> known_constructs(const std::string& file, const LoadOptions& options) {
    try {
        return scene_constructs(file, options);
    } catch (const InputError&) {
        return {};
    }
}

/// Which construct a message that begins with a place is about.
class Places {
public:
    explicit Places(const std::vector<Construct>& constructs) : constructs_(constructs) {
        for (std::size_t i = 0; i < constructs.size(); i++)
            for (const SourceLocation& place : constructs[i].places)
                at_[as_one_line(place.to_string())].push_back(i);
    }

    /// The text before its first colon that is a place, "" where there is none. File names may hold
    /// colons themselves.
    std::string place_of(const std::string& message) const {
        for (std::size_t end = message.find(": "); end != std::string::npos;
             end = message.find(": ", end + 1))
            if (std::string place = message.substr(0, end); at_.contains(place)) return place;
        return "";
    }

    /// Of several in one line that which the message names, or the last of a kind that it names, or
    /// the first.
    std::optional<std::size_t> construct_of(const std::string& message) const {
        const auto found = at_.find(place_of(message));
        if (found == at_.end()) return std::nullopt;
        const auto names = [&](const std::string& text) {
            return message.find(text) != std::string::npos;
        };
        std::optional<std::size_t> of_kind;
        for (std::size_t i : found->second) {
            const Construct& c = constructs_[i];
            if (names(fmt::format("{} plugin \"{}\"", c.kind, c.plugin))) return i;
            if (names(c.kind)) of_kind = i;
        }
        return of_kind.value_or(found->second.front());
    }

private:
    const std::vector<Construct>& constructs_;
    std::unordered_map<std::string, std::vector<std::size_t>> at_;
};

/// Kinds of constructs in the order of the file.
nlohmann::json counted(const std::vector<Construct>& constructs,
                       const std::vector<Status>& status) {
    std::map<std::pair<std::string, std::string>, std::size_t> known;
    nlohmann::json rows = nlohmann::json::array();
    for (std::size_t i = 0; i < constructs.size(); i++) {
        const Construct& c = constructs[i];
        auto [row, added] = known.try_emplace({c.kind, c.plugin}, rows.size());
        if (added)
            rows.push_back({{"kind", c.kind},
                            {"plugin", c.plugin},
                            {"exact", 0},
                            {"approximated", 0},
                            {"refused", 0}});
        nlohmann::json& count = rows[row->second][status_names[status[i]]];
        count = count.get<int>() + 1;
    }
    return rows;
}

/// What notes say, by their places; the first of each.
std::map<std::string, std::string> by_place(const Places& places,
                                            const std::vector<std::string>& notes) {
    std::map<std::string, std::string> texts;
    for (const std::string& note : notes)
        if (const std::string place = places.place_of(note); !place.empty())
            texts.try_emplace(place, note.substr(place.size() + 2));
    return texts;
}

} // namespace

nlohmann::json check_scene(const std::string& file, const LoadOptions& options) {
    const std::vector<Construct> constructs = known_constructs(file, options);
    const Places places(constructs);
    const Reading strict = read(file, options);
    LoadOptions leniently = options;
    leniently.lenient = true;
    Reading lenient;
    if (!strict.problems.empty() && !options.lenient) lenient = read(file, leniently);

    const std::map<std::string, std::string> instead = by_place(places, lenient.notes);

    std::vector<Status> status(constructs.size(), exact);
    nlohmann::json messages = nlohmann::json::array();
    Status worst = exact;
    std::set<std::string> told; // what is referred to twice can be read twice
    auto tell = [&](Status s, const std::string& text) {
        if (!told.insert(text).second) return;
        nlohmann::json message{{"status", status_names[s]}, {"text", text}};
        if (const auto i = places.construct_of(text)) {
            status[*i] = std::max(status[*i], s);
            message["construct"] = constructs[*i].kind + " " + constructs[*i].plugin;
        }
        if (const auto found = instead.find(places.place_of(text));
            s == refused && found != instead.end())
            message["leniently"] = found->second;
        worst = std::max(worst, s);
        messages.push_back(std::move(message));
    };
    // What the lenient reading makes of those is told with them.
    std::set<std::string> refused_places;
    for (const std::string& problem : strict.problems) {
        tell(refused, problem);
        refused_places.insert(places.place_of(problem));
    }
    for (const std::string& note : strict.problems.empty() ? strict.notes : lenient.notes)
        if (!refused_places.contains(places.place_of(note))) tell(approximated, note);
    nlohmann::json check{{"scene", file},
                         {"verdict", status_names[worst]},
                         {"constructs", counted(constructs, status)},
                         {"messages", messages}};
    if (worst == refused && !options.lenient) check["opens_leniently"] = lenient.problems.empty();
    return check;
}

std::string check_text(const nlohmann::json& check) {
    std::string text = fmt::format("{}: {}", as_one_line(check["scene"].get<std::string>()),
                                   check["verdict"].get<std::string>());
    if (check.contains("opens_leniently"))
        text += check["opens_leniently"].get<bool>() ? "; opens with --lenient"
                                                     : "; not even --lenient opens it";
    text += '\n';
    for (const char* status : status_names) {
        std::string names;
        for (const nlohmann::json& row : check["constructs"])
            if (int count = row[status].get<int>(); count > 0)
                names += fmt::format(
                    "{}{} {}{}", names.empty() ? "" : ", ", row["kind"].get<std::string>(),
                    row["plugin"].get<std::string>(), count > 1 ? fmt::format(" ({})", count) : "");
        if (!names.empty()) text += fmt::format("  {:<13} {}\n", status, as_one_line(names));
    }
    for (const nlohmann::json& message : check["messages"]) {
        text += fmt::format("{}: {}\n", message["status"].get<std::string>(),
                            as_one_line(message["text"].get<std::string>()));
        if (message.contains("leniently"))
            text += fmt::format("  leniently: {}\n",
                                as_one_line(message["leniently"].get<std::string>()));
    }
    return text;
}

ExitCode check_exit_code(const nlohmann::json& check) {
    const auto verdict = check["verdict"].get<std::string>();
    if (verdict == status_names[refused]) return ExitCode::bad_input;
    return verdict == status_names[approximated] ? ExitCode::different : ExitCode::ok;
}

} // namespace parhelion
