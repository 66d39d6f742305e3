// SPDX-License-Identifier: MIT
// std::from_chars for floating-point numbers, which clang 19's library lacks; included before code that
// parses numbers.
#pragma once
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <system_error>

namespace std { // replaces what the library lacks

// Uses strtod, which rounds correctly and has a single locale here; rejects what from_chars does not accept.
inline from_chars_result from_chars(const char* first, const char* last, double& value) {
    const string text(first, last);
    const bool isSigned = !text.empty() && text[0] == '-',
               isHex = text.size() > size_t{isSigned} + 1 && (text[isSigned + 1U] | 32) == 'x';
    const char start = text.empty() ? ' ' : text[0];
    if (start == '+' || (start >= '\t' && start <= '\r') || start == ' ')
        return {first, errc::invalid_argument};
    char* end = nullptr;
    errno = 0;
    const double read = strtod(text.c_str(), &end);
    if (end == text.c_str()) return {first, errc::invalid_argument};
    // stop after the 0 that precedes the x
    if (isHex) return value = isSigned ? -0.0 : 0.0, from_chars_result{first + isSigned + 1, errc{}};
    const char* const stop = first + (end - text.c_str());
    if (errno == ERANGE && !(read > -1.0 && read < 1.0)) return {stop, errc::result_out_of_range};
    value = read;
    return {stop, errc{}};
}

} // namespace std
