// SPDX-License-Identifier: MIT
// A world of numbers: an engine's part is written here, and what is felt is known by pencil and paper.
#include "Contacts/ContactFeed.h"
#include "FedWorld.h"
#include "Support/ClosedForm.h"
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

namespace physvib::contact_feed_test {

constexpr std::int32_t ground = 0, ball = 1;

class ContactFeedTest : public FedWorld {
protected:
    ContactFeedTest() {
        set(ground, {});
        set(ball, {.massKg = 2.0}, source);
    }
};

FedContact landing() { return {.a = ground, .b = ball, .point = {0.25F, 0.0F}}; }

TEST_F(ContactFeedTest, TheMassIsThatOfTheMoment) {
    for (const double massKg : {0.5, 2.0, 0.0, 2.0}) { // its own; of a body that was let go, too
        EXPECT_EQ(feed.setMass(ball, massKg), "");
        FedContact contact = landing();
        contact.approachMetresPerSecond = 3.0;
        step({contact});
        for (int k = 0; k < 3; ++k) step();
        const auto felt = events();
        ASSERT_EQ(felt.size(), massKg > 0.0 ? 1u : 0u);
        if (massKg > 0.0) EXPECT_NEAR(felt[0].source.impulseNewtonSeconds, 3.0 * massKg, 1e-6);
    }
    EXPECT_NE(feed.setMass(ball, -1.0), "");
    EXPECT_NE(feed.setMass(7, 1.0), "");
}

/// Eq. 5.7: the hand is as heavy as the heaviest body that can be moved, whatever came, changed and went.
TEST_F(ContactFeedTest, TheHandIsTheHeaviestBodyOfTheMoment) {
    feed.configure({});
    test::Random random{7};
    std::map<std::int32_t, double> masses{{ball, 2.0}};
    for (int edit = 0; edit < 500; ++edit) {
        const std::int32_t id = 1 + random.below(4);
        const double massKg = random.below(8); // 0: it is let go
        const bool isKnown = masses.contains(id);
        const int way = random.below(3);
        if (isKnown && way == 0) {
            EXPECT_EQ(feed.remove(id), "");
            masses.erase(id);
        } else if (masses[id] = massKg; isKnown && way == 1) {
            EXPECT_EQ(feed.setMass(id, massKg), "");
        } else {
            set(id, {.massKg = massKg});
        }
        step();
        double heaviest = 0.0;
        for (const auto& [body, mass] : masses) heaviest = std::max(heaviest, mass);
        ASSERT_EQ(feed.impactModel().handMassKg, heaviest) << "edit " << edit;
    }
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
            begin(dt);
            if (height < speed * dt) {
                onset = static_cast<double>(feed.timeNs()) * 1.0e-9 - dt + height / speed;
                FedContact contact = landing();
                contact.approachMetresPerSecond = speed * (1.0 + error);
                contact.restitution = 0.5;
                contact.gapMetres = height;
                EXPECT_EQ(feed.begin(contact), "");
            }
            end();
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
        const CollisionEvent hit = only();
        const double impulse = 2.0 * speed * 1.5;
        EXPECT_NEAR(hit.source.impulseNewtonSeconds, impulse, 0.01 * impulse);
        EXPECT_NEAR(hit.amplitude, speed * 1.5, 0.01 * speed * 1.5); // Eq. 5.4
        EXPECT_NEAR(static_cast<double>(hit.timeNs) * 1.0e-9, onset, 1.0e-4);
        EXPECT_EQ(hit.source.fixture, ball);
        EXPECT_EQ(hit.source.other, ground);
        EXPECT_EQ(hit.x, 0.25);
    }
}

INSTANTIATE_TEST_SUITE_P(StepsPerSecond, ContactFeedSpeeds, testing::Values(50, 100, 240, 1000));

TEST_F(ContactFeedTest, AnOverlapFoundAfterTheStepLiesBeforeIt) {
    step();
    FedContact contact = landing();
    contact.impulseNewtonSeconds = 6.0;
    contact.approachMetresPerSecond = 2.0;
    contact.gapMetres = -0.006; // 3 ms ago
    contact.gapFraction = 1.0;
    step({contact});
    const CollisionEvent hit = only();
    EXPECT_EQ(hit.timeNs, 17'000'000);
    EXPECT_EQ(hit.source.impulseNewtonSeconds, 6.0);
}

