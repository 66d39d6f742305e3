// SPDX-License-Identifier: MIT
// A path on the board: steps without gaps, of bounded number, each as strong and where it is to be.
#include "Core/BoardRenderer.h"
#include "Core/PhantomPanner.h"
#include "Wire/BoardPath.h"
#include "Wire/BoardStrike.h"
#include <gtest/gtest.h>
#include <memory>
#include <vector>

namespace physvib {
namespace {

constexpr std::int64_t second = 1'000'000'000;

CollisionEvent fromAToD(double hz = 205.0) {
    CollisionEvent e;
    e.durationNs = second;
    e.frequencyHz = hz;
    e.amplitude = 0.5;
    e.y = 1.0;
    e.course = {1.0, 0.0, second, 0};
    e.spread = Spread::equal;
    return e;
}

std::vector<CollisionEvent> stepsOf(const CollisionEvent& moving) {
    std::vector<CollisionEvent> all;
    for (BoardSteps steps{moving}; !steps.isOver();) all.push_back(steps.take());
    return all;
}

PhantomPanner square() {
    EnchanterLayout layout;
    layoutPreset("phone4", layout);
    return {layout, PanningLaw::linear, 1.0, 1.0, 1.0};
}

TEST(BoardSteps, FollowEachOtherInWholeMillisecondsAndPeriods) {
    for (const double hz : {60.0, 80.0, 149.5, 205.0, 233.3, 400.0}) {
        const auto steps = stepsOf(fromAToD(hz));
        EXPECT_LE(steps.size(), 50u);
        std::int64_t end = 0;
        for (const auto& step : steps) {
            EXPECT_EQ(step.timeNs, end);
            EXPECT_EQ(step.durationNs % 1'000'000, 0);
            EXPECT_TRUE(isPlayable(step));
            end += step.durationNs;
        }
        EXPECT_EQ(end, second);
        EXPECT_LE(std::abs(std::remainder(hz * static_cast<double>(steps[0].durationNs) * 1e-9, 1.0)), 0.03)
            << hz;
    }
}

TEST(BoardSteps, AStrikeThatDecaysEnds) {
    CollisionEvent e = fromAToD();
    e.durationNs = 0;
    e.decayPerSecond = 20.0;
    const auto steps = stepsOf(e);
    EXPECT_LE(steps.size(), 41u) << "140 dB at 174 dB a second";
    EXPECT_EQ(steps.back().course.sinceNs, steps.back().timeNs) << "as weak as it is by then";
}

TEST(BoardSteps, OnTheBoardItIsEquallyStrongAllTheWay) {
    const auto renderer = std::make_unique<BoardRenderer>();
    renderer->prepare();
    const PhantomPanner panner = square();
    for (const auto& step : stepsOf(fromAToD())) {
        PhantomPanner::Gains gains{};
        panner.gainsAt(step.x, step.y, step.spread, gains);
        BoardEvent event = boardEventOf(step, {gains[0], gains[1], gains[2], gains[3]});
        event.frame = static_cast<std::uint32_t>(step.timeNs / (second / limits::board::sampleRateHz));
        ASSERT_TRUE(renderer->schedule(event));
    }
    std::vector<double> energy; // of each frame, over all channels
    BoardRenderer::Codes codes;
    for (int block = 0; block < limits::board::sampleRateHz / BoardRenderer::blockFrames; ++block) {
        renderer->render(codes);
        for (const auto& frame : codes) {
            double sum = 0.0;
            for (const auto code : frame) sum += (code - 128.0) * (code - 128.0);
            energy.push_back(sum);
        }
    }
    const auto window = static_cast<std::size_t>(limits::board::sampleRateHz / 205 * 2);
    for (std::size_t first = 0; first + window < energy.size(); first += window) {
        double mean = 0.0;
        for (std::size_t n = first; n < first + window; ++n) mean += energy[n] / static_cast<double>(window);
        EXPECT_NEAR(10 * std::log10(mean / (0.5 * 63.5 * 63.5)), 0.0, 0.5) << first;
    }
}

} // namespace
} // namespace physvib
