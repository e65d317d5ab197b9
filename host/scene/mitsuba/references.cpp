// Tying <ref> elements to the objects they name.
#include "host/scene/mitsuba/references.h"

#include "host/scene/text.h"

namespace parhelion::mitsuba {

namespace {

constexpr std::size_t max_nesting = 64;

void resolve(Document& document, const IdTable& ids) {
    const auto leads_nowhere = [&](Child& child) {
        if (child.reference.empty()) return false;
        return !document.problems.attempt([&] {
            const auto target = ids.find(child.reference);
            if (target == ids.end())
                refuse(child.location,
                       "<ref>: there is no object with the id " + in_quotes(child.reference));
            child.object = target->second;
        });
    };
    for (Object& object : document.objects)
        std::erase_if(object.children, leads_nowhere);
}

/// Depth first, without recursion; chains of references are kept short, because the readers of
/// plugins follow them by recursion.
void refuse_cycles(const Document& document) {
    enum class State { unseen, open, closed };
    struct Step {
        std::size_t object;
        std::size_t next_child;
    };
    std::vector<State> states(document.objects.size(), State::unseen);
    for (std::size_t start = 0; start < states.size(); ++start) {
        if (states[start] != State::unseen) continue;
        std::vector<Step> path{{start, 0}};
        states[start] = State::open;
        while (!path.empty()) {
            Step& top = path.back();
            const std::vector<Child>& children = document.objects[top.object].children;
            if (top.next_child == children.size()) {
                states[top.object] = State::closed;
                path.pop_back();
                continue;
            }
            const Child& child = children[top.next_child++];
            if (states[child.object] == State::open)
                refuse(child.location, "the reference to " + in_quotes(child.reference) +
                                           " closes a circle: an object would contain itself");
            if (states[child.object] == State::closed) continue;
            if (path.size() > max_nesting)
                refuse(child.location, "objects refer to each other more than " +
                                           std::to_string(max_nesting) + " deep");
            states[child.object] = State::open;
            path.push_back({child.object, 0});
        }
    }
}

} // namespace

void resolve_references(Document& document, const IdTable& ids) {
    resolve(document, ids);
    refuse_cycles(document);
}

} // namespace parhelion::mitsuba
