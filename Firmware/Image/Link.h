// SPDX-License-Identifier: MIT
// The board's side of the link: SerialPort transfers bytes, Link executes messages and sends replies.
#pragma once
#include "BoardOutputs.h"
#include "Core/BoardRenderer.h"
#include "Registers.h"
#include "Wire/FrameDecoder.h"
#include "Wire/Messages.h"
#include "Wire/SelfTest.h"
#include <array>
#include <cstdint>
#include <span>

namespace physvib::board {

/// A time of the board's clock.
struct FrameTime {
    std::uint32_t frame = 0;
    std::uint8_t fraction = 0; ///< 1/256 frame
};

/// The UART of the ST-Link, or of the Bluetooth module, with buffers for both directions.
class SerialPort {
public:
    void start(const Clock& clock, const FrameQueue& outputs) noexcept {
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
        enableInterrupt(interruptNumber, 1);
    }

    /// Reads a byte; false if there is none. `arrivedAt`: time at which the byte arrived, set for zeros only,
    /// which end a message. Main loop.
    bool readByte(std::uint8_t& byte, FrameTime& arrivedAt) noexcept {
        if (readIndex_ == receiveIndex_) return false;
        byte = receiveBuffer_[readIndex_ % receiveBuffer_.size()];
        readIndex_ = readIndex_ + 1;
        if (byte == 0) arrivedAt = zeroTimes_[zerosRead_++ % zeroTimes_.size()];
        return true;
    }

    /// Queues all bytes, or none if they do not fit. Main loop.
    bool send(std::span<const std::uint8_t> bytes) noexcept {
        if (sendBuffer_.size() - static_cast<std::uint8_t>(queueIndex_ - sendIndex_) < bytes.size() + 1)
            return false;
        for (const std::uint8_t byte : bytes) {
            sendBuffer_[queueIndex_ % sendBuffer_.size()] = byte;
            queueIndex_ = static_cast<std::uint8_t>(queueIndex_ + 1);
        }
        reg(port + usart::cr1) = enabled | sendInterruptEnabled;
        return true;
    }

    /// Number of bytes lost because they came faster than they were read.
    std::uint32_t overruns() const noexcept { return overruns_; }

    /// Called by the USART interrupt.
    void onInterrupt() noexcept {
        constexpr std::uint32_t overrun = 1u << 3, arrived = 1u << 5, empty = 1u << 7;
        const std::uint32_t state = reg(port + usart::isr);
        if (state & arrived) receive(static_cast<std::uint8_t>(reg(port + usart::rdr)));
        if (state & 0xF) {
            if (state & overrun) overruns_ = overruns_ + 1;
            reg(port + usart::icr) = 0xF; // parity, framing, noise, overrun: the CRC detects damaged messages
        }
        if ((state & empty) && (reg(port + usart::cr1) & sendInterruptEnabled)) sendNext();
    }

    FrameTime currentTime() const noexcept {
        std::uint32_t frame, count;
        do {
            frame = outputs_->played();
            count = reg(tim6::cnt);
        } while (frame != outputs_->played()); // repeat if the sample timer's interrupt came between
        return {frame, static_cast<std::uint8_t>(count * 256u / cyclesPerFrame_)};
    }

#ifdef PHYSVIB_BLUETOOTH
    static constexpr int interruptNumber = irq::usart1;
#else
    static constexpr int interruptNumber = irq::usart2;
#endif

private:
#ifdef PHYSVIB_BLUETOOTH
    static constexpr std::uint32_t port = usart::usart1;
#else
    static constexpr std::uint32_t port = usart::usart2;
#endif
    // UE, RE, TE, RXNEIE
    static constexpr std::uint32_t sendInterruptEnabled = 1u << 7, enabled = 1u | 1u << 2 | 1u << 3 | 1u << 5;

    void receive(std::uint8_t byte) noexcept {
        if (static_cast<std::uint8_t>(receiveIndex_ + 1) == readIndex_) {
            overruns_ = overruns_ + 1;
            return;
        }
        if (byte == 0) zeroTimes_[zerosReceived_++ % zeroTimes_.size()] = currentTime();
        receiveBuffer_[receiveIndex_] = byte;
        receiveIndex_ = static_cast<std::uint8_t>(receiveIndex_ + 1);
    }

    void sendNext() noexcept {
        if (sendIndex_ == queueIndex_) {
            reg(port + usart::cr1) = enabled;
            return;
        }
        reg(port + usart::tdr) = sendBuffer_[sendIndex_ % sendBuffer_.size()];
        sendIndex_ = static_cast<std::uint8_t>(sendIndex_ + 1);
    }

    const FrameQueue* outputs_ = nullptr;
    std::uint32_t cyclesPerFrame_ = 1;
    std::array<volatile std::uint8_t, 256> receiveBuffer_{}; // 22 ms of the line; 8-bit indices wrap
    std::array<std::uint8_t, 128> sendBuffer_{};
    std::array<FrameTime, 16> zeroTimes_{}; // wrong in a flood of empty frames
    volatile std::uint8_t receiveIndex_ = 0, readIndex_ = 0, queueIndex_ = 0, sendIndex_ = 0;
    std::uint8_t zerosReceived_ = 0, zerosRead_ = 0;
    volatile std::uint32_t overruns_ = 0;
};

/// Values that only the start-up code knows: clock, resets, free stack.
struct StartupInfo {
    Clock clock;
    std::uint8_t watchdogResets = 0;
    std::uint16_t (*freeStackBytes)() = nullptr;
};

/// Executes messages of the host and sends replies. Main loop only.
class Link {
public:
    void start(const StartupInfo& startup, BoardRenderer& renderer, FrameQueue& outputs,
               SerialPort& serial) noexcept;

    /// Executes received messages; silences the board when none has come for too long.
    void poll() noexcept;

    /// Called before and after each block of the renderer; `cycles`: its duration in processor cycles.
    void beforeBlock() noexcept;
    void afterBlock(BoardRenderer::Codes& block, std::uint32_t cycles) noexcept;

    bool isSilenced() const noexcept { return isSilenced_; }

private:
    void execute(std::span<const std::uint8_t> payload, FrameTime arrivedAt) noexcept;
    void executeHello(const wire::Hello& hello) noexcept;
    template <class Event>
    void schedule(std::uint8_t sequence, const Event& event) noexcept;
    void sendTelemetry() noexcept;
    void stopAll() noexcept;
    void checkTimeout() noexcept;
    template <class Message>
    void send(const Message& message) noexcept;

    StartupInfo startup_;
    BoardRenderer* renderer_ = nullptr;
    FrameQueue* outputs_ = nullptr;
    SerialPort* serial_ = nullptr;
    wire::FrameDecoder decoder_;
    wire::SelfTestRun selfTest_;
    std::uint32_t lastMessageFrame_ = 0;
    std::uint32_t watchdogFrames_ = 0;
    std::uint32_t maxBlockCycles_ = 0;
    wire::DuplicateFilter duplicateFilter_;
    bool hasHello_ = false, isSilenced_ = true;
};

} // namespace physvib::board
