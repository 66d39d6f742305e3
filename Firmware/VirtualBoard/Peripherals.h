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

/// Required times in ns, assumed for a 5 V supply; Docs/board.md says which were verified with TI SLAS062B.
struct RequiredTimes {
    double selectSetUp = 50, dataSetUp = 25, writePulse = 50, hold = 10;
};

/// The shortest times observed.
struct ObservedTimes {
    double selectSetUp = std::numeric_limits<double>::infinity(), dataSetUp = selectSetUp,
           writePulse = selectSetUp, hold = selectSetUp;
    long writes = 0, violations = 0;
};

/// Model of the two TLC7528 on port C (Docs/board.md): latches their codes, and checks the lines' times.
class Converters {
public:
    using Frame = std::array<std::uint8_t, 4>;

    /// Sets the levels of PC0 to PC11 from `ns` on. True if the last code of a frame was latched.
    bool drive(std::uint32_t pins, double ns) {
        const std::uint32_t changed = pins ^ pinLevels_;
        if (changed & (latch | chips)) checkHold(ns), selectChangedNs_ = ns;
        if (changed & data) checkHold(ns), dataChangedNs_ = ns;
        const bool falls = (changed & write) && !(pins & write), rises = (changed & write) && (pins & write);
        const std::uint32_t before = pinLevels_;
        pinLevels_ = pins;
        if (falls) {
            writeFellNs_ = ns;
            checkTime(observed_.selectSetUp, ns - selectChangedNs_, required_.selectSetUp);
        }
        // The latches are transparent while the write line is low.
        if (!(pins & write) || rises) updateLatches(rises ? before : pins);
        if (!rises) return false;
        ++observed_.writes;
        writeRoseNs_ = ns;
        checkTime(observed_.writePulse, ns - writeFellNs_, required_.writePulse);
        checkTime(observed_.dataSetUp, ns - dataChangedNs_, required_.dataSetUp);
        return !(before & chip2) && (before & latch);
    }

    const Frame& codes() const { return codes_; }
    const ObservedTimes& observedTimes() const { return observed_; }

private:
    static constexpr std::uint32_t data = 0xFF, latch = 1u << 8, write = 1u << 9, chip1 = 1u << 10,
                                   chip2 = 1u << 11, chips = chip1 | chip2;

    void updateLatches(std::uint32_t pins) {
        const auto code = static_cast<std::uint8_t>(pins & data);
        const std::size_t select = (pins & latch) ? 1 : 0;
        if (!(pins & chip1)) codes_[select] = code;
        if (!(pins & chip2)) codes_[2 + select] = code;
    }

    void checkHold(double ns) {
        if (writeRoseNs_ >= 0) checkTime(observed_.hold, ns - writeRoseNs_, required_.hold);
        if (!(pinLevels_ & write)) ++observed_.violations; // a line changed while the latch was transparent
        writeRoseNs_ = -1;
    }

    void checkTime(double& shortest, double observed, double required) {
        shortest = std::min(shortest, observed);
        if (observed < required) ++observed_.violations;
    }

    RequiredTimes required_;
    ObservedTimes observed_;
    Frame codes_{};
    std::uint32_t pinLevels_ = 0xFFF; // pull-ups while the processor does not drive the lines
    double selectChangedNs_ = -1e9, dataChangedNs_ = -1e9, writeFellNs_ = -1e9, writeRoseNs_ = -1;
};

/// A byte on the line, and the cycle at which its last bit ends.
struct TimedByte {
    std::uint64_t cycle = 0;
    std::uint8_t value = 0;
};

// Registers, as in RM0364.
namespace registers {
constexpr std::uint32_t tim6Cr1 = 0x40001000, tim6Dier = 0x4000100C, tim6Sr = 0x40001010,
                        tim6Cnt = 0x40001024, tim6Arr = 0x4000102C, iwdgKr = 0x40003000, iwdgRlr = 0x40003008,
                        usart1 = 0x40013800, usart2 = 0x40004400, rccCr = 0x40021000, rccCfgr = 0x40021004,
                        rccCsr = 0x40021024, portAOdr = 0x48000014, portABsrr = 0x48000018,
                        portCModer = 0x48000800, portCOdr = 0x48000814, portCBsrr = 0x48000818,
                        dwtCycles = 0xE0001004, nvicEnable = 0xE000E100, nvicPriority = 0xE000E400,
                        nvicPriorityEnd = nvicPriority + 82;
} // namespace registers
constexpr int tim6 = 54, usart1Line = 37, usart2Line = 38, pvd = 1;
constexpr std::uint32_t receiveEnable = 1u << 5, sendEnable = 1u << 7;
constexpr std::uint32_t isUsart(std::uint32_t a) {
    return (a & ~0x3FFu) == (registers::usart1 & ~0x3FFu) || (a & ~0x3FFu) == (registers::usart2 & ~0x3FFu);
}
constexpr double watchdogHz = 10000; // 40 kHz / 4

