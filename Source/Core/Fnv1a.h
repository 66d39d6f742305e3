// SPDX-License-Identifier: MIT
// The hash function FNV-1a, for short names and lines: not for files, nor against forgery.
#pragma once
#include <cstdint>
#include <string_view>

namespace physvib {

/// 64 bits. `from`: the hash of what precedes `text`. Any thread.
constexpr std::uint64_t fnv1a(std::string_view text, std::uint64_t from = 0xcbf29ce484222325u) noexcept {
    for (const char c : text) from = (from ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    return from;
}

} // namespace physvib
