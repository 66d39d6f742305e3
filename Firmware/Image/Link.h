// SPDX-License-Identifier: MIT
// The board's side of the link: SerialPort transfers bytes, Link executes messages and sends replies.
#pragma once
#include "Core/BoardRenderer.h"
#include "Outputs.h"
#include "Registers.h"
#include "Wire/FrameDecoder.h"
#include "Wire/Messages.h"
#include "Wire/SelfTest.h"
#include <array>
#include <cstdint>
#include <span>

namespace physvib::board {

/// A time of the board's clock.
struct Moment {
    std::uint32_t frame = 0;
    std::uint8_t fraction = 0; ///< 1/256 frame
};

class SerialPort {
public:
    void start(const Clock& clock, const Outputs& outputs) noexcept {
        outputs_ = &outputs;
        cyclesPerFrame_ = clock.cyclesPerFrame();
#ifdef PHYSVIB_BLUETOOTH
        reg(rcc::cfgr3) |= 1; // USART1 uses the processor clock
        reg(rcc::apb2enr) |= 1u << 14;
        reg(gpio::a + gpio::afrh) = (reg(gpio::a + gpio::afrh) & ~0xFF0u) | 0x770u; // PA9, PA10
        reg(gpio::a + gpio::moder) = (reg(gpio::a + gpio::moder) & ~(0xFu << 18)) | 0xAu << 18;
        const std::uint32_t hz = clock.hz;
#else
        reg(rcc::apb1enr) |= 1u << 17;
        reg(gpio::a + gpio::afrl) = (reg(gpio::a + gpio::afrl) & ~0xFF00u) | 0x7700u; // PA2, PA3
        reg(gpio::a + gpio::moder) = (reg(gpio::a + gpio::moder) & ~(0xFu << 4)) | 0xAu << 4;
        const std::uint32_t hz = clock.hz / 2;
#endif
        reg(port + usart::brr) = (hz + wire::lineBitsPerSecond / 2) / wire::lineBitsPerSecond;
        reg(port + usart::cr1) = enabled;
        enableInterrupt(number, 1);
    }

    /// Reads a byte; false if there is none. `ended`: time at which the byte arrived, set for zeros only,
    /// which end a message. Main loop.
    bool take(std::uint8_t& byte, Moment& ended) noexcept {
        if (readAt_ == receivedAt_) return false;
        byte = received_[readAt_ % received_.size()];
        readAt_ = readAt_ + 1;
        if (byte == 0) ended = zeros_[zerosTaken_++ % zeros_.size()];
        return true;
    }

    /// Queues all bytes, or none if they do not fit. Main loop.
    bool send(std::span<const std::uint8_t> bytes) noexcept {
        if (toSend_.size() - static_cast<std::uint8_t>(putAt_ - sentAt_) < bytes.size() + 1) return false;
        for (const std::uint8_t byte : bytes) {
            toSend_[putAt_ % toSend_.size()] = byte;
            putAt_ = static_cast<std::uint8_t>(putAt_ + 1);
        }
        reg(port + usart::cr1) = enabled | wantsToSend;
        return true;
    }

    /// Number of bytes lost because they came faster than they were read.
    std::uint32_t overruns() const noexcept { return overruns_; }

    /// Called by the USART interrupt.
    void serve() noexcept {
        constexpr std::uint32_t overrun = 1u << 3, arrived = 1u << 5, empty = 1u << 7;
        const std::uint32_t state = reg(port + usart::isr);
        if (state & arrived) receive(static_cast<std::uint8_t>(reg(port + usart::rdr)));
        if (state & 0xF) {
            if (state & overrun) overruns_ = overruns_ + 1;
            reg(port + usart::icr) = 0xF; // parity, framing, noise, overrun: the CRC detects damaged messages
        }
        if ((state & empty) && (reg(port + usart::cr1) & wantsToSend)) sendNext();
    }

