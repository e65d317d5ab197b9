// Kernel source text: the embedded files put together.
#pragma once

#include <string>
#include <string_view>

namespace parhelion {

/// The text of a kernel file (a path below kernels/, e.g. "shade.cl") with every #include replaced
/// by the file's text, once each, and #line directives so that compiler messages name the real file
/// and line.
std::string kernel_source(std::string_view path);

/// The same for a text that is not embedded (a test's kernel); `name` is what compiler messages
/// call it.
std::string kernel_source(std::string_view name, std::string_view text);

} // namespace parhelion