/// Timer, UART, ports, watchdog and interrupt controller. Times are processor cycles since power-on.
class Peripherals {
public:
    static constexpr std::uint64_t never = ~std::uint64_t{0};
    bool hasCrystal = true;

    std::uint32_t read(std::uint32_t address, std::uint64_t cycle) {
        if (isUsart(address)) {
            const std::uint32_t offset = address & 0x3FF;
            if (offset == 0x1C) return serialState();
            if (offset == 0x24) {
                hasReceived_ = false;
                return receivedByte_;
            }
        }
        switch (address) {
        case registers::tim6Sr: return isTimerPending_ ? 1 : 0;
        case registers::tim6Cnt:
            return timerNext_ == never ? 0
                                       : static_cast<std::uint32_t>((cycle - timerStart_) %
                                                                    (registers_[registers::tim6Arr] + 1));
        case registers::rccCr:
            return registers_[address] | (hasCrystal && (registers_[address] & 1u << 16) ? 1u << 17 : 0) |
                   (registers_[address] & 1u << 24 ? 1u << 25 : 0) | 3;
        case registers::rccCfgr: return registers_[address] | (registers_[address] & 3u) << 2;
        case registers::rccCsr: return wasResetByWatchdog_ ? 1u << 29 : 1u << 27;
        case registers::portCModer: return portMode_;
        case registers::portCOdr: return portOutput_;
        case registers::dwtCycles: return static_cast<std::uint32_t>(cycle);
        default: return registers_[address];
        }
    }
    void write(std::uint32_t address, std::uint32_t value, unsigned bytes, std::uint64_t cycle) {
        if (address >= registers::nvicPriority && address < registers::nvicPriorityEnd) {
            for (unsigned i = 0; i < bytes; ++i)
                priorities_[address - registers::nvicPriority + i] =
                    static_cast<std::uint8_t>(value >> (8 * i));
            return;
        }
        if (isUsart(address) && (address & 0x3FF) == 0x20) hasOverrun_ = hasOverrun_ && !(value & 1u << 3);
        if (isUsart(address) && (address & 0x3FF) == 0x28) return transmit(value, cycle);
        registers_[address] = value;
        if (isUsart(address) && (address & 0x3FF) == 0) serialControl_ = value; // one of the two
        switch (address) {
        case registers::tim6Dier: timerControl_ = value; break;
        case registers::tim6Sr: isTimerPending_ = isTimerPending_ && (value & 1); break;
        case registers::tim6Cr1:
            if (value & 1) timerStart_ = cycle, timerNext_ = cycle + registers_[registers::tim6Arr] + 1;
            break;
        case registers::iwdgKr:
            if (value == 0xCCCC || (value == 0xAAAA && watchdogEndCycle_ != never))
                watchdogEndCycle_ =
                    cycle + static_cast<std::uint64_t>(
                                (registers_[registers::iwdgRlr] ? registers_[registers::iwdgRlr] : 4095) *
                                (hz() / watchdogHz));
            break;
        case registers::nvicEnable: enabled_ |= value; break;
        case registers::nvicEnable + 4: enabled_ |= static_cast<std::uint64_t>(value) << 32; break;
        case registers::portABsrr: isLedOn = (value & 1u << 5) || (isLedOn && !(value & 1u << 21)); break;
        case registers::portCModer:
            portMode_ = value;
            setPins(cycle);
            break;
        case registers::portCOdr: writePort(value, cycle); break;
        case registers::portCBsrr: writePort((portOutput_ & ~(value >> 16)) | (value & 0xFFFF), cycle); break;
        default: break;
        }
    }

    /// Advances the peripherals to `cycle`.
    void advance(std::uint64_t cycle) {
        while (timerNext_ <= cycle) {
            timerOverruns += isTimerPending_ ? 1 : 0;
            isTimerPending_ = true;
            timerNext_ += registers_[registers::tim6Arr] + 1;
        }
        for (; !incomingBytes_.empty() && incomingBytes_.front().cycle <= cycle; incomingBytes_.pop_front()) {
            if (!(serialControl_ & 1)) continue; // not enabled
            if (hasReceived_)
                hasOverrun_ = true, ++lineOverruns; // the new byte is lost
            else
                receivedByte_ = incomingBytes_.front().value, hasReceived_ = true;
        }
        while (shiftEndCycle_ <= cycle) {
            sentBytes.push_back({shiftEndCycle_, shiftedByte_});
            if (hasHeldByte_)
                shiftedByte_ = heldByte_, shiftEndCycle_ += cyclesPerByte(), hasHeldByte_ = false;
            else
                shiftEndCycle_ = never;
        }
    }
    /// Cycle of the next event.
    std::uint64_t nextEvent() const {
        return std::min({timerNext_, incomingBytes_.empty() ? never : incomingBytes_.front().cycle,
                         shiftEndCycle_, watchdogEndCycle_});
    }

