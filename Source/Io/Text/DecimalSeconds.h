// SPDX-License-Identifier: MIT
// Converts between decimal seconds as text and whole nanoseconds, digit by digit, so that no time is rounded
// through a double.
#pragma once
#include "Core/Limits.h"
#include "Io/Text/NumberText.h"
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace physvib {

/// Appends `nanoseconds` as seconds with nine decimals, e.g. 0.250000000. Any thread.
inline void appendSeconds(std::string& out, std::int64_t nanoseconds) {
    constexpr std::uint64_t perSecond = 1'000'000'000;
    const auto bits = static_cast<std::uint64_t>(nanoseconds);
    const std::uint64_t magnitude = nanoseconds < 0 ? 0 - bits : bits;
    if (nanoseconds < 0) out += '-';
    appendNumber(out, magnitude / perSecond);
    const std::size_t point = out.size();
    appendNumber(out, perSecond + magnitude % perSecond); // the extra 1 in front keeps the zeros
    out[point] = '.';
}

namespace detail {

/// "-3" of "1.5e-3" as a number, 0 without an exponent; nullopt if it is malformed or too large.
inline std::optional<std::int64_t> decimalExponent(std::string_view text, std::size_t mark) noexcept {
    if (mark == std::string_view::npos) return 0;
    std::string_view digits = text.substr(mark + 1);
    if (digits.starts_with('+')) {
        digits.remove_prefix(1);
        if (digits.starts_with('-')) return std::nullopt;
    }
    return parseNumber<std::int32_t>(digits);
}

} // namespace detail

/// Parses seconds to nanoseconds, 0 to limits::maxTimeNs: digits with an optional point and exponent, no
/// sign. Decimals beyond the ninth are rounded exactly, half to even. nullopt for anything else. Any thread.
inline std::optional<std::int64_t> parseSeconds(std::string_view text) noexcept {
    const std::size_t mark = text.find_first_of("eE");
    const std::string_view mantissa = text.substr(0, mark);
    const std::size_t wholeDigits = std::min(mantissa.find('.'), mantissa.size());
    const auto exponent = detail::decimalExponent(text, mark);
    if (!exponent || mantissa.empty() || mantissa == ".") return std::nullopt;

    // This many digits are whole nanoseconds, the next one is tenths.
    const std::int64_t kept = static_cast<std::int64_t>(wholeDigits) + *exponent + 9;
    std::int64_t nanoseconds = 0;
    std::int64_t position = 0;
    int tenths = 0;
    bool beyondTenths = false;
    for (std::size_t i = 0; i < mantissa.size(); ++i) {
        if (i == wholeDigits) continue; // the point
        const int digit = mantissa[i] - '0';
        if (digit < 0 || digit > 9 || nanoseconds > limits::maxTimeNs) return std::nullopt;
        if (position < kept)
            nanoseconds = nanoseconds * 10 + digit;
        else if (position == kept)
            tenths = digit;
        else
            beyondTenths |= digit != 0;
        ++position;
    }
    for (; position < kept && nanoseconds != 0; ++position) {
        if (nanoseconds > limits::maxTimeNs) return std::nullopt;
        nanoseconds *= 10;
    }
    const bool up = tenths > 5 || (tenths == 5 && (beyondTenths || nanoseconds % 2 != 0));
    nanoseconds += up ? 1 : 0;
    return nanoseconds <= limits::maxTimeNs ? std::optional(nanoseconds) : std::nullopt;
}

} // namespace physvib
