// The number of an option, out of its text.
#include "host/commands/option_number.h"

#include "host/error.h"
#include "host/scene/text.h"

#include <fmt/format.h>

namespace parhelion {

std::string option_name(const Option& option) {
    std::size_t last = option.names.rfind(',');
    std::string name = option.names.substr(last == std::string::npos ? 0 : last + 1);
    return name.substr(name.starts_with('!') ? 1 : 0);
}

double option_number(const Option& option, const std::string& text) {
    const Domain& domain = option.rules.domain.value();
    std::optional<double> value = parse_number(text);
    if (value) value = placed(domain, *value);
    if (!value)
        throw InputError(fmt::format("command line: {} is {} (accepted: {})", option_name(option),
                                     in_quotes(text), accepted_text(domain)));
    return *value;
}

} // namespace parhelion
