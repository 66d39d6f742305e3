// SPDX-License-Identifier: MIT
// CRC-16/CCITT-FALSE (polynomial 0x1021, start 0xFFFF), the check of every frame on the board link.
#pragma once
#include <cstdint>
#include <span>

namespace physvib {

/// Bit by bit: 22-byte frames at 115,200 bit/s do not pay for a table in flash. Any thread.
constexpr std::uint16_t crc16(std::span<const std::uint8_t> bytes) noexcept {
    std::uint16_t crc = 0xFFFF;
    for (const std::uint8_t byte : bytes) {
        crc = static_cast<std::uint16_t>(crc ^ (byte << 8));
        for (int bit = 0; bit < 8; ++bit)
            crc = static_cast<std::uint16_t>((crc & 0x8000) != 0 ? (crc << 1) ^ 0x1021 : crc << 1);
    }
    return crc;
}

} // namespace physvib
