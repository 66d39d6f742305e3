// SPDX-License-Identifier: MIT
// Model of the two TLC7528 converters on port C, wired as in Docs/board.md: latches codes and checks the
// timing of their lines.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

namespace physvib::virtualboard {

/// Required times in ns, assumed for a 5 V supply; Docs/board.md says which of them were verified with TI
/// SLAS062B.
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

} // namespace physvib::virtualboard
