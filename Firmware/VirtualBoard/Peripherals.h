// SPDX-License-Identifier: MIT
// Models of the STM32F334 peripherals that the firmware uses and of its converters, driven by processor
// cycles.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <limits>
#include <unordered_map>
#include <utility>
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

    /// Sets the levels of PC0 to PC11 from `ns` on. True if the last code of a frame was latched.
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

// Registers, as in RM0364.
namespace address {
constexpr std::uint32_t tim6Cr1 = 0x40001000, tim6Dier = 0x4000100C, tim6Sr = 0x40001010,
                        tim6Cnt = 0x40001024, tim6Arr = 0x4000102C, iwdgKr = 0x40003000, iwdgRlr = 0x40003008,
                        usart1 = 0x40013800, usart2 = 0x40004400, rccCr = 0x40021000, rccCfgr = 0x40021004,
                        rccCsr = 0x40021024, portAOdr = 0x48000014, portABsrr = 0x48000018,
                        portCModer = 0x48000800, portCOdr = 0x48000814, portCBsrr = 0x48000818,
                        dwtCycles = 0xE0001004, nvicEnable = 0xE000E100, nvicPriority = 0xE000E400,
                        nvicPriorityEnd = nvicPriority + 82;
} // namespace address
constexpr int tim6 = 54, usart1Line = 37, usart2Line = 38, pvd = 1;
constexpr std::uint32_t receiveEnable = 1u << 5, sendEnable = 1u << 7;
constexpr std::uint32_t isUsart(std::uint32_t a) {
    return (a & ~0x3FFu) == (address::usart1 & ~0x3FFu) || (a & ~0x3FFu) == (address::usart2 & ~0x3FFu);
}
constexpr double watchdogHz = 10000; // 40 kHz / 4

class Peripherals {
public:
    static constexpr std::uint64_t never = ~std::uint64_t{0};
    bool hasCrystal = true;

    std::uint32_t read(std::uint32_t a, std::uint64_t cycle) {
        if (isUsart(a)) {
            const std::uint32_t offset = a & 0x3FF;
            if (offset == 0x1C) return serialState();
            if (offset == 0x24) {
                received_ = false;
                return receivedByte_;
            }
        }
        switch (a) {
        case address::tim6Sr: return timerFlag_ ? 1 : 0;
        case address::tim6Cnt:
            return timerNext_ == never
                       ? 0
                       : static_cast<std::uint32_t>((cycle - timerStart_) % (plain_[address::tim6Arr] + 1));
        case address::rccCr:
            return plain_[a] | (hasCrystal && (plain_[a] & 1u << 16) ? 1u << 17 : 0) |
                   (plain_[a] & 1u << 24 ? 1u << 25 : 0) | 3;
        case address::rccCfgr: return plain_[a] | (plain_[a] & 3u) << 2;
        case address::rccCsr: return resetByWatchdog_ ? 1u << 29 : 1u << 27;
        case address::portCModer: return portMode_;
        case address::portCOdr: return portOutput_;
        case address::dwtCycles: return static_cast<std::uint32_t>(cycle);
        default: return plain_[a];
        }
    }
    void write(std::uint32_t a, std::uint32_t value, unsigned bytes, std::uint64_t cycle) {
        if (a >= address::nvicPriority && a < address::nvicPriorityEnd) {
            for (unsigned i = 0; i < bytes; ++i)
                priorities_[a - address::nvicPriority + i] = static_cast<std::uint8_t>(value >> (8 * i));
            return;
        }
        if (isUsart(a) && (a & 0x3FF) == 0x20) overrun_ = overrun_ && !(value & 1u << 3);
        if (isUsart(a) && (a & 0x3FF) == 0x28) return transmit(value, cycle);
        plain_[a] = value;
        if (isUsart(a) && (a & 0x3FF) == 0) serialControl_ = value; // the firmware uses one of the two
        switch (a) {
        case address::tim6Dier: timerControl_ = value; break;
        case address::tim6Sr: timerFlag_ = timerFlag_ && (value & 1); break;
        case address::tim6Cr1:
            if (value & 1) timerStart_ = cycle, timerNext_ = cycle + plain_[address::tim6Arr] + 1;
            break;
        case address::iwdgKr:
            if (value == 0xCCCC || (value == 0xAAAA && watchdogEnd_ != never))
                watchdogEnd_ = cycle + static_cast<std::uint64_t>(
                                           (plain_[address::iwdgRlr] ? plain_[address::iwdgRlr] : 4095) *
                                           (hz() / watchdogHz));
            break;
        case address::nvicEnable: enabled_ |= value; break;
        case address::nvicEnable + 4: enabled_ |= static_cast<std::uint64_t>(value) << 32; break;
        case address::portABsrr: ledIsOn = (value & 1u << 5) || (ledIsOn && !(value & 1u << 21)); break;
        case address::portCModer:
            portMode_ = value;
            setPins(cycle);
            break;
        case address::portCOdr: writePort(value, cycle); break;
        case address::portCBsrr: writePort((portOutput_ & ~(value >> 16)) | (value & 0xFFFF), cycle); break;
        default: break;
        }
    }

