// SPDX-License-Identifier: MIT
// CRC-16/CCITT-FALSE (polynomial 0x1021, start 0xFFFF), the checksum of every frame on the board link.
#pragma once
#include <cstdint>
#include <span>

namespace physvib {

/// Byte by byte without a table: the eight division steps by x^16 + x^12 + x^5 + 1 reduce to a few shifts,
/// because only the first term reaches the byte that is divided out. Any thread.
constexpr std::uint16_t crc16(std::span<const std::uint8_t> bytes) noexcept {
    unsigned crc = 0xFFFF;
    for (const std::uint8_t byte : bytes) {
        unsigned x = (crc >> 8 ^ byte) & 0xFF;
        x ^= x >> 4;
        crc = (crc << 8 ^ x << 12 ^ x << 5 ^ x) & 0xFFFF;
    }
    return static_cast<std::uint16_t>(crc);
}

} // namespace physvib
