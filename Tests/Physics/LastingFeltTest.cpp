// SPDX-License-Identifier: MIT
// What rolls, as four enchanters play it: where the phantom is, and which tone ridges give.
#include "AttachedWorld.h"
#include "Core/PhantomPanner.h"
#include "Measure/Spectrum.h"
#include "Support/Rendering.h"
#include <algorithm>
#include <array>
#include <numbers>
#include <span>

namespace physvib {
namespace {

constexpr int rate = 48'000;
constexpr double fieldWidth = 4.4, fieldHeight = 1.7;

/// A rough slope from the field's upper left corner, and a ball of 0.25 m that touches it there.
class LastingFelt : public AttachedWorld {
protected:
    LastingFelt() {
        world.SetGravity({0.0F, -10.0F});
        world.SetAllowSleeping(false);
    }
    b2Fixture& slope(double degrees, const HapticFixture& values, float friction) {
        const auto angle = static_cast<float>(-degrees * std::numbers::pi / 180.0);
        along = {std::cos(angle), std::sin(angle)};
        const b2Vec2 top{0.0F, static_cast<float>(fieldHeight)};
        b2Fixture& ground = edge(top - 20.0F * along, top + 80.0F * along);
        (void)attachment.set(ground, values);
        b2Fixture& fixture = ball(top.x - 0.25F * along.y, top.y + 0.25F * along.x, 0.0F, 0.0F, 0.0F);
        for (b2Fixture* each : {&ground, &fixture}) each->SetFriction(friction);
        return fixture;
    }
    /// Four channels of what has happened.
    static test::Channels felt(const std::vector<CollisionEvent>& events, PanningLaw law, double length) {
        EnchanterLayout layout;
        layoutPreset("phone4", layout);
        RendererSettings settings{rate, 4, {layout, law, 1.0, fieldWidth, fieldHeight}};
        settings.limiterEnabled = false;
        return test::renderEvents(events, settings, static_cast<int>(length * rate)).channels;
    }
    b2Vec2 along{1.0F, 0.0F};
};

double power(std::span<const float> samples) {
    double sum = 0.0;
    for (const float x : samples) sum += static_cast<double>(x) * static_cast<double>(x);
    return sum;
}

/// Where four channels' levels put the phantom: linear gains sum to one, squares of the energy law's do.
b2Vec2 centroid(const test::Channels& channels, PanningLaw law, double from, double to) {
    std::array<double, 4> share{};
    for (std::size_t j = 0; j < 4; ++j) {
        const double p = power(std::span{channels[j]}.subspan(static_cast<std::size_t>(from * rate),
                                                              static_cast<std::size_t>((to - from) * rate)));
        share[j] = law == PanningLaw::energy ? p : std::sqrt(p);
    }
    const double all = share[0] + share[1] + share[2] + share[3]; // A and C are left, A and B are up
    return {static_cast<float>(fieldWidth * (share[1] + share[3]) / all),
            static_cast<float>(fieldHeight * (share[0] + share[1]) / all)};
}

TEST_F(LastingFelt, PhantomFollowsARollingBall) {
    constexpr double length = 1.8, window = 0.05;
    HapticFixture wood{349.0, 106.99, true, 10.0};
    wood.texture.grainMetres = 0.002;
    const b2Body& ball = *slope(20.0, wood, 1.0F).GetBody();
    std::vector<b2Vec2> touches; // after each step of 10 ms
    std::vector<CollisionEvent> events;
    for (int i = 0; i < 182; ++i) {
        attachment.step(0.01F);
        touches.push_back(ball.GetPosition() - 0.25F * b2Vec2{-along.y, along.x});
    }
    attachment.take(events);
    ASSERT_GT(touches.back().x, 0.75F * static_cast<float>(fieldWidth));
    for (const PanningLaw law : {PanningLaw::linear, PanningLaw::energy}) {
        const test::Channels channels = felt(events, law, length);
        for (double t = 0.2; t + window < length; t += window) {
            const b2Vec2 truth = touches[static_cast<std::size_t>((t + 0.5 * window) * 100.0) - 1];
            const b2Vec2 phantom = centroid(channels, law, t, t + window);
            EXPECT_NEAR(phantom.x, truth.x, 0.03 * fieldWidth) << t;
            EXPECT_NEAR(phantom.y, truth.y, 0.03 * fieldHeight) << t;
        }
    }
}

TEST_F(LastingFelt, RidgesPeakAtSpeedBySpacing) {
    HapticFixture ridged{250.0, 60.0, true, 10.0};
    ridged.texture = {0.002, 1.0, GrainPattern::regular};
    slope(0.0, ridged, 0.0F).GetBody()->SetLinearVelocity({0.4F, 0.0F});
    std::vector<CollisionEvent> events = run(300);
    const test::Channels channels = felt(events, PanningLaw::linear, 2.5);
    const std::vector<double> samples(channels[0].begin() + rate / 2, channels[0].end()); // 2 s
    const std::vector<double> bins = magnitudes(samples);
    const double perBin = 0.5 * rate / static_cast<double>(bins.size() - 1);
    const auto highest =
        std::ranges::max_element(bins.begin() + static_cast<std::ptrdiff_t>(20.0 / perBin), bins.end());
    EXPECT_NEAR(static_cast<double>(highest - bins.begin()) * perBin, 200.0, 2.0);
}

} // namespace
} // namespace physvib
