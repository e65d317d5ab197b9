// Tests that need what is not there say so, and ctest counts them as skipped.
#pragma once

#include <string>

namespace parhelion::test {

/// Tells why what follows is left out. Of a program that passes, ctest then says that it was
/// skipped (skip_listener.cpp).
void skip(const std::string& reason);

} // namespace parhelion::test
