// SPDX-License-Identifier: MIT
// What the board does with each message, and what it answers.
#pragma once
#include "Clock.h"
#include "Core/BoardRenderer.h"
#include "Outputs.h"
#include "SerialPort.h"
#include "Wire/FrameDecoder.h"
#include "Wire/SelfTest.h"
#include "Wire/StrikeOrder.h"
#include <cstdint>

namespace physvib::board {

/// What only the start-up code knows.
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

    /// Takes what has come in; falls silent when nothing has come for too long.
    void poll() noexcept;

    /// Around each block of the renderer.
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
    std::uint32_t heardAt_ = 0; // frame of the last message
    std::uint32_t watchdogFrames_ = 0;
    std::uint32_t worstBlockCycles_ = 0;
    wire::StrikeOrder order_;
    bool greeted_ = false, silenced_ = true;
};

} // namespace physvib::board
