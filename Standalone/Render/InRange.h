// SPDX-License-Identifier: MIT
// Numbers that an option takes. CLI11's own checks let "nan" pass, which is not less than the least; these
// say what they expect.
#pragma once
#include <CLI/CLI.hpp>
#include <string>

namespace physvib {

/// From `low` to `high`, both inclusive. `unit` with the space before it.
template <class T>
CLI::Validator inRange(T low, T high, const std::string& unit = "") {
    const std::string range = CLI::detail::to_string(low) + " to " + CLI::detail::to_string(high) + unit;
    return {[=](std::string& text) {
                T value{};
                const bool isNumber = CLI::detail::lexical_cast(text, value);
                return isNumber && value >= low && value <= high
                           ? std::string{}
                           : "expected " + range + ", found \"" + text + "\"";
            },
            range};
}

} // namespace physvib
