// SPDX-License-Identifier: MIT
// What moves, on a board of protocol 2: within one step of the converters of what the computer's own renderer
// plays, in few segments.
#include "Wire/BoardPath.h"
#include "Support/BoardReference.h"
#include "Support/Rendering.h"
#include <gtest/gtest.h>

namespace physvib::board_path_test {

constexpr int deskRate = 48000, perBoardFrame = deskRate / limits::board::sampleRateHz;

RendererSettings deskOf(PanningLaw law = PanningLaw::linear) {
    ActuatorLayout layout;
    layoutPreset("phone4", layout);
    return {deskRate, 4, PhantomPanner{layout, law, 1.0, 1.0, 1.0}, false};
}

CollisionEvent diagonal(Spread spread, double amplitude) {
    CollisionEvent e{.frequencyHz = 205.0, .amplitude = amplitude, .y = 1.0, .durationNs = 1'000'000'000};
    e.course = {1.0, 0.0, e.durationNs, 0}; // from A to D
    e.spread = spread;
    return e;
}

auto gainsOf(const PhantomPanner& panner) {
    return [&panner](const CollisionEvent& e) {
        PhantomPanner::Gains gains{};
        panner.gainsAt(e.x, e.y, e.spread, gains);
        return PathGains::Gains{gains[0], gains[1], gains[2], gains[3]};
    };
}

double boardFrameOf(std::int64_t ns) { return static_cast<double>(ns) * 1e-9 * limits::board::sampleRateHz; }

/// Of these, each the rest of the one before or apart from it; the board's clock begins with the session's.
std::vector<BoardSegment> segmentsOf(const std::vector<CollisionEvent>& events, const PhantomPanner& panner) {
    std::vector<BoardSegment> segments;
    std::vector<BoardPath> paths;
    for (const CollisionEvent& event : events) {
        BoardPath path{event, deskRate};
        if (!paths.empty()) path.continueFrom(paths.back());
        while (!path.isOver()) {
            const auto segment = path.next({boardFrameOf(event.timeNs)}, gainsOf(panner));
            if (!segment) break;
            EXPECT_FALSE(path.isCoarse());
            segments.push_back(*segment);
            path.advance();
        }
        paths.push_back(path);
    }
    return segments;
}

/// Each segment is handed over 20 frames before its first.
std::vector<test::BoardFrame> onTheBoard(const std::vector<BoardSegment>& segments, std::size_t frames) {
    const auto renderer = std::make_unique<BoardRenderer>();
    renderer->prepare();
    std::vector<test::BoardFrame> codes;
    BoardRenderer::Codes block;
    for (std::size_t next = 0; codes.size() < frames; codes.insert(codes.end(), block.begin(), block.end())) {
        for (; next < segments.size() && segments[next].frame < codes.size() + 20; ++next)
            EXPECT_TRUE(renderer->schedule(segments[next]));
        renderer->render(block);
    }
    codes.resize(frames);
    EXPECT_EQ(renderer->status().late + renderer->status().dropped, 0u);
    return codes;
}

/// Every sixth sample of the computer's renderer, as the converters would round it.
std::vector<test::BoardFrame> onTheDesk(const std::vector<CollisionEvent>& events,
                                        const RendererSettings& settings, std::size_t frames) {
    const auto felt = test::renderEvents(events, settings, static_cast<int>(frames) * perBoardFrame).channels;
    std::vector<test::BoardFrame> codes(frames);
    for (std::size_t n = 0; n < frames; ++n)
        for (std::size_t j = 0; j < 4; ++j)
            codes[n][j] = static_cast<std::uint8_t>(
                std::clamp(static_cast<int>(std::floor(felt[j][n * perBoardFrame] * 127.0 + 128.5)), 0, 255));
    return codes;
}

std::size_t expectOneStep(const std::vector<CollisionEvent>& events, const RendererSettings& settings,
                          std::size_t frames = 8800) {
    const auto segments = segmentsOf(events, settings.panner);
    EXPECT_LE(test::worstDifference(onTheBoard(segments, frames), onTheDesk(events, settings, frames)), 1);
    return segments.size();
}

TEST(BoardPath, FromAToDInASecondIsWithinOneStepOfTheDeviceByEveryLaw) {
    for (std::size_t spread = 0; spread < spreadNames.size(); ++spread)
        for (const double amplitude : {0.5, 1.0}) {
            SCOPED_TRACE(std::string{spreadNames[spread]} + ' ' + std::to_string(amplitude));
            const auto segments = expectOneStep({diagonal(static_cast<Spread>(spread), amplitude)}, deskOf());
            std::cout << spreadNames[spread] << ' ' << amplitude << ": " << segments << " legs\n";
            EXPECT_GE(segments, 25u) << "none is longer than 40 ms";
            EXPECT_LE(segments, 50u) << "a sixth of the line";
        }
}

TEST(BoardPath, SoItIsByEveryLawOfALayout) {
    for (const auto& one : panningLaws) {
        SCOPED_TRACE(one.name);
        expectOneStep({diagonal(Spread::layout, 0.5)}, deskOf(one.law));
    }
}

// Each actuator that the tone passes ends one root of the gains and begins another.
TEST(BoardPath, SoItIsOverARowByTheDefaultLaw) {
    const RendererSettings row{
        deskRate, 4, PhantomPanner{test::gridLayout(4, 1), PanningLaw::automatic, 1.0, 1.0, 1.0}, false};
    const auto segments = expectOneStep({diagonal(Spread::layout, 0.5)}, row);
    EXPECT_LE(segments, 70u);
}

TEST(BoardPath, SoItIsWhereverItBeginsAtAnyFrequencyAndAsItDecays) {
    for (const double hz : {40.3, 149.53, 205.0, 333.33, 399.9}) {
        CollisionEvent e = diagonal(Spread::equal, 0.9);
        e.frequencyHz = hz;
        e.timeNs = 33'333'331 + static_cast<std::int64_t>(hz * 1000);
        e.decayPerSecond = hz > 200.0 ? 7.03 : 0.0;
        e.course.toneAgeNs = hz > 300.0 ? 123'456'789 : 0;
        SCOPED_TRACE(hz);
        expectOneStep({e}, deskOf());
    }
}

TEST(BoardPath, APathOfSeveralPlacesIsOneTone) {
    std::vector<CollisionEvent> around;
    const double corners[][2]{{0, 1}, {1, 1}, {1, 0}, {0, 0}, {0, 1}};
    for (int i = 0; i < 4; ++i) {
        CollisionEvent e = diagonal(Spread::equal, 0.7);
        e.durationNs = e.course.travelNs = 123'456'789;
        e.timeNs = 1'000'003 + i * e.durationNs;
        e.course.toneAgeNs = i * e.durationNs;
        e.x = corners[i][0], e.y = corners[i][1];
        e.course.toX = corners[i + 1][0], e.course.toY = corners[i + 1][1];
        around.push_back(e);
    }
    const auto segments = segmentsOf(around, deskOf().panner);
    for (std::size_t i = 1; i < segments.size(); ++i)
        EXPECT_EQ(segments[i].frame, segments[i - 1].frame + segments[i - 1].frames) << i;
    expectOneStep(around, deskOf(), 4400);
}

// The clock is learnt anew between two segments, and the device's is another by some ppm: nothing of it may
// be heard as a step.
TEST(BoardPath, AClockThatIsCorrectedMakesNoStep) {
    test::Random random{9};
    BoardPath path{diagonal(Spread::equal, 1.0), deskRate};
    const auto settings = deskOf();
    std::vector<BoardSegment> segments;
    for (; !path.isOver(); path.advance()) {
        // half a millisecond either way
        const auto segment = path.next({80.0 + random.uniform(-4.0, 4.0), 8000.8}, gainsOf(settings.panner));
        if (!segment) break;
        segments.push_back(*segment);
    }
    const auto codes = onTheBoard(segments, 8200);
    int steepest = 0;
    for (std::size_t n = 1; n < codes.size(); ++n)
        for (std::size_t j = 0; j < 4; ++j)
            steepest = std::max(steepest, std::abs(codes[n][j] - codes[n - 1][j]));
    EXPECT_LE(steepest, 23) << "the tone's own at full scale is 20.4, a leg that catches up a little more";
}

TEST(BoardPath, InAHurryItIsLongerThanItsLawAsksForAndSaysSo) {
    BoardPath path{diagonal(Spread::equal, 0.5), deskRate};
    const auto settings = deskOf();
    EXPECT_EQ(path.next({}, gainsOf(settings.panner), true)->frames, BoardPath::minHurriedFrames);
    EXPECT_TRUE(path.isCoarse());
    EXPECT_LT(path.next({}, gainsOf(settings.panner))->frames, 40) << "next to a corner";
    EXPECT_FALSE(path.isCoarse());
}

// A device that stands still for a while: segments that would be over before they are due must not be made
// again and again.
TEST(BoardPath, AClockThatJumpsIsFollowed) {
    CollisionEvent rest = diagonal(Spread::equal, 0.5);
    rest.timeNs = rest.course.toneAgeNs = 1'000'000'000;
    BoardPath first{diagonal(Spread::equal, 0.5), deskRate}, second{rest, deskRate};
    const auto settings = deskOf();
    while (!first.isOver() && first.next({}, gainsOf(settings.panner))) first.advance();
    int segments = 0;
    for (; !second.isOver() && segments < 100; ++segments) {
        second.continueFrom(first);
        const auto segment = second.next({8000.0 + 4000.0}, gainsOf(settings.panner)); // half a second later
        if (!segment) break;
        if (segments == 0) EXPECT_EQ(segment->frame, 12'000u);
        second.advance();
    }
    EXPECT_LE(segments, 40);
}

TEST(BoardPath, WhatIsSkippedGoesOnWhereItWouldBe) {
    BoardPath path{diagonal(Spread::equal, 0.5), deskRate};
    const auto settings = deskOf();
    path.next({}, gainsOf(settings.panner)), path.advance();
    path.skip();
    const std::int64_t at = path.nextNs();
    const BoardTime later{50'000.25};
    const auto segment = path.next(later, gainsOf(settings.panner));
    EXPECT_EQ(segment->frame, static_cast<std::uint32_t>(later.frameAt(static_cast<double>(at) * 1e-9)));
    const double turns = 205.0 * later.secondsAt(segment->frame);
    EXPECT_NEAR(std::remainder(turns - segment->phase16 / 65536.0, 1.0), 0.0, 1e-5);
}

} // namespace physvib::board_path_test
