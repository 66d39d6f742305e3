// SPDX-License-Identifier: MIT
// String functions common to the CSV readers: trimming, splitting, byte order marks. All for any thread.
#pragma once
#include <algorithm>
#include <cstddef>
#include <string_view>

namespace physvib {

inline std::string_view trimmed(std::string_view text) noexcept {
    constexpr std::string_view whitespace = " \t\r";
    const std::size_t first = text.find_first_not_of(whitespace);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(whitespace) - first + 1);
}

/// Removes the text before the next `end`, and `end` itself, from the front of `rest`; returns the text.
inline std::string_view takeUntil(char end, std::string_view& rest) noexcept {
    const std::size_t length = std::min(rest.find(end), rest.size());
    const std::string_view text = rest.substr(0, length);
    rest.remove_prefix(std::min(length + 1, rest.size()));
    return text;
}

inline void dropByteOrderMark(std::string_view& text) noexcept {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
}

} // namespace physvib
