// SPDX-License-Identifier: MIT
// Models of the STM32F334 peripherals that the firmware uses, driven by processor cycles.
#pragma once
#include "Converters.h"
#include <cstdint>
#include <deque>
#include <unordered_map>
#include <vector>

namespace physvib::virtualboard {

/// A byte on the line, and the cycle at which its last bit ends.
struct LineByte {
    std::uint64_t cycle = 0;
    std::uint8_t value = 0;
};

class Peripherals {
public:
    static constexpr std::uint64_t never = ~std::uint64_t{0};
    bool hasCrystal = true;

    std::uint32_t read(std::uint32_t address, std::uint64_t cycle);
    void write(std::uint32_t address, std::uint32_t value, unsigned bytes, std::uint64_t cycle);

    /// Advances the peripherals to `cycle`.
    void advance(std::uint64_t cycle);
    /// Cycle of the next event.
    std::uint64_t nextEvent() const;

    /// Number of the enabled, pending interrupt with the lowest priority value, if that is below `than`; -1:
    /// none.
    int pendingInterrupt(int than) const;
    int priority(int interrupt) const { return priorities_[static_cast<std::size_t>(interrupt)]; }

    /// The processor clock after start-up.
    double hz() const { return hasCrystal ? 72e6 : 64e6; }
    std::uint64_t cyclesPerByte() const { return static_cast<std::uint64_t>(hz() * 10 / 115200); }

    /// Queues a byte whose last bit ends at `cycle` or when the line is free.
    void lineIn(std::uint8_t byte, std::uint64_t cycle);

    /// Resets like the processor; the converters keep their codes.
    void reset(bool byWatchdog);
    bool watchdogExpired(std::uint64_t cycle) const { return cycle >= watchdogEnd_; }
    void brownOut() { brownOut_ = true; }

    std::deque<LineByte> lineOut;          ///< the reader removes bytes
    std::vector<Converters::Frame> frames; ///< one per sample
    std::vector<std::uint64_t> frameCycles;
    Converters converters;
    std::uint64_t timerOverruns = 0; ///< sample interrupts not served before the next
    std::uint64_t lineOverruns = 0;
    bool ledIsOn = false;

private:
    void writePort(std::uint32_t output, std::uint64_t cycle);
    void setPins(std::uint64_t cycle);
    std::uint32_t serialState() const;
    void transmit(std::uint32_t byte, std::uint64_t cycle);

    std::unordered_map<std::uint32_t, std::uint32_t> plain_; // registers without side effects
    std::uint32_t serialControl_ = 0, timerControl_ = 0;     // read for every instruction block
    std::uint64_t enabled_ = 0;
    std::array<std::uint8_t, 82> priorities_{};
    std::uint32_t portOutput_ = 0, portMode_ = 0;
    bool timerFlag_ = false, brownOut_ = false, resetByWatchdog_ = false;
    std::uint64_t timerStart_ = 0, timerNext_ = never, watchdogEnd_ = never;
    std::deque<LineByte> toCome_;
    std::uint64_t lineFree_ = 0;
    bool received_ = false, overrun_ = false, holding_ = false;
    std::uint8_t receivedByte_ = 0, heldByte_ = 0, shifting_ = 0;
    std::uint64_t shiftEnd_ = never;
};

} // namespace physvib::virtualboard
