// SPDX-License-Identifier: MIT
// Accidents that happen to files.
#pragma once
#include <cstddef>
#include <random>
#include <string>
#include <string_view>

namespace physvib {

/// 0 <= number < below.
inline std::size_t anyIndex(std::mt19937& random, std::size_t below) { return random() % below; }

/// `text` after 1 to 4 small accidents: a byte changed, removed, doubled, a piece cut out, moved, or the end
/// lost.
inline std::string mutated(std::string text, std::string_view alphabet, std::mt19937& random) {
    for (std::size_t accidents = 1 + anyIndex(random, 4); accidents > 0 && !text.empty(); --accidents) {
        const std::size_t at = anyIndex(random, text.size());
        const std::size_t length = 1 + anyIndex(random, 12);
        const std::string piece = text.substr(at, length);
        switch (anyIndex(random, 7)) {
        case 0: text[at] = static_cast<char>(random() & 0xff); break;
        case 1: text[at] = alphabet[anyIndex(random, alphabet.size())]; break;
        case 2: text.insert(at, 1, alphabet[anyIndex(random, alphabet.size())]); break;
        case 3: text.erase(at, length); break;
        case 4: text.insert(at, piece); break;
        case 5: text.insert(anyIndex(random, text.size()), piece); break;
        default: text.resize(at); break;
        }
    }
    return text;
}

/// `bytes` after an accident to a number: one that is written in digits becomes an extreme one, or some bytes
/// in a row all bits set, the highest one, none.
inline std::string withExtreme(std::string bytes, std::mt19937& random) {
    constexpr std::string_view written[] = {
        "0",   "-1",   "1e9", "-1e308", "1e400", "5e-324", "4294967296", "99999999999999999999",
        "0.1", "null", "[]",  "{}",     "\"\""};
    const std::size_t from =
        bytes.find_first_of("0123456789", bytes.empty() ? 0 : anyIndex(random, bytes.size()));
    if (from != std::string::npos && random() % 4 != 0)
        return bytes.replace(from, bytes.find_first_not_of("0123456789.eE+-", from) - from,
                             written[anyIndex(random, std::size(written))]);
    constexpr char values[] = {'\xff', '\x7f', '\x80', '\0'};
    const char value = values[anyIndex(random, std::size(values))];
    const std::size_t at = bytes.empty() ? 0 : anyIndex(random, bytes.size());
    for (std::size_t i = at, end = at + (std::size_t{1} << anyIndex(random, 4)); i < end && i < bytes.size();
         ++i)
        bytes[i] = value;
    return bytes;
}

} // namespace physvib