// Engines that look ahead push before the surfaces meet. Two points are solved together.
TEST_F(ContactFeedTest, AnImpactMayComeAfterTheStepThatReportsIt) {
    begin();
    FedContact contact = landing();
    contact.approachMetresPerSecond = 2.0;
    contact.isSoft = true;
    contact.fraction = 1.3;
    for (contact.pointId = 0; contact.pointId < 2; ++contact.pointId) touch(contact);
    contact.fraction = 2.1;
    EXPECT_EQ(feed.touch(contact), "fraction: expected -1 to 2");
    end();
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
        step({contact});
        contact.impulseNewtonSeconds = 2.0 * g * 0.01;
    }
    step(); // not named: it has ended
    contact.impulseNewtonSeconds = 4.0;
    step({contact});
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
        step({contact});
        contact.impulseNewtonSeconds = later;
    }
    EXPECT_EQ(onlyImpulse(), 2.0 * 2.0 * 1.5);
}

// A face ahead leaves the speed that its gap takes, a spring most of it, an edge rolled over nearly all.
TEST_F(ContactFeedTest, ACollisionIsWhatTheSolverChangedAndLeft) {
    FedContact contact = landing();
    contact.isSoft = true;
    for (const double gap : {0.02, -0.001, 0.001}) {
        begin();
        move(ball, {}, {{0.0F, -3.0F}, 0.0F}, {{0.0F, gap == 0.02 ? -2.0F : -2.9F}, 0.0F});
        contact.gapMetres = gap;
        touch(contact);
        end(), step();
        EXPECT_NEAR(events().at(0).source.impulseNewtonSeconds, gap == 0.001 ? 0.4 : 6.0, 1e-6);
    }
}

// Havok stops what bounces, and sends it back in the next step.
TEST_F(ContactFeedTest, ABounceThatComesAStepLaterIsWhole) {
    FedContact contact = landing();
    contact.isSoft = true, contact.restitution = 0.5;
    for (const float left : {0.0F, -0.1F, 0.1F}) {
        begin();
        move(ball, {}, {{0.0F, -3.0F}, 0.0F}, {{0.0F, left}, 0.0F});
        touch(contact);
        end(), step();
        EXPECT_NEAR(events().at(0).source.impulseNewtonSeconds, 9.0, 1e-6) << left;
    }
}

// A corner at (0.25, -0.05) from the centre; friction holds it, or is 0.1 of what goes along the normal:
// the impulses are those of two equations for the corner's velocity.
TEST_F(ContactFeedTest, FrictionAtAnEdgeCountsAsTheEngineShowsIt) {
    constexpr double mass = 2.0, inertia = 0.1, speed = 3.0, x = 0.25, y = -0.05;
    constexpr double along = 1.0 / mass + x * x / inertia, across = 1.0 / mass + y * y / inertia,
                     both = -x * y / inertia;
    set(ball, {.massKg = mass, .inertiaKgSquareMetres = inertia}, source);
    for (const bool isHeld : {true, false}) {
        const double push = speed / (isHeld ? along - both * both / across : along - 0.1 * both);
        const double drag = isHeld ? -both / across * push : -0.1 * push;
        FedContact contact = landing();
        contact.isSoft = true;
        contact.point = {static_cast<float>(x), 0.0F};
        begin();
        move(ball, {0.0F, static_cast<float>(-y)}, {{0.0F, static_cast<float>(-speed)}, 0.0F},
             {{static_cast<float>(drag / mass), static_cast<float>(push / mass - speed)},
              static_cast<float>((x * push - y * drag) / inertia)});
        touch(contact);
        end(), step();
        EXPECT_NEAR(events().at(0).source.impulseNewtonSeconds, push, 2e-3 * push) << isHeld;
    }
}

// It rolls there at 2 m/s, and friction of half of the push lifts it off the floor, which gives it nothing.
TEST_F(ContactFeedTest, AWallThatLiftsABallIsNotTheFloor) {
    constexpr std::int32_t wall = 2;
    set(ball, {.massKg = 2.0, .inertiaKgSquareMetres = 0.02}, source);
    set(wall, {});
    const BodyMotion rolls{{2.0F, 0.0F}, -20.0F}, lifted{{0.0F, 1.0F}, -10.0F};
    for (int k = 0; k < 3; ++k) {
        begin();
        move(ball, {0.0F, 0.1F}, rolls, k < 2 ? rolls : lifted);
        touch({.a = ground, .b = ball, .isSoft = true});
        const FedContact stops{
            .a = wall, .b = ball, .point = {0.1F, 0.1F}, .normal = {-1.0F, 0.0F}, .isSoft = true};
        if (k == 2) touch(stops);
        end();
    }
    step();
    EXPECT_NEAR(events().at(0).source.impulseNewtonSeconds, 4.0, 0.01);
}

