// SPDX-License-Identifier: MIT
// A world of numbers: an engine's part is written here, and what is felt is known by pencil and paper.
#include "Contacts/ContactFeed.h"
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace physvib {
namespace {

constexpr std::int32_t ground = 0, ball = 1;
constexpr double g = 9.81;

ImpactSettings unity() { // A = |J| / m_i
    ImpactSettings settings;
    settings.normalisation = 1.0;
    settings.handMassKg = 0.0;
    return settings;
}

HapticFixture camera() { return {.frequencyHz = 200.0, .decayPerSecond = 30.0, .isCamera = true}; }

class ContactFeedTest : public testing::Test {
protected:
    ContactFeedTest() {
        EXPECT_EQ(feed.set(ground, {}, {}), "");
        EXPECT_EQ(feed.set(ball, {.massKg = 2.0}, camera()), "");
    }
    void beginStep(double seconds) {
        EXPECT_EQ(feed.beginStep(feed.timeNs() + std::llround(seconds * 1.0e9), g), "");
    }
    void step() { beginStep(0.01), endStep(); }
    void endStep() { EXPECT_EQ(feed.endStep(), ""); }
    std::vector<CollisionEvent> events() {
        std::vector<CollisionEvent> all;
        feed.flush(all);
        return all;
    }
    ContactFeed feed{unity()};
};

FedContact landing() { return {.a = ground, .b = ball, .point = {0.25F, 0.0F}}; }

TEST_F(ContactFeedTest, TheMassIsThatOfTheMoment) {
    for (const double massKg : {0.5, 2.0, 0.0, 2.0}) { // its own; of a body that was let go, too
        EXPECT_EQ(feed.setMass(ball, massKg), "");
        FedContact contact = landing();
        contact.approachMetresPerSecond = 3.0;
        beginStep(0.01);
        EXPECT_EQ(feed.touch(contact), "");
        endStep();
        for (int k = 0; k < 3; ++k) step();
        const auto felt = events();
        ASSERT_EQ(felt.size(), massKg > 0.0 ? 1u : 0u);
        if (massKg > 0.0) EXPECT_NEAR(felt[0].source.impulseNewtonSeconds, 3.0 * massKg, 1e-6);
    }
    EXPECT_NE(feed.setMass(ball, -1.0), "");
    EXPECT_NE(feed.setMass(7, 1.0), "");
}

/// A ball of 2 kg falls from 0.8 m as engines move it: straight within a step, its speed changed between two.
class ContactFeedSpeeds : public ContactFeedTest, public testing::WithParamInterface<int> {
protected:
    /// The engine tells only how fast it comes and how far it still is at the start of the step; its speed is
    /// wrong by `error` of it, as that of Box2D 3 is.
    void fall(double error) {
        const double dt = 1.0 / GetParam();
        double height = 0.8;
        for (speed = 0.0; height > 0.0;) {
            speed += g * dt;
            beginStep(dt);
            if (height < speed * dt) {
                onset = static_cast<double>(feed.timeNs()) * 1.0e-9 - dt + height / speed;
                FedContact contact = landing();
                contact.approachMetresPerSecond = speed * (1.0 + error);
                contact.restitution = 0.5;
                contact.gapMetres = height;
                EXPECT_EQ(feed.begin(contact), "");
            }
            endStep();
            height -= speed * dt;
        }
        EXPECT_EQ(feed.end(ground, ball), "");
    }
    double speed = 0.0, onset = 0.0;
};

TEST_P(ContactFeedSpeeds, GiveImpulseAndOnset) {
    for (const double error : {0.0, 0.006, -0.006}) {
        SCOPED_TRACE(error);
        fall(error);
        const auto felt = events();
        ASSERT_EQ(felt.size(), 1U);
        const double impulse = 2.0 * speed * 1.5;
        EXPECT_NEAR(felt[0].source.impulseNewtonSeconds, impulse, 0.01 * impulse);
        EXPECT_NEAR(felt[0].amplitude, speed * 1.5, 0.01 * speed * 1.5); // Eq. 5.4
        EXPECT_NEAR(static_cast<double>(felt[0].timeNs) * 1.0e-9, onset, 1.0e-4);
        EXPECT_EQ(felt[0].source.fixture, ball);
        EXPECT_EQ(felt[0].source.other, ground);
        EXPECT_EQ(felt[0].x, 0.25);
    }
}

INSTANTIATE_TEST_SUITE_P(StepsPerSecond, ContactFeedSpeeds, testing::Values(50, 100, 240, 1000));

TEST_F(ContactFeedTest, AnOverlapFoundAfterTheStepLiesBeforeIt) {
    step();
    beginStep(0.01);
    FedContact contact = landing();
    contact.impulseNewtonSeconds = 6.0;
    contact.approachMetresPerSecond = 2.0;
    contact.gapMetres = -0.006; // 3 ms ago
    contact.gapFraction = 1.0;
    EXPECT_EQ(feed.touch(contact), "");
    endStep();
    const auto felt = events();
    ASSERT_EQ(felt.size(), 1U);
    EXPECT_EQ(felt[0].timeNs, 17'000'000);
    EXPECT_EQ(felt[0].source.impulseNewtonSeconds, 6.0);
}

// Engines that look ahead push before the surfaces meet. Two points are solved together.
TEST_F(ContactFeedTest, AnImpactMayComeAfterTheStepThatReportsIt) {
    beginStep(0.01);
    FedContact contact = landing();
    contact.approachMetresPerSecond = 2.0;
    contact.isSoft = true;
    contact.fraction = 1.3;
    for (contact.pointId = 0; contact.pointId < 2; ++contact.pointId) EXPECT_EQ(feed.touch(contact), "");
    contact.fraction = 2.1;
    EXPECT_EQ(feed.touch(contact), "fraction: expected -1 to 2");
    endStep();
    std::vector<CollisionEvent> felt;
    step();
    feed.take(felt);
    EXPECT_TRUE(felt.empty()); // another one may still come before it
    step();
    feed.take(felt);
    ASSERT_EQ(felt.size(), 1U);
    EXPECT_EQ(felt[0].timeNs, 13'000'000);
}

TEST_F(ContactFeedTest, APairThatIsNamedAgainHasOneCollisionAndRestsThen) {
    FedContact contact = landing();
    contact.impulseNewtonSeconds = 6.0;
    for (int i = 0; i < 5; ++i) {
        beginStep(0.01);
        EXPECT_EQ(feed.touch(contact), "");
        endStep();
        contact.impulseNewtonSeconds = 2.0 * g * 0.01;
    }
    step(); // not named: it has ended
    beginStep(0.01);
    contact.impulseNewtonSeconds = 4.0;
    EXPECT_EQ(feed.touch(contact), "");
    endStep();
    const auto felt = events();
    ASSERT_EQ(felt.size(), 2U);
    EXPECT_EQ(felt[0].source.impulseNewtonSeconds, 6.0);
    EXPECT_EQ(felt[1].source.impulseNewtonSeconds, 4.0);
}

TEST_F(ContactFeedTest, ACollisionOfASoftContactIsItsSpeedsAndNotWhatOneStepPushes) {
    FedContact contact = landing();
    contact.isSoft = true;
    contact.impulseNewtonSeconds = 0.3;
    contact.approachMetresPerSecond = 2.0;
    contact.restitution = 0.5;
    for (const double later : {0.3, 4.0, 0.2}) {
        beginStep(0.01);
        EXPECT_EQ(feed.touch(contact), "");
        endStep();
        contact.impulseNewtonSeconds = later;
    }
    const auto felt = events();
    ASSERT_EQ(felt.size(), 1U);
    EXPECT_EQ(felt[0].source.impulseNewtonSeconds, 2.0 * 2.0 * 1.5);
}

// A face ahead leaves the speed that its gap takes, a spring most of it, an edge rolled over nearly all.
TEST_F(ContactFeedTest, ACollisionIsWhatTheSolverChangedAndLeft) {
    FedContact contact = landing();
    contact.isSoft = true;
    for (const double gap : {0.02, -0.001, 0.001}) {
        beginStep(0.01);
        EXPECT_EQ(feed.move(ball, {}, {{0.0F, -3.0F}, 0.0F}), "");
        EXPECT_EQ(feed.moved(ball, {{0.0F, gap == 0.02 ? -2.0F : -2.9F}, 0.0F}), "");
        contact.gapMetres = gap;
        EXPECT_EQ(feed.touch(contact), "");
        endStep(), step();
        EXPECT_NEAR(events().at(0).source.impulseNewtonSeconds, gap == 0.001 ? 0.4 : 6.0, 1e-6);
    }
}

// Havok stops what bounces, and sends it back in the next step.
TEST_F(ContactFeedTest, ABounceThatComesAStepLaterIsWhole) {
    FedContact contact = landing();
    contact.isSoft = true, contact.restitution = 0.5;
    for (const float left : {0.0F, -0.1F, 0.1F}) {
        beginStep(0.01);
        EXPECT_EQ(feed.move(ball, {}, {{0.0F, -3.0F}, 0.0F}), "");
        EXPECT_EQ(feed.moved(ball, {{0.0F, left}, 0.0F}), "");
        EXPECT_EQ(feed.touch(contact), "");
        endStep(), step();
        EXPECT_NEAR(events().at(0).source.impulseNewtonSeconds, 9.0, 1e-6) << left;
    }
}

// A corner at (0.25, -0.05) from the centre; friction holds it, or is 0.1 of what goes along the normal:
// the impulses are those of two equations for the corner's velocity.
TEST_F(ContactFeedTest, FrictionAtAnEdgeCountsAsTheEngineShowsIt) {
    constexpr double mass = 2.0, inertia = 0.1, speed = 3.0, x = 0.25, y = -0.05;
    constexpr double along = 1.0 / mass + x * x / inertia, across = 1.0 / mass + y * y / inertia,
                     both = -x * y / inertia;
    ASSERT_EQ(feed.set(ball, {.massKg = mass, .inertiaKgSquareMetres = inertia}, camera()), "");
    for (const bool isHeld : {true, false}) {
        const double push = speed / (isHeld ? along - both * both / across : along - 0.1 * both);
        const double drag = isHeld ? -both / across * push : -0.1 * push;
        FedContact contact = landing();
        contact.isSoft = true;
        contact.point = {static_cast<float>(x), 0.0F};
        beginStep(0.01);
        const Vector2 centre{0.0F, static_cast<float>(-y)};
        EXPECT_EQ(feed.move(ball, centre, {{0.0F, static_cast<float>(-speed)}, 0.0F}), "");
        EXPECT_EQ(
            feed.moved(ball, {{static_cast<float>(drag / mass), static_cast<float>(push / mass - speed)},
                              static_cast<float>((x * push - y * drag) / inertia)}),
            "");
        EXPECT_EQ(feed.touch(contact), "");
        endStep(), step();
        EXPECT_NEAR(events().at(0).source.impulseNewtonSeconds, push, 2e-3 * push) << isHeld;
    }
}

// It rolls there at 2 m/s, and friction of half of the push lifts it off the floor, which gives it nothing.
TEST_F(ContactFeedTest, AWallThatLiftsABallIsNotTheFloor) {
    constexpr std::int32_t wall = 2;
    ASSERT_EQ(feed.set(ball, {.massKg = 2.0, .inertiaKgSquareMetres = 0.02}, camera()), "");
    ASSERT_EQ(feed.set(wall, {}, {}), "");
    const BodyMotion rolls{{2.0F, 0.0F}, -20.0F}, lifted{{0.0F, 1.0F}, -10.0F};
    for (int k = 0; k < 3; ++k) {
        beginStep(0.01);
        EXPECT_EQ(feed.move(ball, {0.0F, 0.1F}, rolls), "");
        EXPECT_EQ(feed.moved(ball, k < 2 ? rolls : lifted), "");
        EXPECT_EQ(feed.touch({.a = ground, .b = ball, .isSoft = true}), "");
        const FedContact stops{
            .a = wall, .b = ball, .point = {0.1F, 0.1F}, .normal = {-1.0F, 0.0F}, .isSoft = true};
        if (k == 2) EXPECT_EQ(feed.touch(stops), "");
        endStep();
    }
    step();
    EXPECT_NEAR(events().at(0).source.impulseNewtonSeconds, 4.0, 0.01);
}

// Of an engine that sees the surface coming: two of three metres per second are taken in this step, by twice
// the impulse that two free bodies would need, as the lower one stands on the ground.
TEST_F(ContactFeedTest, AStopOverTwoStepsIsWholeOnWhatStands) {
    constexpr std::int32_t lower = 2;
    ASSERT_EQ(feed.set(lower, {.massKg = 2.0}, {}), "");
    for (int k = 0; k < 3; ++k) {
        beginStep(0.01);
        EXPECT_EQ(feed.move(lower, {}, {}), "");
        EXPECT_EQ(feed.moved(lower, {}), "");
        FedContact stands{.a = ground, .b = lower}, meets{.a = lower, .b = ball, .point = {0.0F, 1.0F}};
        stands.isSoft = meets.isSoft = true;
        EXPECT_EQ(feed.touch(stands), "");
        if (k == 2) {
            EXPECT_EQ(feed.move(ball, {0.0F, 2.0F}, {{0.0F, -3.0F}, 0.0F}), "");
            EXPECT_EQ(feed.moved(ball, {{0.0F, -1.0F}, 0.0F}), "");
            meets.gapMetres = 0.01;
            EXPECT_EQ(feed.touch(meets), "");
        }
        endStep();
    }
    step();
    EXPECT_NEAR(events().at(0).source.impulseNewtonSeconds, 6.0, 0.2);
}

TEST_F(ContactFeedTest, SoftContactsHandOnWhatTheyPush) {
    constexpr std::int32_t striker = 2;
    ASSERT_EQ(feed.set(ground, {.massKg = 2.0}, {}), "");
    ASSERT_EQ(feed.set(striker, {.massKg = 2.0}, {}), "");
    FedContact touching = landing(), collision = {.a = striker, .b = ground};
    touching.isSoft = collision.isSoft = true;
    touching.impulseNewtonSeconds = 0.0;
    collision.impulseNewtonSeconds = 0.1;
    collision.approachMetresPerSecond = 3.0;
    for (int i = 0; i < 6; ++i) {
        beginStep(0.01);
        touching.impulseNewtonSeconds = i == 4 ? 1.25 : 0.0;
        EXPECT_EQ(feed.touch(touching), "");
        if (i >= 4) EXPECT_EQ(feed.touch(collision), "");
        endStep();
    }
    const auto felt = events();
    ASSERT_EQ(felt.size(), 1U);
    EXPECT_EQ(felt[0].source.impulseNewtonSeconds, 1.25);
}

TEST_F(ContactFeedTest, WhatIsBornAtRestIsNotFelt) {
    FedContact contact = landing();
    contact.impulseNewtonSeconds = 2.0 * g * 0.01;
    beginStep(0.01);
    EXPECT_EQ(feed.begin(contact), "");
    endStep();
    EXPECT_TRUE(events().empty());
}

TEST_F(ContactFeedTest, PointsOfAFlatLandingAreOneCollisionInTheirMiddle) {
    beginStep(0.01);
    FedContact contact = landing();
    contact.impulseNewtonSeconds = 3.0;
    EXPECT_EQ(feed.touch(contact), "");
    contact.point.x = 0.75F;
    EXPECT_EQ(feed.touch(contact), "");
    endStep();
    const auto felt = events();
    ASSERT_EQ(felt.size(), 1U);
    EXPECT_EQ(felt[0].source.impulseNewtonSeconds, 6.0);
    EXPECT_EQ(felt[0].x, 0.5);
}

TEST_F(ContactFeedTest, ACollisionBesideTheCentreHasLessMass) {
    ASSERT_EQ(feed.set(ball, {.massKg = 2.0, .inertiaKgSquareMetres = 0.5}, camera()), "");
    ASSERT_EQ(feed.move(ball, {0.0F, 0.5F}, {{0.0F, -3.0F}, 0.0F}), "");
    beginStep(0.01);
    // neither is told: the motion is
    EXPECT_EQ(feed.begin({.a = ground, .b = ball, .point = {0.5F, 0.0F}, .restitution = 1.0}), "");
    endStep();
    const auto felt = events();
    ASSERT_EQ(felt.size(), 1U);
    EXPECT_NEAR(felt[0].source.impulseNewtonSeconds, 3.0 * 2.0 / (1.0 / 2.0 + 0.25 / 0.5), 1.0e-6);
}

/// Five balls that touch, the last one a camera; what strikes the first goes through all of them.
TEST_F(ContactFeedTest, AChainHandsACollisionOnAndItCountsOnce) {
    for (const std::int32_t id : {1, 2, 3, 4, 5})
        ASSERT_EQ(feed.set(id, {.massKg = 1.0, .gravityScale = 0.0}, id == 5 ? camera() : HapticFixture{}),
                  "");
    FedContact contact;
    contact.normal = {1.0F, 0.0F};
    for (int i = 0; i < 10; ++i) {
        beginStep(0.01);
        for (const std::int32_t id : {2, 3, 4}) {
            contact.a = id;
            contact.b = id + 1;
            contact.impulseNewtonSeconds = i == 5 ? 0.6 : 0.0;
            EXPECT_EQ(feed.touch(contact), "");
        }
        contact.a = 1;
        contact.b = 2;
        contact.impulseNewtonSeconds = 1.2;
        if (i == 5) {
            EXPECT_EQ(feed.touch(contact), "");
        }
        endStep();
    }
    const auto felt = events();
    ASSERT_EQ(felt.size(), 1U);
    EXPECT_EQ(felt[0].source.fixture, 5);
    EXPECT_EQ(felt[0].source.other, 4);
    EXPECT_NEAR(felt[0].source.impulseNewtonSeconds, 0.6, 1.0e-6);
    EXPECT_EQ(felt[0].timeNs, 50'000'000);
}

TEST_F(ContactFeedTest, ABodyThatGoesKeepsItsHitsAndItsNumberIsFree) {
    FedContact contact = landing();
    contact.impulseNewtonSeconds = 6.0;
    beginStep(0.01);
    EXPECT_EQ(feed.touch(contact), "");
    endStep();
    EXPECT_EQ(feed.remove(ball), "");
    EXPECT_EQ(feed.remove(ball), "body: expected one that has been told");
    EXPECT_EQ(events().size(), 1U);
    EXPECT_EQ(feed.set(ball, {.massKg = 1.0}, camera()), "");
    step();
    EXPECT_EQ(feed.end(ground, ball), "contact: expected one that has begun");
}

TEST_F(ContactFeedTest, RefusesWhatCannotBeAndNothingIsChanged) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(feed.set(-1, {}, {}), "body: expected a number from 0 on");
    EXPECT_EQ(feed.set(7, {.massKg = nan}, {}), "mass: expected 0 to 10^12 kg");
    EXPECT_EQ(feed.set(7, {}, {.frequencyHz = nan}), "frequency: expected 0 to 20000 Hz");
    EXPECT_EQ(feed.move(7, {}, {}), "body: expected one that has been told");
    EXPECT_EQ(feed.touch(landing()), "step: expected to be within one");
    EXPECT_EQ(feed.endStep(), "step: expected to be within one");
    EXPECT_EQ(feed.beginStep(-1, g), "time: expected not to go back, and less than 10^17 ns");
    beginStep(0.01);
    EXPECT_EQ(feed.beginStep(20'000'000, g), "step: expected not to be within one");
    EXPECT_EQ(feed.remove(ball), "step: expected not to be within one");
    FedContact contact = landing();
    contact.normal = {0.0F, 0.0F};
    EXPECT_EQ(feed.touch(contact), "normal: expected a length of 1");
    contact = landing();
    contact.approachMetresPerSecond = nan;
    EXPECT_EQ(feed.touch(contact), "approach: expected a number of m/s");
    contact = landing();
    contact.alongBMetresPerSecond = nan;
    EXPECT_EQ(feed.touch(contact), "speed along a surface: expected a number of m/s");
    contact = landing();
    contact.b = ground;
    EXPECT_EQ(feed.touch(contact), "bodies: expected two");
    endStep();
    EXPECT_TRUE(events().empty());
    ImpactSettings release;
    release.timing = ImpactTiming::release;
    EXPECT_THROW(ContactFeed{release}, std::invalid_argument);
}

/// A ball of 2 kg on ridges 2 mm apart, told step by step as its engine would.
class ContactFeedRubs : public ContactFeedTest {
protected:
    ContactFeedRubs() {
        HapticFixture ridged = camera();
        ridged.texture = {.grainMetres = 0.002, .pattern = GrainPattern::regular};
        EXPECT_EQ(feed.set(ground, {}, ridged), "");
    }
    /// It moves at 0.4 m/s for a second; its own surface passes at `alongBall`.
    std::vector<CollisionEvent> pass(double alongBall) {
        for (int i = 1; i <= 100; ++i) {
            FedContact contact{.a = ground, .b = ball, .point = {0.004F * static_cast<float>(i), 0.0F}};
            contact.impulseNewtonSeconds = 2.0 * g * 0.01;
            contact.approachMetresPerSecond = 0.0;
            contact.alongAMetresPerSecond = 0.4;
            contact.alongBMetresPerSecond = alongBall;
            beginStep(0.01);
            EXPECT_EQ(feed.touch(contact), "");
            endStep();
        }
        return events();
    }
};

TEST_F(ContactFeedRubs, WhatRollsGivesTheTonesOfItsRidgesAndTravels) {
    const auto rolled = pass(0.4), slid = pass(0.0);
    ASSERT_GT(rolled.size(), 190U);
    for (std::size_t i = 1; i < rolled.size(); ++i)
        EXPECT_NEAR(static_cast<double>(rolled[i].timeNs - rolled[i - 1].timeNs), 5.0e6, 10.0e3);
    for (const CollisionEvent& e : rolled) {
        EXPECT_EQ(e.source.kind, ContactKind::roll);
        EXPECT_NEAR(e.x, 0.4 * 1.0e-9 * static_cast<double>(e.timeNs), 0.004);
    }
    ASSERT_GT(slid.size(), 190U);
    EXPECT_EQ(slid.back().source.kind, ContactKind::slide);
    // a fifth is felt of what rolls
    EXPECT_NEAR(slid.back().amplitude, 5.0 * rolled.back().amplitude, 1.0e-6);
    EXPECT_NEAR(slid.back().source.impulseNewtonSeconds, 0.1 * 2.0 * g / 9.80665 * 0.4, 1.0e-3);
}

TEST_F(ContactFeedRubs, WhatIsTakenAwayOrNotToldRubsNoMore) {
    pass(0.4);
    step();
    EXPECT_TRUE(events().empty());
    pass(0.4);
    EXPECT_EQ(feed.remove(ball), "");
    EXPECT_EQ(feed.set(ball, {.massKg = 2.0}, camera()), "");
    step();
    EXPECT_TRUE(events().empty());
}

} // namespace
} // namespace physvib
