// Going on after what cannot be used, so that all that is wrong with an input is said at once.
#pragma once

#include "host/error.h"

#include <cstddef>
#include <string>
#include <vector>

namespace parhelion {

class Problems {
public:
    /// Does `act`, and keeps the InputError that comes out of it. Whether none did.
    template<typename Act>
    bool attempt(const Act& act) {
        try {
            act();
            return true;
        } catch (const InputError& error) {
            add(error);
            return false;
        }
    }

    /// Line by line; what is there already is not said twice.
    void add(const InputError& error);

    bool empty() const { return lines_.empty(); }

    /// Throws InputError with a line for each, in their order, where there are any. A damaged file
    /// can have any number of them: the first 100, and how many there are more.
    void throw_if_any() const;

private:
    static constexpr std::size_t most_told = 100;

    std::vector<std::string> lines_;
    std::size_t untold_ = 0;
};

} // namespace parhelion
