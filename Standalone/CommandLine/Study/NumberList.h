// SPDX-License-Identifier: GPL-3.0-or-later
// Parses lists such as "1,2,3", for options with one value per actuator.
#pragma once
#include <charconv>
#include <string>
#include <vector>

namespace physvib {

/// Appends the comma-separated numbers of `text`; false if it is empty or contains anything else.
template <class Number>
bool parseNumbers(const std::string& text, std::vector<Number>& numbers) {
    const char* const end = text.data() + text.size();
    for (const char* at = text.data();; ++at) {
        Number number{};
        const auto [stop, error] = std::from_chars(at, end, number);
        if (error != std::errc{} || (stop != end && *stop != ',')) return false;
        numbers.push_back(number);
        at = stop;
        if (at == end) return true;
    }
}

} // namespace physvib
