// What every reader promises for every input: an answer, or an InputError with lines to print.
#pragma once

#include "host/error.h"
#include "host/scene/meshes/mesh_data.h"

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace parhelion::fuzz {

/// Throws std::logic_error, which is a find, if `good` is false.
inline void promise(bool good, const char* what) {
    if (!good) throw std::logic_error(std::string("broken promise: ") + what);
}

/// A line that a terminal can show: not empty, no control characters.
inline void check_message(std::string_view message) {
    promise(!message.empty(), "a message is empty");
    for (const char c : message) {
        const auto byte = static_cast<unsigned char>(c);
        promise(byte >= 0x20 && byte != 0x7f, "a message holds a control character");
    }
}

/// Calls `use`, to which an InputError is as good as an answer. All else that it throws is a find.
template<class Use>
int answer_or_refusal(const Use& use) {
    try {
        use();
    } catch (const InputError& error) {
        std::string_view rest = error.what();
        for (std::size_t end; (end = rest.find('\n')) != rest.npos; rest.remove_prefix(end + 1))
            check_message(rest.substr(0, end));
        check_message(rest);
    }
    return 0;
}

/// As text: what a reader of text gets.
inline std::string_view as_text(const std::uint8_t* data, std::size_t size) {
    return size == 0 ? std::string_view()
                     : std::string_view(reinterpret_cast<const char*>(data), size);
}

/// What readers of meshes promise, and that make_mesh takes their meshes or refuses them.
void check_mesh_data(const MeshData& mesh);

/// What every mesh of a scene promises.
void check_mesh(const Mesh& mesh);

} // namespace parhelion::fuzz
