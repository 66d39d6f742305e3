// SPDX-License-Identifier: MIT
// Converts between decimal seconds as text and whole nanoseconds, without rounding through a double.
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
    constexpr std::uint64_t nsPerSecond = 1'000'000'000;
    const auto unsignedNs = static_cast<std::uint64_t>(nanoseconds);
    const std::uint64_t magnitude = nanoseconds < 0 ? 0 - unsignedNs : unsignedNs;
    if (nanoseconds < 0) out += '-';
    appendNumber(out, magnitude / nsPerSecond);
    const std::size_t point = out.size();
    appendNumber(out, nsPerSecond + magnitude % nsPerSecond); // ten digits 1xxxxxxxxx, zeros kept; 1 becomes
                                                              // .
    out[point] = '.';
}

namespace detail {

/// The exponent, e.g. -3 of "1.5e-3", whose e is at `exponentAt`; 0: none; nullopt: invalid.
inline std::optional<std::int64_t> decimalExponent(std::string_view text, std::size_t exponentAt) noexcept {
    if (exponentAt == std::string_view::npos) return 0;
    std::string_view digits = text.substr(exponentAt + 1);
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
    const std::size_t exponentAt = text.find_first_of("eE");
    const std::string_view mantissa = text.substr(0, exponentAt);
    const std::size_t wholeDigits = std::min(mantissa.find('.'), mantissa.size());
    const auto exponent = detail::decimalExponent(text, exponentAt);
    if (!exponent || mantissa.empty() || mantissa == ".") return std::nullopt;

    // Number of digits that are whole nanoseconds; the next one is tenths, all others only break ties.
    const std::int64_t nsDigits = static_cast<std::int64_t>(wholeDigits) + *exponent + 9;
    std::int64_t nanoseconds = 0;
    std::int64_t digitCount = 0;
    int tenths = 0;
    bool hasRemainder = false;
    for (std::size_t i = 0; i < mantissa.size(); ++i) {
        if (i == wholeDigits) continue; // the point
        const int digit = mantissa[i] - '0';
        if (digit < 0 || digit > 9 || nanoseconds > limits::maxTimeNs) return std::nullopt;
        if (digitCount < nsDigits)
            nanoseconds = nanoseconds * 10 + digit;
        else if (digitCount == nsDigits)
            tenths = digit;
        else
            hasRemainder |= digit != 0;
        ++digitCount;
    }
    for (; digitCount < nsDigits && nanoseconds != 0; ++digitCount) {
        if (nanoseconds > limits::maxTimeNs) return std::nullopt;
        nanoseconds *= 10;
    }
    const bool roundsUp = tenths > 5 || (tenths == 5 && (hasRemainder || nanoseconds % 2 != 0));
    nanoseconds += roundsUp ? 1 : 0;
    return nanoseconds <= limits::maxTimeNs ? std::optional(nanoseconds) : std::nullopt;
}

} // namespace physvib