// Of an engine that sees the surface coming: two of three metres per second are taken in this step, by twice
// the impulse that two free bodies would need, as the lower one stands on the ground.
TEST_F(ContactFeedTest, AStopOverTwoStepsIsWholeOnWhatStands) {
    constexpr std::int32_t lower = 2;
    set(lower, {.massKg = 2.0});
    for (int k = 0; k < 3; ++k) {
        begin();
        move(lower, {}, {}, {});
        FedContact stands{.a = ground, .b = lower}, meets{.a = lower, .b = ball, .point = {0.0F, 1.0F}};
        stands.isSoft = meets.isSoft = true;
        touch(stands);
        if (k == 2) {
            move(ball, {0.0F, 2.0F}, {{0.0F, -3.0F}, 0.0F}, {{0.0F, -1.0F}, 0.0F});
            meets.gapMetres = 0.01;
            touch(meets);
        }
        end();
    }
    step();
    EXPECT_NEAR(events().at(0).source.impulseNewtonSeconds, 6.0, 0.2);
}

TEST_F(ContactFeedTest, SoftContactsHandOnWhatTheyPush) {
    constexpr std::int32_t striker = 2;
    set(ground, {.massKg = 2.0});
    set(striker, {.massKg = 2.0});
    FedContact touching = landing(), collision = {.a = striker, .b = ground};
    touching.isSoft = collision.isSoft = true;
    touching.impulseNewtonSeconds = 0.0;
    collision.impulseNewtonSeconds = 0.1;
    collision.approachMetresPerSecond = 3.0;
    for (int i = 0; i < 6; ++i) {
        begin();
        touching.impulseNewtonSeconds = i == 4 ? 1.25 : 0.0;
        touch(touching);
        if (i >= 4) touch(collision);
        end();
    }
    EXPECT_EQ(onlyImpulse(), 1.25);
}

TEST_F(ContactFeedTest, WhatIsBornAtRestIsNotFelt) {
    FedContact contact = landing();
    contact.impulseNewtonSeconds = 2.0 * g * 0.01;
    begin();
    EXPECT_EQ(feed.begin(contact), "");
    end();
    EXPECT_TRUE(events().empty());
}

TEST_F(ContactFeedTest, PointsOfAFlatLandingAreOneCollisionInTheirMiddle) {
    FedContact contact = landing(), other = contact;
    contact.impulseNewtonSeconds = other.impulseNewtonSeconds = 3.0;
    other.point.x = 0.75F;
    step({contact, other});
    const CollisionEvent hit = only();
    EXPECT_EQ(hit.source.impulseNewtonSeconds, 6.0);
    EXPECT_EQ(hit.x, 0.5);
}

TEST_F(ContactFeedTest, ACollisionBesideTheCentreHasLessMass) {
    set(ball, {.massKg = 2.0, .inertiaKgSquareMetres = 0.5}, source);
    ASSERT_EQ(feed.move(ball, {0.0F, 0.5F}, {{0.0F, -3.0F}, 0.0F}), "");
    begin();
    // neither is told: the motion is
    EXPECT_EQ(feed.begin({.a = ground, .b = ball, .point = {0.5F, 0.0F}, .restitution = 1.0}), "");
    end();
    EXPECT_NEAR(onlyImpulse(), 3.0 * 2.0 / (1.0 / 2.0 + 0.25 / 0.5), 1.0e-6);
}

TEST_F(ContactFeedTest, WithItsMassABodysInertiaChangesAsMuch) {
    set(ball, {.massKg = 2.0, .inertiaKgSquareMetres = 0.5}, source);
    ASSERT_EQ(feed.move(ball, {0.0F, 0.5F}, {{0.0F, -3.0F}, 0.0F}), "");
    for (const double massKg : {1.0, 6.0, 0.0, 3.0, 2.0}) { // 0: it is held meanwhile
        EXPECT_EQ(feed.setMass(ball, massKg), "");
        FedContact contact = landing();
        contact.point.x = 0.5F;
        step({contact});
        step();
        const auto felt = events();
        ASSERT_EQ(felt.size(), massKg > 0.0 ? 1U : 0U);
        if (massKg > 0.0)
            EXPECT_NEAR(felt[0].source.impulseNewtonSeconds, 3.0 * massKg / (1.0 + 0.25 * 2.0 / 0.5), 1e-6);
    }
}

TEST_F(ContactFeedTest, WhatStandsIsTheHandUntilItCanMove) {
    feed.configure({});
    HapticFixture heavy = source;
    heavy.staticMassKg = 5.0;
    set(ball, {2.0}, heavy);
    for (const bool isSetAgain : {false, true})
        for (const double massKg : {0.0, 3.0, 0.0, 7.0}) {
            EXPECT_EQ(isSetAgain ? feed.set(ball, {massKg}, heavy) : feed.setMass(ball, massKg), "");
            step();
            EXPECT_EQ(feed.impactModel().handMassKg, massKg > 0.0 ? massKg : 5.0) << isSetAgain;
        }
}