    Moment now() const noexcept {
        std::uint32_t frame, count;
        do {
            frame = outputs_->played();
            count = reg(tim6::cnt);
        } while (frame != outputs_->played()); // repeat if the sample timer's interrupt came between
        return {frame, static_cast<std::uint8_t>(count * 256u / cyclesPerFrame_)};
    }

#ifdef PHYSVIB_BLUETOOTH
    static constexpr int number = irq::usart1;
#else
    static constexpr int number = irq::usart2;
#endif

private:
#ifdef PHYSVIB_BLUETOOTH
    static constexpr std::uint32_t port = usart::usart1;
#else
    static constexpr std::uint32_t port = usart::usart2;
#endif
    // UE, RE, TE, RXNEIE
    static constexpr std::uint32_t wantsToSend = 1u << 7, enabled = 1u | 1u << 2 | 1u << 3 | 1u << 5;

    void receive(std::uint8_t byte) noexcept {
        if (static_cast<std::uint8_t>(receivedAt_ + 1) == readAt_) {
            overruns_ = overruns_ + 1;
            return;
        }
        if (byte == 0) zeros_[zerosSeen_++ % zeros_.size()] = now();
        received_[receivedAt_] = byte;
        receivedAt_ = static_cast<std::uint8_t>(receivedAt_ + 1);
    }

    void sendNext() noexcept {
        if (sentAt_ == putAt_) {
            reg(port + usart::cr1) = enabled;
            return;
        }
        reg(port + usart::tdr) = toSend_[sentAt_ % toSend_.size()];
        sentAt_ = static_cast<std::uint8_t>(sentAt_ + 1);
    }

    const Outputs* outputs_ = nullptr;
    std::uint32_t cyclesPerFrame_ = 1;
    std::array<volatile std::uint8_t, 256> received_{}; // 22 ms of the line; 8-bit indices wrap
    std::array<std::uint8_t, 128> toSend_{};
    std::array<Moment, 16> zeros_{}; // may be late in a flood of empty frames
    volatile std::uint8_t receivedAt_ = 0, readAt_ = 0, putAt_ = 0, sentAt_ = 0;
    std::uint8_t zerosSeen_ = 0, zerosTaken_ = 0;
    volatile std::uint32_t overruns_ = 0;
};

/// Values that only the start-up code knows: clock, resets, free stack.
struct Machine {
    Clock clock;
    std::uint8_t watchdogResets = 0;
    std::uint16_t (*stackFree)() = nullptr;
};

/// Main loop only.
class Link {
public:
    void start(const Machine& machine, BoardRenderer& renderer, Outputs& outputs,
               SerialPort& serial) noexcept;

    /// Executes received messages; silences the board when none has come for too long.
    void poll() noexcept;

    /// Called before and after each block of the renderer, for the self-test and its times.
    void beforeBlock() noexcept;
    void afterBlock(BoardRenderer::Codes& block, std::uint32_t cycles) noexcept;

    bool isSilenced() const noexcept { return silenced_; }

private:
    void handle(std::span<const std::uint8_t> payload, Moment ended) noexcept;
    void greet(const wire::Hello& hello) noexcept;
    template <class Event>
    void play(std::uint8_t sequence, const Event& event) noexcept;
    void sendTelemetry() noexcept;
    void stopAll() noexcept;
    void watch() noexcept;
    template <class Message>
    void send(const Message& message) noexcept;

    Machine machine_;
    BoardRenderer* renderer_ = nullptr;
    Outputs* outputs_ = nullptr;
    SerialPort* serial_ = nullptr;
    wire::FrameDecoder decoder_;
    wire::SelfTestRun selfTest_;
    std::uint32_t heardAt_ = 0; // frame number of the last message
    std::uint32_t watchdogFrames_ = 0;
    std::uint32_t worstBlockCycles_ = 0;
    wire::StrikeOrder order_;
    bool greeted_ = false, silenced_ = true;
};

} // namespace physvib::board
