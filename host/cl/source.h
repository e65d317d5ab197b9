// Kernel source text: the embedded files put together.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace parhelion {

/// The text of kernel files (paths below kernels/, e.g. "shade.cl"), one after the other, with
/// every #include replaced by the file's text, once each, and #line directives so that compiler
/// messages name the real file and line.
std::string kernel_source(const std::vector<std::string>& paths);

/// The same for a text that is not embedded (a test's kernel); `name` is what compiler messages
/// call it.
std::string kernel_source(std::string_view name, std::string_view text);

} // namespace parhelion
