// The list of all numbers that plugins take, each with its domain.
//
// Readers find the domain of a number here, docs/parameters.md is written from it, and a test walks
// the ends of each.
#pragma once

#include "host/domain.h"

#include <span>
#include <string>
#include <string_view>

namespace parhelion::mitsuba {

/// How a file writes it.
enum class NumberForm {
    real,   ///< <float> or <integer>
    whole,  ///< <integer>
    color,  ///< <rgb>, <spectrum> or <float>: each of its values
    vector, ///< <point> or <vector>: each of its coordinates
    text,   ///< <string> with a number in it
    step,   ///< in an element inside <transform>, or a pair inside <spectrum>
};

struct NumberParameter {
    std::string_view tag; ///< "bsdf"; "transform": of its elements
    std::string plugins;  ///< those of the tag that have it, between blanks
    std::string_view name;
    NumberForm form;
    Domain domain;
    std::string_view also{}; ///< a condition that is not the number's alone
};

std::span<const NumberParameter> number_parameters();

/// Throws std::logic_error for a number that is not in the list.
const NumberParameter& number_parameter(std::string_view tag, std::string_view plugin,
                                        std::string_view name);

/// The domain of an attribute of an element inside <transform>.
const Domain& step_domain(std::string_view element, std::string_view attribute);

} // namespace parhelion::mitsuba
