// SPDX-License-Identifier: MIT
// The self-test, on the board and on a computer: a full bank of known notes, struck over the next blocks and
// not let out; then one block of it is counted in cycles, and its bits are hashed.
#pragma once
#include "Core/BoardRenderer.h"
#include "Wire/Crc16.h"
#include "Wire/Messages.h"
#include <cstdint>

namespace physvib::wire {

/// Around each block of the renderer.
class SelfTestRun {
public:
    void begin() noexcept { step_ = 1; }
    bool isRunning() const noexcept { return step_ != 0; }

    /// Before a block: eight notes of the coming one, each of its own frequency and decay.
    void strike(BoardRenderer& renderer) noexcept {
        renderer.letThrough(); // nobody hears it
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

    /// After a block that took `cycles`: true once, when the result is there.
    bool take(const BoardRenderer::Codes& block, std::uint32_t cycles, const BoardRenderer& renderer,
              SelfTestReply& reply) noexcept {
        if (step_++ <= blocks) return false;
        step_ = 0;
        reply.modes = static_cast<std::uint16_t>(renderer.status().modes);
        reply.blockCycles = cycles;
        reply.hash = crc16({block[0].data(), sizeof(block)});
        return true;
    }

private:
    static constexpr int notesPerBlock = 8, blocks = limits::board::maxModes / notesPerBlock;
    int step_ = 0;
};

/// What a board must answer, but for the cycles. `renderer` loses what it holds.
inline SelfTestReply expectedSelfTest(BoardRenderer& renderer) noexcept {
    SelfTestRun test;
    SelfTestReply reply;
    BoardRenderer::Codes block;
    renderer.prepare();
    test.begin();
    do {
        test.strike(renderer);
        renderer.render(block);
    } while (!test.take(block, 0, renderer, reply));
    return reply;
}

} // namespace physvib::wire
