// SPDX-License-Identifier: MIT
// Frames of the board link: their checksum, and their encoding without zero bytes.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

namespace physvib {

// CRC-16/CCITT-FALSE (polynomial 0x1021, start 0xFFFF).

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

// Consistent overhead byte stuffing (Cheshire and Baker, 1999): encodes frames without zero bytes, so that a
// zero marks the end of a frame.

/// Maximum encoded size of `payload` bytes, without the final zero.
constexpr std::size_t cobsMaxEncoded(std::size_t payload) noexcept { return payload + payload / 254 + 1; }

/// Writes the encoded payload to `out` (at least cobsMaxEncoded bytes); returns its length. Any thread.
constexpr std::size_t cobsEncode(std::span<const std::uint8_t> payload,
                                 std::span<std::uint8_t> out) noexcept {
    std::size_t code = 0, end = 1; // `code`: index of the length byte of the current group
    out[0] = 1;
    for (const std::uint8_t byte : payload) {
        if (out[code] == 0xFF) {
            code = end;
            out[end++] = 1;
        }
        if (byte == 0) {
            code = end;
            out[end++] = 1;
        } else {
            out[end++] = byte;
            ++out[code];
        }
    }
    return end;
}

/// Inverse of cobsEncode. Returns the payload's length; -1: invalid, or `out` too small. Any thread.
constexpr int cobsDecode(std::span<const std::uint8_t> frame, std::span<std::uint8_t> out) noexcept {
    std::size_t in = 0, end = 0;
    while (in < frame.size()) {
        const std::uint8_t group = frame[in++];
        if (group == 0 || in + group - 1 > frame.size()) return -1;
        for (int k = 1; k < group; ++k) {
            if (frame[in] == 0 || end == out.size()) return -1;
            out[end++] = frame[in++];
        }
        if (group == 0xFF || in == frame.size()) continue;
        if (end == out.size()) return -1;
        out[end++] = 0;
    }
    return static_cast<int>(end);
}

} // namespace physvib
