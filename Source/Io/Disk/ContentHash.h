// SPDX-License-Identifier: MIT
// Hash that identifies content: sixteen hexadecimal digits of FNV-1a, against mistakes, not against forgery.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace physvib {

/// The 64-bit FNV-1a hash of `bytes`. Any thread.
inline std::string contentHash(std::string_view bytes) {
    std::uint64_t hash = 0xCBF29CE484222325u;
    for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3u;
    constexpr std::string_view digits = "0123456789abcdef";
    std::string text;
    for (int shift = 60; shift >= 0; shift -= 4) text += digits[hash >> shift & 15];
    return text;
}

} // namespace physvib
