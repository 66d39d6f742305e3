// SPDX-License-Identifier: MIT
// std::to_chars for floating-point numbers by printf, which is exact too: the tables of the C++ library would
// add 100 KB to the module. The linker substitutes these functions (--wrap).
#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

static std::to_chars_result printNumber(char* first, char* last, const char* format, double number,
                                        std::uint32_t precision) {
    char text[1500]; // 309 digits, a point, and the 1,074 decimals of an exact double
    const int length = std::snprintf(text, sizeof text, format, static_cast<int>(precision), number);
    if (length < 0 || length >= static_cast<int>(sizeof text) || length > last - first)
        return {last, std::errc::value_too_large};
    return {std::copy_n(text, length, first), std::errc{}};
}

namespace {

constexpr int maxDigits = 17; // enough to restore any double

/// The fewest digits that restore a number, and its decimal exponent in the format d.ddd; powers of two far
/// from 1 may get one digit more.
struct ShortestDecimal {
    int digits, exponent;
};
ShortestDecimal findShortestDecimal(double number) {
    char text[32];
    int digits = maxDigits;
    for (int low = 1, high = maxDigits; low <= high;) { // binary search: more digits restore it too
        const int middle = (low + high) / 2;
        std::snprintf(text, sizeof text, "%.*e", middle - 1, number);
        if (std::strtod(text, nullptr) == number)
            high = middle - 1, digits = middle;
        else
            low = middle + 1;
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
                                                                                 std::chars_format format) {
    const auto [digits, exponent] = findShortestDecimal(number);
    const int power = exponent - digits + 1; // power of ten of the last digit
    const bool isFixed = digits == 1 ? power >= -3 && power <= 4 : power >= -digits - 3 && power <= 5;
    if (format == std::chars_format::fixed || (format == std::chars_format{} && isFixed))
        return printNumber(first, last, "%.*f", number, static_cast<std::uint32_t>(std::max(0, -power)));
    return printNumber(first, last, "%.*e", number, static_cast<std::uint32_t>(digits - 1));
}
// NOLINTNEXTLINE(bugprone-reserved-identifier)
std::to_chars_result __wrap__ZNSt3__220__d2fixed_buffered_nEPcS0_dj(char* first, char* last, double number,
                                                                    std::uint32_t precision) {
    return printNumber(first, last, "%.*f", number, precision);
}
// NOLINTNEXTLINE(bugprone-reserved-identifier)
std::to_chars_result __wrap__ZNSt3__218__d2exp_buffered_nEPcS0_dj(char* first, char* last, double number,
                                                                  std::uint32_t precision) {
    return printNumber(first, last, "%.*e", number, precision);
}
}