/// Five balls that touch, the last one a camera; what strikes the first goes through all of them.
TEST_F(ContactFeedTest, AChainHandsACollisionOnAndItCountsOnce) {
    for (const std::int32_t id : {1, 2, 3, 4, 5})
        set(id, {.massKg = 1.0, .gravityScale = 0.0}, id == 5 ? source : HapticFixture{});
    FedContact contact;
    contact.normal = {1.0F, 0.0F};
    for (int i = 0; i < 10; ++i) {
        begin();
        for (const std::int32_t id : {2, 3, 4, 1}) {
            contact.a = id;
            contact.b = id + 1;
            contact.impulseNewtonSeconds = id == 1 ? 1.2 : i == 5 ? 0.6 : 0.0;
            if (id != 1 || i == 5) touch(contact);
        }
        end();
    }
    const CollisionEvent hit = only();
    EXPECT_EQ(hit.source.fixture, 5);
    EXPECT_EQ(hit.source.other, 4);
    EXPECT_NEAR(hit.source.impulseNewtonSeconds, 0.6, 1.0e-6);
    EXPECT_EQ(hit.timeNs, 50'000'000);
}

TEST_F(ContactFeedTest, ABodyThatGoesKeepsItsHitsAndItsNumberIsFree) {
    FedContact contact = landing();
    contact.impulseNewtonSeconds = 6.0;
    step({contact});
    EXPECT_EQ(feed.remove(ball), "");
    EXPECT_EQ(feed.remove(ball), "body: expected one that was set");
    EXPECT_EQ(events().size(), 1U);
    set(ball, {.massKg = 1.0}, source);
    step();
    EXPECT_EQ(feed.end(ground, ball), "contact: expected one that has begun");
}

TEST_F(ContactFeedTest, RefusesWhatCannotBeAndNothingIsChanged) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(feed.set(-1, {}, {}), "body: expected a number from 0 on");
    EXPECT_EQ(feed.set(7, {.massKg = nan}, {}), "mass: expected 0 to 10^12 kg");
    EXPECT_EQ(feed.set(7, {}, {.frequencyHz = nan}), "frequency: expected 0 to 20000 Hz");
    EXPECT_EQ(feed.move(7, {}, {}), "body: expected one that was set");
    EXPECT_EQ(feed.touch(landing()), "step: expected to be within one");
    EXPECT_EQ(feed.endStep(), "step: expected to be within one");
    EXPECT_EQ(feed.beginStep(-1, g), "time: expected not to go back, and less than 10^17 ns");
    begin();
    EXPECT_EQ(feed.beginStep(20'000'000, g), "step: expected not to be within one");
    EXPECT_EQ(feed.remove(ball), "step: expected not to be within one");
    const auto errorOf = [&](auto change) {
        FedContact contact = landing();
        change(contact);
        return feed.touch(contact);
    };
    EXPECT_EQ(errorOf([](auto& c) { c.normal = {0.0F, 0.0F}; }), "normal: expected a length of 1");
    EXPECT_EQ(errorOf([=](auto& c) { c.approachMetresPerSecond = nan; }),
              "approach: expected a number of m/s");
    EXPECT_EQ(errorOf([=](auto& c) { c.alongBMetresPerSecond = nan; }),
              "speed along a surface: expected a number of m/s");
    EXPECT_EQ(errorOf([](auto& c) { c.b = ground; }), "bodies: expected two");
    end();
    EXPECT_TRUE(events().empty());
    ImpactSettings release;
    release.timing = ImpactTiming::release;
    EXPECT_THROW(ContactFeed{release}, std::invalid_argument);
}

/// A ball of 2 kg on ridges 2 mm apart, told step by step as its engine would.
class ContactFeedRubs : public ContactFeedTest {
protected:
    ContactFeedRubs() {
        HapticFixture ridged = source;
        ridged.texture = {.grainMetres = 0.002, .pattern = GrainPattern::regular};
        set(ground, {}, ridged);
    }
    /// It moves at 0.4 m/s for a second; its own surface passes at `alongBall`.
    std::vector<CollisionEvent> pass(double alongBall) {
        for (int i = 1; i <= 100; ++i) {
            FedContact contact{.a = ground, .b = ball, .point = {0.004F * static_cast<float>(i), 0.0F}};
            contact.impulseNewtonSeconds = 2.0 * g * 0.01;
            contact.approachMetresPerSecond = 0.0;
            contact.alongAMetresPerSecond = 0.4;
            contact.alongBMetresPerSecond = alongBall;
            step({contact});
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
    set(ball, {.massKg = 2.0}, source);
    step();
    EXPECT_TRUE(events().empty());
}

} // namespace physvib::contact_feed_test