    /// Number of the enabled, pending interrupt with the lowest priority value, if below `limit`; -1: none.
    int pendingInterrupt(int limit) const {
        const bool serial = ((hasReceived_ || hasOverrun_) && (serialControl_ & receiveEnable)) ||
                            (!hasHeldByte_ && (serialControl_ & sendEnable));
        const bool timer = isTimerPending_ && (timerControl_ & 1);
        if (!serial && !timer && !isBrownOut_) return -1;
        int best = -1;
        for (const auto& [line, isUp] :
             {std::pair{pvd, isBrownOut_}, {usart1Line, serial}, {usart2Line, serial}, {tim6, timer}})
            if (isUp && (enabled_ >> line & 1) && priority(line) < limit) best = line, limit = priority(line);
        return best;
    }
    int priority(int interrupt) const { return priorities_[static_cast<std::size_t>(interrupt)]; }

    /// The processor clock after start-up.
    double hz() const { return hasCrystal ? 72e6 : 64e6; }
    std::uint64_t cyclesPerByte() const { return static_cast<std::uint64_t>(hz() * 10 / 115200); }

    /// Queues a byte whose last bit ends at `cycle` or when the line is free.
    void queueByte(std::uint8_t byte, std::uint64_t cycle) {
        lineFreeCycle_ = std::max(lineFreeCycle_ + cyclesPerByte(), cycle);
        incomingBytes_.push_back({lineFreeCycle_, byte});
    }

    /// Resets like the processor; the converters keep their codes.
    void reset(bool byWatchdog) {
        registers_.clear();
        priorities_.fill(0);
        enabled_ = 0;
        serialControl_ = timerControl_ = 0;
        portMode_ = portOutput_ = 0;
        isTimerPending_ = hasReceived_ = hasOverrun_ = hasHeldByte_ = false;
        timerNext_ = watchdogEndCycle_ = shiftEndCycle_ = never;
        wasResetByWatchdog_ = byWatchdog;
    }
    bool isWatchdogExpired(std::uint64_t cycle) const { return cycle >= watchdogEndCycle_; }
    void brownOut() { isBrownOut_ = true; }

    std::deque<TimedByte> sentBytes;       ///< the reader removes bytes
    std::vector<Converters::Frame> frames; ///< one per sample
    std::vector<std::uint64_t> frameCycles;
    Converters converters;
    std::uint64_t timerOverruns = 0; ///< sample interrupts not served before the next
    std::uint64_t lineOverruns = 0;
    bool isLedOn = false;

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
        if (!converters.drive(pins, static_cast<double>(cycle) * 1e9 / hz())) return;
        if (timerNext_ == never) return; // mid-scale during start-up
        frames.push_back(converters.codes());
        frameCycles.push_back(cycle);
    }
    std::uint32_t serialState() const {
        return (hasReceived_ ? 1u << 5 : 0) | (hasOverrun_ ? 1u << 3 : 0) | (hasHeldByte_ ? 0 : 1u << 7) |
               (shiftEndCycle_ == never ? 1u << 6 : 0);
    }
    void transmit(std::uint32_t byte, std::uint64_t cycle) {
        if (shiftEndCycle_ != never) {
            heldByte_ = static_cast<std::uint8_t>(byte);
            hasHeldByte_ = true;
            return;
        }
        shiftedByte_ = static_cast<std::uint8_t>(byte);
        shiftEndCycle_ = cycle + cyclesPerByte();
    }

    std::unordered_map<std::uint32_t, std::uint32_t> registers_; // values as written
    std::uint32_t serialControl_ = 0, timerControl_ = 0;         // read for every instruction block
    std::uint64_t enabled_ = 0;
    std::array<std::uint8_t, 82> priorities_{};
    std::uint32_t portOutput_ = 0, portMode_ = 0;
    bool isTimerPending_ = false, isBrownOut_ = false, wasResetByWatchdog_ = false;
    std::uint64_t timerStart_ = 0, timerNext_ = never, watchdogEndCycle_ = never;
    std::deque<TimedByte> incomingBytes_;
    std::uint64_t lineFreeCycle_ = 0;
    bool hasReceived_ = false, hasOverrun_ = false, hasHeldByte_ = false;
    std::uint8_t receivedByte_ = 0, heldByte_ = 0, shiftedByte_ = 0;
    std::uint64_t shiftEndCycle_ = never;
};

} // namespace physvib::virtualboard
