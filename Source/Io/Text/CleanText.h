// SPDX-License-Identifier: MIT
// Makes untrusted text safe to display as one line of UTF-8; decoding of UTF-8, and lower case.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace physvib {

/// The first character of a text: its code point and length; 0 bytes: none, or invalid UTF-8.
struct Utf8Character {
    std::uint32_t code = 0;
    std::size_t bytes = 0;
};

/// Decodes the first character of `text`. Any thread.
constexpr Utf8Character firstCharacter(std::string_view text) noexcept {
    if (text.empty()) return {};
    const auto lead = static_cast<unsigned char>(text.front());
    if (lead < 0x80) return {lead, 1};
    const std::size_t bytes = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
    if (lead < 0xc2 || lead > 0xf4 || text.size() < bytes) return {};
    std::uint32_t code = lead & (0x7fu >> bytes);
    for (std::size_t i = 1; i < bytes; ++i) {
        const auto next = static_cast<unsigned char>(text[i]);
        if ((next & 0xc0) != 0x80) return {};
        code = code << 6 | (next & 0x3f);
    }
    constexpr std::uint32_t minCode[] = {0, 0, 0x80, 0x800, 0x10000};
    const bool isSurrogate = code >= 0xd800 && code < 0xe000;
    return code < minCode[bytes] || code > 0x10ffff || isSurrogate ? Utf8Character{}
                                                                   : Utf8Character{code, bytes};
}

/// True for characters that a terminal or text box acts on instead of showing them: control characters, line
/// and paragraph separators, and marks of writing direction.
constexpr bool isControl(std::uint32_t code) noexcept {
    return code < 0x20 || (code >= 0x7f && code < 0xa0) || code == 0x200e || code == 0x200f ||
           (code >= 0x2028 && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
}

/// `text` with \xNN for every byte of invalid UTF-8 and of control characters. Any thread.
inline std::string cleanLine(std::string_view text) {
    constexpr std::string_view hex = "0123456789abcdef";
    std::string out;
    while (!text.empty()) {
        const auto [code, bytes] = firstCharacter(text);
        const bool isPrintable = bytes > 0 && !isControl(code);
        const std::string_view character = text.substr(0, bytes > 0 ? bytes : 1);
        text.remove_prefix(character.size());
        if (isPrintable)
            out += character;
        else
            for (const char c : character)
                out.append("\\x").append(1, hex[static_cast<unsigned char>(c) >> 4]).append(1, hex[c & 15]);
    }
    return out;
}

/// The text with A to Z as a to z; other characters stay. Any thread.
inline std::string lowerCase(std::string text) {
    for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + ('a' - 'A')) : c;
    return text;
}

} // namespace physvib
