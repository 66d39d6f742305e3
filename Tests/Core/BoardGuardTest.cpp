// SPDX-License-Identifier: MIT
// The guard of the board, in the renderer that the board runs: what leaves its converters has no mean over
// 250 ms and no rms below 5 Hz of more than a twentieth of full scale, whatever it is asked to play.
#include "Support/BoardHazards.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

constexpr double most = limits::guardShare;

void expectWithin(const std::vector<test::BoardFrame>& codes, const std::string& name) {
    const auto worst = test::worstSlowFigures(codes);
    EXPECT_LE(worst.mean, most) << name;
    EXPECT_LE(worst.rms, most) << name;
}

TEST(BoardGuard, KeepsWhatIsSlowWithinItsShare) {
    for (const auto& hazard : test::boardHazards(0, 10)) {
        const auto renderer = test::preparedBoard();
        const auto codes = test::renderBoardEvents(*renderer, hazard.events, 12 * 8000, 64, hazard.segments);
        EXPECT_EQ(renderer->status().dropped, 0u) << hazard.name;
        EXPECT_GT(renderer->guard().episodes(), 0u) << hazard.name;
        expectWithin(codes, hazard.name);
        if (!hazard.segments.empty()) continue; // the closed form knows none
        test::ReferenceGuard none{false}, fromLeft{true, &codes};
        const auto worst = test::worstSlowFigures(test::boardClosedForm(hazard.events, codes.size(), none));
        EXPECT_GT(std::max(worst.mean, worst.rms), 1.2 * most) << hazard.name << ": it needs no guard";
        EXPECT_LE(test::worstDifference(codes, test::boardClosedForm(hazard.events, codes.size(), fromLeft)),
                  1)
            << hazard.name;
    }
}

// Gains that turn with the tone make one side of both; stops and hellos must not make it forget.
TEST(BoardGuard, NeitherGainsNorStopsAreAWayAround) {
    for (const bool stops : {false, true}) {
        const auto renderer = test::preparedBoard();
        std::vector<test::BoardFrame> codes;
        BoardRenderer::Codes block;
        for (int n = 0; n < 10 * 8000; n += BoardRenderer::blockFrames) {
            if (n % 800 == 0) { // 5 Hz, struck anew in every half period
                if (stops) renderer->stopAll();
                BoardEvent e{renderer->frame(), 16 * 5, 1, 100, {4096, 4096, -4096, 2048}};
                const float side = !stops && n / 800 % 2 == 1 ? -1.0f : 1.0f;
                if (side < 0.0f)
                    for (auto& a : e.amplitudes) a = static_cast<std::int16_t>(-a);
                renderer->setGains({side, 1.0f, side, -side});
                renderer->schedule(e);
            }
            renderer->render(block);
            codes.insert(codes.end(), block.begin(), block.end());
        }
        expectWithin(codes, stops ? "stops" : "gains");
        EXPECT_GT(renderer->guard().episodes(), 0u);
    }
}

TEST(BoardGuard, RandomListsDoNotPassIt) {
    test::SlowFigures worst;
    for (std::uint32_t seed = 1; seed <= 30; ++seed) {
        const auto list = test::slowBoardList(seed, 6);
        const auto renderer = test::preparedBoard();
        worst.join(test::worstSlowFigures(
            test::renderBoardEvents(*renderer, list.events, 8 * 8000, 64, list.segments)));
    }
    EXPECT_LE(worst.mean, most);
    EXPECT_LE(worst.rms, most);
    EXPECT_GT(worst.mean, 0.8 * most) << "it would turn down more than it must";
}

// What does not come near plays the codes that it would play without.
TEST(BoardGuard, WhatIsFeltStaysAsItIs) {
    for (const std::uint16_t hz : {32, 48, 80, 205, 400}) {
        std::vector<BoardEvent> events{
            {3, static_cast<std::uint16_t>(16 * hz), 1, 0, {4096, -2048, 100, 4000}}};
        for (std::uint32_t i = 1; i < 12 && hz > 32; ++i) // 32 Hz alone is as slow as full scale may be
            events.push_back(
                {i * 2003, static_cast<std::uint16_t>(16 * 3 * hz), 16 * 12, 0, {900, 400, -300, 0}});
        const auto renderer = test::preparedBoard();
        const auto codes = test::renderBoardEvents(*renderer, events, 4 * 8000);
        EXPECT_EQ(renderer->guard().episodes(), 0u) << hz;
        test::ReferenceGuard none{false};
        EXPECT_LE(test::worstDifference(codes, test::boardClosedForm(events, codes.size(), none)), 1) << hz;
    }
}

TEST(BoardGuard, OpensAgain) {
    const auto renderer = test::preparedBoard();
    test::renderBoardEvents(*renderer, {{0, 16, 1, 2000, {4096, 4096, 4096, 4096}}}, 3 * 8000);
    EXPECT_EQ(renderer->guard().episodes(), 1u);
    const auto first = renderer->frame() + 2 * 8000;
    BoardRenderer::Codes block;
    while (renderer->frame() < first) renderer->render(block);
    EXPECT_EQ(renderer->guard().gain(), 1.0f);
    const BoardEvent tone{first, 16 * 205, 16, 0, {4096, 2048, 0, -4096}};
    auto shifted = tone;
    shifted.frame = 0;
    renderer->schedule(tone);
    EXPECT_EQ(test::renderBoardEvents(*renderer, {}, 8000),
              test::renderBoardEvents(*test::preparedBoard(), {shifted}, 8000));
}

} // namespace
} // namespace physvib
