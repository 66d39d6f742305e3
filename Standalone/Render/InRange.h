// SPDX-License-Identifier: MIT
// Numbers that an option takes. CLI11's own checks let "nan" pass, which is not less than the least; these say what they expect.
#pragma once
#include <CLI/CLI.hpp>
#include <cmath>
#include <string>

namespace physvib {

/// From `low` to `high`, both inclusive. `unit` with the space before it.
template <class T>
CLI::Validator inRange(T low, T high, const std::string& unit = "") {
    const std::string range = CLI::detail::to_string(low) + " to " + CLI::detail::to_string(high) + unit;
    return {[=](std::string& text) {
                T value{};
                const bool isNumber = CLI::detail::lexical_cast(text, value);
                return isNumber && value >= low && value <= high ? std::string{} : "expected " + range + ", found \"" + text + "\"";
            },
            range};
}

/// Above 0, and finite.
inline CLI::Validator positive() {
    return {[](std::string& text) {
                double value = 0.0;
                const bool isNumber = CLI::detail::lexical_cast(text, value);
                return isNumber && value > 0.0 && std::isfinite(value) ? std::string{} : "expected more than 0, found \"" + text + "\"";
            },
            "POSITIVE"};
}

} // namespace physvib
