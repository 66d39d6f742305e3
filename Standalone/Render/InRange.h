// SPDX-License-Identifier: MIT
// Range check for numeric options that rejects "nan", which CLI11's own checks accept, and whose message has
// the expected range.
#pragma once
#include <CLI/CLI.hpp>
#include <string>

namespace physvib {

/// Inclusive range; `unit` starts with a space.
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
