// SPDX-License-Identifier: MIT
// Register access of the peripheral models, by address as in RM0364.
#include "Peripherals.h"
#include <algorithm>
#include <utility>

namespace physvib::virtualboard {
namespace {

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

} // namespace

std::uint32_t Peripherals::read(std::uint32_t a, std::uint64_t cycle) {
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

void Peripherals::write(std::uint32_t a, std::uint32_t value, unsigned bytes, std::uint64_t cycle) {
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

void Peripherals::writePort(std::uint32_t output, std::uint64_t cycle) {
    portOutput_ = output;
    setPins(cycle);
}

void Peripherals::setPins(std::uint64_t cycle) {
    std::uint32_t pins = 0;
    // undriven lines are pulled up
    for (int i = 0; i < 12; ++i) pins |= (portMode_ >> (2 * i) & 3) == 1 ? portOutput_ & 1u << i : 1u << i;
    if (!converters.levels(pins, static_cast<double>(cycle) * 1e9 / hz())) return;
    if (timerNext_ == never) return; // mid-scale during start-up
    frames.push_back(converters.codes());
    frameCycles.push_back(cycle);
}

std::uint32_t Peripherals::serialState() const {
    return (received_ ? 1u << 5 : 0) | (overrun_ ? 1u << 3 : 0) | (holding_ ? 0 : 1u << 7) |
           (shiftEnd_ == never ? 1u << 6 : 0);
}

void Peripherals::transmit(std::uint32_t byte, std::uint64_t cycle) {
    if (shiftEnd_ != never) {
        heldByte_ = static_cast<std::uint8_t>(byte);
        holding_ = true;
        return;
    }
    shifting_ = static_cast<std::uint8_t>(byte);
    shiftEnd_ = cycle + cyclesPerByte();
}

void Peripherals::lineIn(std::uint8_t byte, std::uint64_t cycle) {
    lineFree_ = std::max(lineFree_ + cyclesPerByte(), cycle);
    toCome_.push_back({lineFree_, byte});
}

void Peripherals::advance(std::uint64_t cycle) {
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

std::uint64_t Peripherals::nextEvent() const {
    return std::min({timerNext_, toCome_.empty() ? never : toCome_.front().cycle, shiftEnd_, watchdogEnd_});
}

int Peripherals::pendingInterrupt(int than) const {
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

void Peripherals::reset(bool byWatchdog) {
    plain_.clear();
    priorities_.fill(0);
    enabled_ = 0;
    serialControl_ = timerControl_ = 0;
    portMode_ = portOutput_ = 0;
    timerFlag_ = received_ = overrun_ = holding_ = false;
    timerNext_ = watchdogEnd_ = shiftEnd_ = never;
    resetByWatchdog_ = byWatchdog;
}

} // namespace physvib::virtualboard
