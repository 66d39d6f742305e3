// SPDX-License-Identifier: MIT
// The board's side of the link: executes messages and sends replies.
#pragma once
#include "Core/BoardRenderer.h"
#include "Outputs.h"
#include "Registers.h"
#include "SerialPort.h"
#include "Wire/FrameDecoder.h"
#include "Wire/SelfTest.h"
#include <cstdint>

namespace physvib::board {

/// Values that only the start-up code can provide.
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

    /// Called before and after each block of the renderer.
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
