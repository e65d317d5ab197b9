// Named parameters of a scene: <default>, -D name=value and $name in attributes.
#pragma once

#include "host/error.h"

#include <map>
#include <set>
#include <string>
#include <string_view>

namespace parhelion::mitsuba {

class Substitution {
public:
    explicit Substitution(std::map<std::string, std::string> given) : values_(std::move(given)) {}

    /// A value for `name` unless one is there already.
    void add_default(const std::string& name, const std::string& value) {
        values_.emplace(name, value);
    }

    /// `text` with every $name replaced (the longest known name that fits) and \$ turned into $.
    /// Throws InputError at `place` for a name without value.
    std::string apply(std::string_view text, const SourceLocation& place);

    /// Given names that nothing used.
    bool used(const std::string& name) const { return used_.contains(name); }

private:
    std::string_view longest_name(std::string_view text) const;

    std::map<std::string, std::string> values_;
    std::set<std::string> used_;
};

} // namespace parhelion::mitsuba
