// Kernel source text: the embedded files put together.
#include "host/cl/source.h"

#include "host/cl/embedded_kernels.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>

namespace parhelion {
namespace {

std::string_view embedded_text(std::string_view path) {
    for (const EmbeddedFile& file : embedded_kernels())
        if (file.path == path) return file.text;
    throw std::logic_error(fmt::format("kernel file {} is not embedded", path));
}

/// The file named by an `#include "..."` line, or nothing.
std::string_view included_path(std::string_view line) {
    constexpr std::string_view directive = "#include \"";
    if (!line.starts_with(directive)) return {};
    line.remove_prefix(directive.size());
    return line.substr(0, line.find('"'));
}

void append_file(std::string_view path, std::set<std::string_view>& done, std::string& source);

void append_text(std::string_view path, std::string_view text, std::set<std::string_view>& done,
                 std::string& source) {
    source += fmt::format("#line 1 \"{}\"\n", path);
    int line_number = 0;
    while (!text.empty()) {
        std::size_t end = std::min(text.find('\n'), text.size());
        std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        line_number++;
        std::string_view include = included_path(line);
        if (include.empty()) {
            source.append(line).append("\n");
        } else {
            append_file(include, done, source);
            source += fmt::format("#line {} \"{}\"\n", line_number + 1, path);
        }
    }
}

void append_file(std::string_view path, std::set<std::string_view>& done, std::string& source) {
    if (done.insert(path).second) append_text(path, embedded_text(path), done, source);
}

} // namespace

std::string kernel_source(std::string_view name, std::string_view text) {
    std::set<std::string_view> done;
    std::string source;
    append_text(name, text, done, source);
    return source;
}

std::string kernel_source(const std::vector<std::string>& paths) {
    std::set<std::string_view> done;
    std::string source;
    for (const std::string& path : paths)
        append_file(path, done, source);
    return source;
}

} // namespace parhelion
