// SPDX-License-Identifier: MIT
// Conversion between numbers and text, the same in every locale; ordering of texts by the numbers in them;
// and quoting of untrusted text for error messages.
#pragma once
#include <algorithm>
#include <charconv>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace physvib {

/// Appends the shortest text that reads back as the same bits. Any thread.
template <class Number>
requires std::integral<Number> || std::floating_point<Number>
void appendNumber(std::string& out, Number number) {
    char digits[32]; // the longest shortest double has 24 characters
    out.append(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
}

/// The shortest text that reads back as the same bits. Any thread.
inline std::string numberText(double number) {
    std::string text;
    appendNumber(text, number);
    return text;
}

/// The number in `text`; nullopt if any of it is not part of a finite number in range. Any thread.
template <class Number>
requires std::integral<Number> || std::floating_point<Number> std::optional<Number>
parseNumber(std::string_view text)
noexcept {
    Number number{};
    const char* const end = text.data() + text.size();
    const auto [parsedEnd, code] = std::from_chars(text.data(), end, number);
    if (code != std::errc{} || parsedEnd != end || text.empty()) return std::nullopt;
    if constexpr (std::floating_point<Number>)
        if (!std::isfinite(number)) return std::nullopt;
    return number;
}

/// Natural order of texts: numbers in them by value ("level=70" before "level=140", "P9" before "P10"), all
/// else by bytes. Texts that differ are never equivalent. Any thread.
struct NaturalOrder {
    using is_transparent = void;
    bool operator()(std::string_view a, std::string_view b) const noexcept {
        const std::string_view fullA = a, fullB = b;
        for (char previous = ' '; !a.empty() && !b.empty();) {
            double x = 0.0, y = 0.0;
            const std::size_t lengthA = numberAt(previous, a, x), lengthB = numberAt(previous, b, y);
            if ((lengthA == 0) != (lengthB == 0)) return lengthA > 0; // numbers before other words
            if (lengthA > 0 ? x != y : a.front() != b.front())
                return lengthA > 0 ? x < y : a.front() < b.front();
            previous = lengthA > 0 ? '0' : a.front();
            a.remove_prefix(std::max<std::size_t>(lengthA, 1)),
                b.remove_prefix(std::max<std::size_t>(lengthB, 1));
        }
        return a.empty() && b.empty() ? fullA < fullB : a.empty();
    }

private:
    /// Length of the number at the start of `text`; 0: none. `previous` is the character before it:
    /// a hyphen is a minus sign only after '=' or a space.
    static std::size_t numberAt(char previous, std::string_view text, double& number) noexcept {
        const bool isSigned = text.starts_with('-') && (previous == ' ' || previous == '=');
        const auto isDigit = [](char c) { return c >= '0' && c <= '9'; };
        std::size_t length = isSigned ? 1 : 0;
        if (length == text.size() || !isDigit(text[length]) || isDigit(previous)) return 0;
        for (bool hasPoint = false; length < text.size(); ++length)
            if (!isDigit(text[length]) && (text[length] != '.' || std::exchange(hasPoint, true))) break;
        const auto found = parseNumber<double>(text.substr(0, length));
        number = found.value_or(0.0);
        return found ? length : 0;
    }
};

/// "1 trial", "2 trials". Any thread.
inline std::string plural(std::size_t number, std::string_view noun) {
    return std::to_string(number).append(" ").append(noun).append(number == 1 ? "" : "s");
}

/// A limit as a person writes it (1000000, not 1e+06), for messages. Any thread.
inline std::string plainNumber(double number) {
    char digits[340];
    return {digits, std::to_chars(digits, digits + sizeof digits, number, std::chars_format::fixed).ptr};
}

/// The number with that many decimals, for display: 4.81. Any thread.
inline std::string fixedNumber(double number, int decimals) {
    char digits[400];
    const auto end =
        std::to_chars(digits, digits + sizeof digits, number, std::chars_format::fixed, decimals).ptr;
    std::string text(digits, end);
    // -0.00 becomes 0.00
    return text.find_first_of("123456789") == std::string::npos && text.starts_with('-') ? text.substr(1)
                                                                                         : text;
}

/// At most 40 characters of `text`, with \xNN for all that is not printable ASCII. Any thread.
inline std::string printable(std::string_view text) {
    constexpr std::size_t maxLength = 40;
    constexpr std::string_view hex = "0123456789abcdef";
    std::string out;
    for (const char c : text.substr(0, maxLength)) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte >= 0x20 && byte < 0x7f)
            out += c;
        else
            out.append("\\x").append(1, hex[byte >> 4]).append(1, hex[byte & 15]);
    }
    return text.size() > maxLength ? out + "..." : out;
}

/// printable(text) in double quotes. Any thread.
inline std::string inQuotes(std::string_view text) {
    std::string out = "\"";
    return out.append(printable(text)).append("\"");
}

} // namespace physvib
