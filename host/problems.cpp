// Going on after what cannot be used, so that all that is wrong with an input is said at once.
#include "host/problems.h"

#include <algorithm>
#include <sstream>

namespace parhelion {

void Problems::add(const InputError& error) {
    std::istringstream lines(error.what());
    for (std::string line; std::getline(lines, line);) {
        if (std::find(lines_.begin(), lines_.end(), line) != lines_.end()) continue;
        if (lines_.size() < most_told)
            lines_.push_back(line);
        else
            ++untold_;
    }
}

void Problems::throw_if_any() const {
    if (lines_.empty()) return;
    std::vector<std::string> told = lines_;
    if (untold_ > 0) told.push_back("and " + std::to_string(untold_) + " more");
    throw InputError(told);
}

} // namespace parhelion
