// SPDX-License-Identifier: MIT
// What std::to_chars asks for when it writes so many decimals, by printf, which is exact as well: the library's own tables for it are a hundred
// kilobytes. The linker puts these in their place (--wrap).
#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdio>

static std::to_chars_result printed(char* first, char* last, const char* form, double number, std::uint32_t precision) {
    char text[1500]; // 309 digits, a point, and as many decimals as an exact double has
    const int length = std::snprintf(text, sizeof text, form, static_cast<int>(precision), number);
    if (length < 0 || length >= static_cast<int>(sizeof text) || length > last - first) return {last, std::errc::value_too_large};
    return {std::copy_n(text, length, first), std::errc{}};
}

extern "C" {
std::to_chars_result __wrap__ZNSt3__220__d2fixed_buffered_nEPcS0_dj(char* first, char* last, double number, std::uint32_t precision) { // NOLINT(bugprone-reserved-identifier)
    return printed(first, last, "%.*f", number, precision);
}
std::to_chars_result __wrap__ZNSt3__218__d2exp_buffered_nEPcS0_dj(char* first, char* last, double number, std::uint32_t precision) { // NOLINT(bugprone-reserved-identifier)
    return printed(first, last, "%.*e", number, precision);
}
}
