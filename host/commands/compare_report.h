// What `parhelion compare` prints.
#pragma once

#include "host/commands/compare.h"

#include <iosfwd>
#include <string>
#include <vector>

namespace parhelion {

/// A figure held against the limit the user gave for it.
struct Judgement {
    const char* name; ///< of the limit's option, without dashes
    double limit, measured;

    bool pass() const { return measured <= limit; }
};

/// Prints a table for people.
void print_comparison(std::ostream& out, const CompareOptions& options,
                      const Comparison& comparison, const std::vector<Judgement>& judgements);

/// The same as one JSON object with keys that stay; infinities are null.
std::string comparison_json(const CompareOptions& options, const Comparison& comparison,
                            const std::vector<Judgement>& judgements, bool pass);

} // namespace parhelion