    /// Advances the peripherals to `cycle`.
    void advance(std::uint64_t cycle) {
        while (timerNext_ <= cycle) {
            timerOverruns += timerFlag_ ? 1 : 0;
            timerFlag_ = true;
            timerNext_ += plain_[address::tim6Arr] + 1;
        }
        for (; !toCome_.empty() && toCome_.front().cycle <= cycle; toCome_.pop_front()) {
            if (!(serialControl_ & 1)) continue; // not enabled
            if (received_)
                overrun_ = true, ++lineOverruns; // the new byte is lost
            else
                receivedByte_ = toCome_.front().value, received_ = true;
        }
        while (shiftEnd_ <= cycle) {
            lineOut.push_back({shiftEnd_, shifting_});
            if (holding_)
                shifting_ = heldByte_, shiftEnd_ += cyclesPerByte(), holding_ = false;
            else
                shiftEnd_ = never;
        }
    }
    /// Cycle of the next event.
    std::uint64_t nextEvent() const {
        return std::min(
            {timerNext_, toCome_.empty() ? never : toCome_.front().cycle, shiftEnd_, watchdogEnd_});
    }

    /// Number of the enabled, pending interrupt with the lowest priority value, if below `than`; -1: none.
    int pendingInterrupt(int than) const {
        const bool serial = ((received_ || overrun_) && (serialControl_ & receiveEnable)) ||
                            (!holding_ && (serialControl_ & sendEnable));
        const bool timer = timerFlag_ && (timerControl_ & 1);
        if (!serial && !timer && !brownOut_) return -1;
        int best = -1;
        for (const auto& [line, isUp] :
             {std::pair{pvd, brownOut_}, {usart1Line, serial}, {usart2Line, serial}, {tim6, timer}})
            if (isUp && (enabled_ >> line & 1) && priority(line) < than) best = line, than = priority(line);
        return best;
    }
    int priority(int interrupt) const { return priorities_[static_cast<std::size_t>(interrupt)]; }

    /// The processor clock after start-up.
    double hz() const { return hasCrystal ? 72e6 : 64e6; }
    std::uint64_t cyclesPerByte() const { return static_cast<std::uint64_t>(hz() * 10 / 115200); }

    /// Queues a byte whose last bit ends at `cycle` or when the line is free.
    void lineIn(std::uint8_t byte, std::uint64_t cycle) {
        lineFree_ = std::max(lineFree_ + cyclesPerByte(), cycle);
        toCome_.push_back({lineFree_, byte});
    }

    /// Resets like the processor; the converters keep their codes.
    void reset(bool byWatchdog) {
        plain_.clear();
        priorities_.fill(0);
        enabled_ = 0;
        serialControl_ = timerControl_ = 0;
        portMode_ = portOutput_ = 0;
        timerFlag_ = received_ = overrun_ = holding_ = false;
        timerNext_ = watchdogEnd_ = shiftEnd_ = never;
        resetByWatchdog_ = byWatchdog;
    }
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
    void writePort(std::uint32_t output, std::uint64_t cycle) {
        portOutput_ = output;
        setPins(cycle);
    }
    void setPins(std::uint64_t cycle) {
        std::uint32_t pins = 0;
        // undriven lines are pulled up
        for (int i = 0; i < 12; ++i)
            pins |= (portMode_ >> (2 * i) & 3) == 1 ? portOutput_ & 1u << i : 1u << i;
        if (!converters.levels(pins, static_cast<double>(cycle) * 1e9 / hz())) return;
        if (timerNext_ == never) return; // mid-scale during start-up
        frames.push_back(converters.codes());
        frameCycles.push_back(cycle);
    }
    std::uint32_t serialState() const {
        return (received_ ? 1u << 5 : 0) | (overrun_ ? 1u << 3 : 0) | (holding_ ? 0 : 1u << 7) |
               (shiftEnd_ == never ? 1u << 6 : 0);
    }
    void transmit(std::uint32_t byte, std::uint64_t cycle) {
        if (shiftEnd_ != never) {
            heldByte_ = static_cast<std::uint8_t>(byte);
            holding_ = true;
            return;
        }
        shifting_ = static_cast<std::uint8_t>(byte);
        shiftEnd_ = cycle + cyclesPerByte();
    }

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
