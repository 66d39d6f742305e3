// SPDX-License-Identifier: MIT
// Formats numbers by <charconv>, with digits in groups of three.
#include "Io/Text/ReadableNumber.h"
#include "Core/Limits.h"
#include "Core/Units.h"
#include "Io/Text/NumberText.h"
#include <algorithm>
#include <cmath>

namespace physvib::readable {

namespace {
constexpr const char* minus = "\xe2\x88\x92";
}

std::string number(double value, int decimals) {
    if (!std::isfinite(value)) return value < 0.0 ? "\xe2\x88\x92\xe2\x88\x9e" : "?";
    const std::string digits = fixedNumber(std::abs(value), decimals);
    const bool isNegative = value < 0.0 && digits.find_first_of("123456789") != std::string::npos;
    const std::size_t whole = std::min(digits.find('.'), digits.size());
    std::string text = isNegative ? minus : "";
    for (std::size_t i = 0; i < digits.size(); ++i) {
        if (i > 0 && i < whole && (whole - i) % 3 == 0) text += ',';
        text += digits[i];
    }
    return text;
}

std::string shortNumber(double value) {
    const double magnitude = std::abs(value);
    const int decimals = magnitude >= 100.0 ? 0 : magnitude >= 10.0 ? 1 : magnitude >= 1.0 ? 2 : 3;
    std::string digits = number(value, decimals);
    if (digits.find('.') == std::string::npos) return digits;
    digits.erase(digits.find_last_not_of('0') + 1);
    if (digits.ends_with('.')) digits.pop_back();
    return digits;
}

double decibels(double amplitude) { return toDecibels(std::abs(amplitude)); }

std::string decibelText(double amplitude) {
    return decibels(amplitude) < -limits::retireDecibels ? "silent"
                                                         : number(decibels(amplitude), 1).append(" dBFS");
}

} // namespace physvib::readable
