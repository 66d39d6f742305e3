// SPDX-License-Identifier: GPL-3.0-or-later
// "1,2,3" to numbers: what options with one value per enchanter are given as.
#pragma once
#include <charconv>
#include <string>
#include <vector>

namespace physvib {

/// Appends the numbers of `text`, separated by commas; false if it holds anything else or nothing.
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
