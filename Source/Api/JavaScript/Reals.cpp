// SPDX-License-Identifier: MIT
// Writes numbers for std::to_chars with printf, which is exact too: the C++ library's tables would add 100 KB
// to the module. The linker substitutes these functions (--wrap).
#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

static std::to_chars_result printed(char* first, char* last, const char* form, double number,
                                    std::uint32_t precision) {
    char text[1500]; // 309 digits, a point, and the 1,074 decimals of an exact double
    const int length = std::snprintf(text, sizeof text, form, static_cast<int>(precision), number);
    if (length < 0 || length >= static_cast<int>(sizeof text) || length > last - first)
        return {last, std::errc::value_too_large};
    return {std::copy_n(text, length, first), std::errc{}};
}

namespace {

constexpr int mostDigits = 17; // enough to restore any double

/// The fewest digits that restore the number, as d.ddd with an exponent; for powers of two far from 1
/// possibly one more.
struct Shortest {
    int digits, exponent;
};
Shortest shortestOf(double number) {
    char text[32];
    int digits = mostDigits;
    for (int least = 1, most = mostDigits; least <= most;) { // binary search: more digits restore it too
        const int some = (least + most) / 2;
        std::snprintf(text, sizeof text, "%.*e", some - 1, number);
        if (std::strtod(text, nullptr) == number)
            most = some - 1, digits = some;
        else
            least = some + 1;
    }
    std::snprintf(text, sizeof text, "%.*e", digits - 1, number);
    return {digits, std::atoi(std::strchr(text, 'e') + 1)};
}

} // namespace

extern "C" {
// Without a format: fixed notation unless it is longer, as the standard requires.
// NOLINTNEXTLINE(bugprone-reserved-identifier)
std::to_chars_result __wrap__ZNSt3__216__d2s_buffered_nEPcS0_dNS_12chars_formatE(char* first, char* last,
                                                                                 double number,
                                                                                 std::chars_format form) {
    const auto [digits, exponent] = shortestOf(number);
    const int last10 = exponent - digits + 1; // power of ten of the last digit
    const bool isFixed = digits == 1 ? last10 >= -3 && last10 <= 4 : last10 >= -digits - 3 && last10 <= 5;
    if (form == std::chars_format::fixed || (form == std::chars_format{} && isFixed))
        return printed(first, last, "%.*f", number, static_cast<std::uint32_t>(std::max(0, -last10)));
    return printed(first, last, "%.*e", number, static_cast<std::uint32_t>(digits - 1));
}
// NOLINTNEXTLINE(bugprone-reserved-identifier)
std::to_chars_result __wrap__ZNSt3__220__d2fixed_buffered_nEPcS0_dj(char* first, char* last, double number,
                                                                    std::uint32_t precision) {
    return printed(first, last, "%.*f", number, precision);
}
// NOLINTNEXTLINE(bugprone-reserved-identifier)
std::to_chars_result __wrap__ZNSt3__218__d2exp_buffered_nEPcS0_dj(char* first, char* last, double number,
                                                                  std::uint32_t precision) {
    return printed(first, last, "%.*e", number, precision);
}
}
