// SPDX-License-Identifier: MIT
// Packets that did not come. A host sends one in each millisecond of the bus; those are numbered, so a number
// that is left out is a packet that was lost on the way.
#pragma once
#include <cstdint>

namespace physvib::pico {

/// Main loop only.
class MissingPackets {
public:
    /// `number`: the bus' count of milliseconds, 11 bits, at a packet. True: packets are missing before it.
    bool see(std::uint32_t number, bool isPlaying) noexcept {
        const std::uint32_t between = (number - last_ - 1) & numbers;
        last_ = number;
        // The same number again: the packet before was looked at late. A stream that begins misses nothing.
        if (!isPlaying || between == 0 || between > numbers / 2) return false;
        count_ += between;
        return true;
    }
    std::uint32_t count() const noexcept { return count_; }

private:
    static constexpr std::uint32_t numbers = 0x7ff;
    std::uint32_t last_ = 0, count_ = 0;
};

} // namespace physvib::pico
