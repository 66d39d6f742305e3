// SPDX-License-Identifier: MIT
// Models of the STM32F334 peripherals that the firmware uses, driven by processor cycles.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <limits>
#include <unordered_map>
#include <vector>

namespace physvib::virtualboard {

// Model of the two TLC7528 converters on port C, wired as in Docs/board.md: latches codes and checks the
// timing of their lines.

/// Required times in ns, assumed for a 5 V supply; Docs/board.md says which were verified with TI SLAS062B.
struct ConverterTimes {
    double selectSetUp = 50, dataSetUp = 25, writePulse = 50, hold = 10;
};

/// The shortest times observed.
struct ConverterTimings {
    double selectSetUp = std::numeric_limits<double>::infinity(), dataSetUp = selectSetUp,
           writePulse = selectSetUp, hold = selectSetUp;
    long writes = 0, violations = 0;
};

class Converters {
public:
    using Frame = std::array<std::uint8_t, 4>;

    /// Sets the levels of PC0 to PC11 from `ns` on. True if this latched the last converter of a frame.
    bool levels(std::uint32_t pins, double ns) {
        const std::uint32_t changed = pins ^ pins_;
        if (changed & (latch | chips)) checkHold(ns), selectChanged_ = ns;
        if (changed & data) checkHold(ns), dataChanged_ = ns;
        const bool falls = (changed & write) && !(pins & write), rises = (changed & write) && (pins & write);
        const std::uint32_t before = pins_;
        pins_ = pins;
        if (falls) {
            writeFell_ = ns;
            note(timings_.selectSetUp, ns - selectChanged_, limits_.selectSetUp);
        }
        // The latches are transparent while the write line is low.
        if (!(pins & write) || rises) follow(rises ? before : pins);
        if (!rises) return false;
        ++timings_.writes;
        writeRose_ = ns;
        note(timings_.writePulse, ns - writeFell_, limits_.writePulse);
        note(timings_.dataSetUp, ns - dataChanged_, limits_.dataSetUp);
        return !(before & chip2) && (before & latch);
    }

    const Frame& codes() const { return codes_; }
    const ConverterTimings& timings() const { return timings_; }

private:
    static constexpr std::uint32_t data = 0xFF, latch = 1u << 8, write = 1u << 9, chip1 = 1u << 10,
                                   chip2 = 1u << 11, chips = chip1 | chip2;

    void follow(std::uint32_t pins) {
        const auto code = static_cast<std::uint8_t>(pins & data);
        const std::size_t select = (pins & latch) ? 1 : 0;
        if (!(pins & chip1)) codes_[select] = code;
        if (!(pins & chip2)) codes_[2 + select] = code;
    }

    void checkHold(double ns) {
        if (writeRose_ >= 0) note(timings_.hold, ns - writeRose_, limits_.hold);
        if (!(pins_ & write)) ++timings_.violations; // a line changed while the latch was transparent
        writeRose_ = -1;
    }

    void note(double& shortest, double seen, double wanted) {
        shortest = std::min(shortest, seen);
        if (seen < wanted) ++timings_.violations;
    }

    ConverterTimes limits_;
    ConverterTimings timings_;
    Frame codes_{};
    std::uint32_t pins_ = 0xFFF; // pull-ups while the processor does not drive the lines
    double selectChanged_ = -1e9, dataChanged_ = -1e9, writeFell_ = -1e9, writeRose_ = -1;
};

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

    /// Number of the enabled, pending interrupt with the lowest priority value, if below `than`; -1: none.
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
