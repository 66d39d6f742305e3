// SPDX-License-Identifier: MIT
// The board's renderer against the closed form in double precision, and what it does when asked too much.
#include "Core/BoardRenderer.h"
#include "Support/BoardHazards.h"
#include "Support/BoardReference.h"
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace physvib::board_renderer_test {

using test::BoardFrame;
constexpr BoardFrame silence{128, 128, 128, 128};

BoardEvent hit(std::uint32_t frame, double f, double tau, std::array<std::int16_t, 4> amplitudes,
               int durationMs = 0) {
    return {frame, static_cast<std::uint16_t>(16 * f), static_cast<std::uint16_t>(16 * tau),
            static_cast<std::uint16_t>(durationMs), amplitudes};
}

void expectClosedForm(const std::vector<BoardFrame>& played, const std::vector<BoardEvent>& events) {
    EXPECT_LE(test::worstDifference(played, test::boardClosedForm(events, played.size())), 1);
}

TEST(BoardRenderer, IsWithinOneStepOfTheClosedFormForRandomLists) {
    for (std::uint32_t seed = 1; seed <= 8; ++seed) {
        test::BoardListSettings list;
        list.events = seed % 2 == 0 ? 3000 : 120;
        list.materials = seed % 4 == 0 ? 128 : 20;
        list.loudest = seed % 3 == 0 ? 0.6 : 0.1; // 0.6: the linked gain works
        list.spanFrames = 24000;
        const auto events = test::randomBoardEvents(list, seed);
        const auto renderer = test::preparedBoard();
        const auto played = test::renderBoardEvents(*renderer, events, 32000);
        SCOPED_TRACE(seed);
        expectClosedForm(played, events);
        EXPECT_EQ(renderer->status().played, events.size());
        EXPECT_EQ(renderer->status().late + renderer->status().dropped + renderer->status().stolen, 0u);
    }
}

TEST(BoardRenderer, CutsWhatHasADuration) {
    test::BoardListSettings list;
    list.gatedShare = 1.0;
    list.events = 300;
    const auto events = test::randomBoardEvents(list, 3);
    const auto renderer = test::preparedBoard();
    const auto played = test::renderBoardEvents(*renderer, events, 20000);
    expectClosedForm(played, events);
    EXPECT_EQ(played.back(), silence);
    EXPECT_EQ(renderer->status().modes, 0);
}

TEST(BoardRenderer, HoldsALowSlowNoteForSeconds) {
    const std::vector<BoardEvent> events{hit(5, 20, 0.0625, {4096, 2048, -4096, 1000}),
                                         hit(9, 399.5, 0.0625, {0, 1000, 0, 0})};
    expectClosedForm(test::renderBoardEvents(*test::preparedBoard(), events, 80000), events);
}

TEST(BoardRenderer, StrikesOfOneMaterialCostOneModeAndEndTogether) {
    const auto renderer = test::preparedBoard();
    std::vector<BoardEvent> events;
    for (std::uint32_t i = 0; i < 1500; ++i)
        events.push_back(hit(8 + 9 * i, 205, 12, {static_cast<std::int16_t>(i % 90), 20, -30, 0}));
    BoardRenderer::Codes block;
    const auto played = test::renderBoardEvents(*renderer, events, 15000);
    EXPECT_EQ(renderer->status().modes, 1);
    expectClosedForm(played, events);
    for (int k = 0; k < 4000; ++k) renderer->render(block);
    EXPECT_EQ(renderer->status().modes, 0);
}

TEST(BoardRenderer, AStrikeThatCancelsOneLeavesSilence) {
    const auto renderer = test::preparedBoard();
    for (const std::int16_t amplitude : {3000, -3000})
        renderer->schedule(hit(40, 205, 12, {amplitude, 0, 0, 0}));
    for (const auto& frame : test::renderBoardEvents(*renderer, {}, 200))
        ASSERT_EQ(frame, (std::decay_t<decltype(frame)>{128, 128, 128, 128}));
}

TEST(BoardRenderer, OneGainTakesWhatIsTooLoudFromAllChannels) {
    const auto renderer = test::preparedBoard();
    const auto played = test::renderBoardEvents(*renderer, {hit(0, 250, 2, {16384, 8192, 0, -16384})}, 2000);
    const double ratio = (played[8][1] - 128.0) / (played[8][0] - 128.0); // a quarter of 250 Hz: the crest
    EXPECT_EQ(played[8][0], 255);
    EXPECT_EQ(played[8][3], 1);
    EXPECT_NEAR(ratio, 0.5, 0.01);
}

TEST(BoardRenderer, AStolenModeLeavesNoStep) {
    const auto renderer = test::preparedBoard();
    std::vector<BoardEvent> events;
    for (int i = 0; i < 128; ++i)
        events.push_back(hit(4, 50 + i, 1, {static_cast<std::int16_t>(i == 77 ? 1500 : 2000), 0, 0, 0}));
    for (const auto& e : events) renderer->schedule(e);
    EXPECT_EQ(renderer->status().pending, 64) << "more than may wait";
    EXPECT_EQ(renderer->status().dropped, 64u);

    auto full = test::preparedBoard();
    BoardRenderer::Codes block;
    for (int i = 0; i < 128; ++i) {
        auto e = hit(full->frame() + 1, 50 + i, 1, {static_cast<std::int16_t>(i == 77 ? 20 : 40), 0, 0, 0});
        full->schedule(e);
        full->render(block);
    }
    int last = block[3][0];
    full->schedule(hit(full->frame(), 300, 1, {1, 0, 0, 0}));
    for (int k = 0; k < 20; ++k) {
        full->render(block);
        for (const auto& frame : block) {
            EXPECT_LE(std::abs(frame[0] - last), 45);
            last = frame[0];
        }
    }
    EXPECT_EQ(full->status().modes, 128);
    EXPECT_EQ(full->status().stolen, 1u);
}

TEST(BoardRenderer, ALateEventIsPlayedAtOnceAndCounted) {
    const auto renderer = test::preparedBoard();
    BoardRenderer::Codes block;
    for (int k = 0; k < 10; ++k) renderer->render(block);
    renderer->schedule(hit(3, 250, 10, {4096, 0, 0, 0}));
    const auto late = test::renderBoardEvents(*renderer, {}, 100);
    const auto fresh = test::preparedBoard();
    EXPECT_EQ(
        test::worstDifference(late, test::renderBoardEvents(*fresh, {hit(0, 250, 10, {4096, 0, 0, 0})}, 100)),
        0);
    EXPECT_EQ(renderer->status().late, 1u);
}

TEST(BoardRenderer, GainsTurnPolarityAndStopAllIsSilence) {
    const auto renderer = test::preparedBoard(), turned = test::preparedBoard();
    turned->setGains({-1.0f, 0.0f, 1.0f, 1.0f});
    const std::vector<BoardEvent> events{hit(400, 200, 5, {2000, 2000, 2000, 2000}),
                                         hit(900, 150, 5, {500, 0, 0, 0})};
    const auto plain = test::renderBoardEvents(*renderer, events, 800, 2000),
               other = test::renderBoardEvents(*turned, events, 800, 2000);
    for (std::size_t n = 0; n < 800; ++n) {
        ASSERT_NEAR(other[n][0] - 128, 128 - plain[n][0], 1);
        ASSERT_EQ(other[n][1], 128);
        ASSERT_EQ(other[n][2], plain[n][2]);
    }
    renderer->stopAll();
    for (const auto& frame : test::renderBoardEvents(*renderer, {}, 400)) ASSERT_EQ(frame, silence);
}

BoardSegment segmentOf(std::uint32_t frame, std::uint16_t frames, double hz,
                       std::array<std::int16_t, 4> start, std::array<std::int16_t, 4> end) {
    return {frame,  static_cast<std::uint32_t>(hz / limits::board::sampleRateHz * 4294967296.0),
            frames, 0,
            0,      start,
            end};
}

/// Of segments alone, that are within full scale.
std::vector<BoardFrame> segmentsInDouble(const std::vector<BoardSegment>& segments, std::size_t frames) {
    std::vector<std::array<double, 4>> sums(frames);
    for (const BoardSegment& segment : segments)
        for (std::size_t k = 0; k < segment.frames && segment.frame + k < frames; ++k) {
            const auto n = static_cast<double>(k);
            const double tone =
                std::sin(2.0 * std::numbers::pi *
                         (segment.phase16 / 65536.0 + std::fmod(segment.turn / 4294967296.0 * n, 1.0))) *
                std::exp(-segment.decay16 / 16.0 * n / 8000.0);
            for (std::size_t j = 0; j < 4; ++j)
                sums[segment.frame + k][j] += tone *
                                              std::lerp(segment.start[j], segment.end[j],
                                                        segment.frames > 1 ? n / (segment.frames - 1) : 0.0) /
                                              limits::board::amplitudeUnit;
        }
    std::vector<BoardFrame> codes(frames);
    for (std::size_t n = 0; n < frames; ++n)
        for (std::size_t j = 0; j < 4; ++j)
            codes[n][j] = static_cast<std::uint8_t>(std::floor(sums[n][j] * 127.0 + 128.5));
    return codes;
}

TEST(BoardRenderer, SegmentsAreWithinOneStepOfTheClosedForm) {
    for (const int most : {4, 40, 320, 4000}) {
        const auto renderer = test::preparedBoard();
        const auto segments = test::randomBoardSegments(4, 100, 16'000, most, 5);
        EXPECT_LE(test::worstDifference(test::renderBoardEvents(*renderer, {}, 20'000, 4, segments),
                                        segmentsInDouble(segments, 20'000)),
                  1)
            << most;
        EXPECT_EQ(renderer->status().played, segments.size());
        EXPECT_EQ(renderer->status().late + renderer->status().dropped, 0u);
    }
}

TEST(BoardRenderer, OfALateSegmentTheRestIsPlayedAndOneThatIsOverIsNot) {
    const BoardSegment segment = segmentOf(2, 300, 205.0, {4000, 0, -2000, 1000}, {0, 4000, 2000, 1000});
    const auto whole = test::renderBoardEvents(*test::preparedBoard(), {}, 400, 64, {segment});
    const auto renderer = test::preparedBoard();
    auto late = test::renderBoardEvents(*renderer, {}, 40);
    EXPECT_TRUE(renderer->schedule(segment));
    const auto rest = test::renderBoardEvents(*renderer, {}, 360);
    EXPECT_LE(test::worstDifference(rest, {whole.begin() + 40, whole.end()}), 1);
    EXPECT_EQ(renderer->status().late, 1u);
    EXPECT_FALSE(renderer->schedule(segment)) << "over";
    EXPECT_EQ(renderer->status().dropped, 1u);
}

TEST(BoardRenderer, MoreSegmentsThanItHoldsAreDroppedAndStopAllForgetsThem) {
    const auto renderer = test::preparedBoard();
    for (int i = 0; i < limits::board::maxSegments; ++i)
        EXPECT_TRUE(renderer->schedule(segmentOf(100, 2000, 200.0, {500, 0, 0, 0}, {500, 0, 0, 0})));
    EXPECT_FALSE(renderer->schedule(segmentOf(100, 2000, 200.0, {500, 0, 0, 0}, {500, 0, 0, 0})));
    EXPECT_FALSE(renderer->schedule(BoardSegment{})) << "of no length";
    EXPECT_FALSE(renderer->schedule(segmentOf(100, 10, 4000.0, {}, {}))) << "half the sample rate";
    EXPECT_EQ(renderer->status().dropped, 3u);
    EXPECT_NE(test::renderBoardEvents(*renderer, {}, 110).back(), silence);
    renderer->stopAll();
    for (const auto& frame : test::renderBoardEvents(*renderer, {}, 400)) ASSERT_EQ(frame, silence);
    EXPECT_TRUE(renderer->schedule(segmentOf(renderer->frame(), 1, 200.0, {}, {})));
}

TEST(BoardRenderer, RefusesWhatItCannotPlay) {
    const auto renderer = test::preparedBoard();
    EXPECT_FALSE(renderer->schedule(hit(0, 4000, 10, {1, 0, 0, 0})));
    EXPECT_FALSE(renderer->schedule(hit(0, 200, 0, {1, 0, 0, 0}))) << "would never end";
    EXPECT_FALSE(renderer->schedule(hit(0, 0, 10, {1, 0, 0, 0})));
    EXPECT_EQ(renderer->status().dropped, 3u);
}

// The guard of the board, in the renderer that the board runs: what leaves its converters has no mean over
// 250 ms and no rms below 5 Hz of more than a twentieth of full scale, whatever it is asked to play.

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

} // namespace physvib::board_renderer_test
