// SPDX-License-Identifier: MIT
// Self-test of board and computer: fills the mode bank with known notes over several blocks without output,
// then counts the cycles of one block and hashes its bits.
#pragma once
#include "Core/BoardRenderer.h"
#include "Wire/Frames.h"
#include "Wire/Messages.h"
#include <cstdint>

namespace physvib::wire {

/// Called around each block of the renderer.
class SelfTestRun {
public:
    /// Starts the test, and stores the renderer's gains until its end.
    void begin(BoardRenderer& renderer) noexcept {
        if (!isRunning()) gains_ = renderer.exchangeGains({1.0f, 1.0f, 1.0f, 1.0f});
        step_ = 1;
    }
    bool isRunning() const noexcept { return step_ != 0; }

    /// Before a block: adds eight notes, each with its own frequency and decay.
    void addNotes(BoardRenderer& renderer) noexcept {
        renderer.bypassNextBlock(); // the block is not sent to the actuators
        for (int i = 0; i < notesPerBlock && step_ <= blocks; ++i) {
            const int note = (step_ - 1) * notesPerBlock + i;
            const auto amplitude = static_cast<std::int16_t>(20 + note);
            renderer.schedule({renderer.frame(),
                               static_cast<std::uint16_t>(16 * 40 + 41 * note),
                               static_cast<std::uint16_t>(16 + note),
                               0,
                               {amplitude, static_cast<std::int16_t>(-amplitude), 30, 7}});
        }
    }

    /// After a block that took `cycles`: true once, when the result is complete.
    bool finishBlock(const BoardRenderer::Codes& block, std::uint32_t cycles, BoardRenderer& renderer,
                     SelfTestReply& reply) noexcept {
        if (step_++ <= blocks) return false;
        step_ = 0;
        (void)renderer.exchangeGains(gains_);
        reply.modes = static_cast<std::uint16_t>(renderer.status().modes);
        reply.blockCycles = cycles;
        reply.hash = crc16({block[0].data(), sizeof(block)});
        return true;
    }

private:
    static constexpr int notesPerBlock = 8, blocks = limits::board::maxModes / notesPerBlock;
    int step_ = 0;
    BoardRenderer::Gains gains_{};
};

/// The answer expected from a board, except for the cycles. Resets `renderer`.
inline SelfTestReply expectedSelfTest(BoardRenderer& renderer) noexcept {
    SelfTestRun test;
    SelfTestReply reply;
    BoardRenderer::Codes block;
    renderer.prepare();
    test.begin(renderer);
    do {
        test.addNotes(renderer);
        renderer.render(block);
    } while (!test.finishBlock(block, 0, renderer, reply));
    return reply;
}

} // namespace physvib::wire
