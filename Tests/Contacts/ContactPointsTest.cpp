// SPDX-License-Identifier: MIT
// Points of pairs: what is new while its pair touches is a collision, and what is told at several points is
// solved together.
#include "FedWorld.h"

namespace physvib::contact_points_test {

constexpr std::int32_t ground = 0, body = 1;
constexpr double dt = 0.01;

class ContactPoints : public FedWorld {
protected:
    ContactPoints() { set(ground, {}); }
    void setBody(double massKg, double inertia) { set(body, {massKg, inertia}, source); }
    void fall(Vector2 centre, Vector2 velocity, float spin = 0.0F) {
        EXPECT_EQ(feed.move(body, centre, {velocity, spin}), "");
    }
    static FedContact at(float x, std::int32_t id) {
        FedContact contact;
        contact.a = ground;
        contact.b = body;
        contact.point = {x, 0.0F};
        contact.pointId = id;
        return contact;
    }
};

/// A box of 0.5 kg, 1 x 0.5 m, flat at 2.426 m/s; with and without its inertia, at corners and between them.
class FlatLandings : public ContactPoints, public testing::WithParamInterface<int> {};

TEST_P(FlatLandings, AreTheLandingAtHoweverManyPoints) {
    constexpr double massKg = 0.5, speed = 2.426;
    for (const double inertia : {0.0, massKg * (1.0 + 0.25) / 12.0, 0.001})
        for (const double restitution : {0.0, 0.5})
            for (const bool isSoft : {true, false}) {
                SCOPED_TRACE(inertia);
                setBody(massKg, inertia);
                fall({0.0F, 0.25F}, {0.0F, -static_cast<float>(speed)});
                begin();
                for (int i = 0; i < GetParam(); ++i) {
                    FedContact contact =
                        at(-0.5F + static_cast<float>(i) / static_cast<float>(GetParam() - 1), i);
                    contact.isSoft = isSoft;
                    contact.restitution = restitution;
                    if (isSoft) contact.impulseNewtonSeconds = 0.1; // what a spring pushes in its first step
                    touch(contact);
                }
                end();
                step(); // apart again
                const CollisionEvent hit = only();
                const double whole = massKg * speed * (1.0 + restitution);
                EXPECT_NEAR(hit.source.impulseNewtonSeconds, whole, 0.01 * whole);
                EXPECT_NEAR(hit.x, 0.0, 0.01);
            }
}
INSTANTIATE_TEST_SUITE_P(Points, FlatLandings, testing::Values(2, 3, 4));

/// A pole of 2 m and 3 kg topples about the foot that stands, and its head comes down at 7 m/s: rigid bodies
/// that hold at the foot stop with m/3 of that speed.
class ToppledPoles : public ContactPoints, public testing::WithParamInterface<std::int32_t> {
protected:
    void topple(double impulseOfPair) {
        setBody(3.0, 3.0 * 4.0 / 12.0);
        fall({1.0F, 0.0F}, {0.0F, -3.5F}, -3.5F); // about the foot at 0
        FedContact foot = at(0.0F, GetParam() == FedContact::byPlace ? FedContact::byPlace : 4);
        foot.approachMetresPerSecond = 0.0;
        for (int k = 0; k < 3; ++k) step({foot}); // it stands
        EXPECT_TRUE(events().empty());
        begin();
        for (const bool isHead : {false, true}) {
            FedContact contact =
                at(isHead ? 2.0F : 0.0F, GetParam() == FedContact::byPlace ? FedContact::byPlace
                                         : isHead                          ? 9
                                                                           : 4);
            if (impulseOfPair > 0.0) {
                contact.impulseNewtonSeconds = impulseOfPair;
                contact.isImpulseOfPair = true;
            }
            touch(contact);
        }
        end();
    }
};

TEST_P(ToppledPoles, AreFeltAtTheirHead) {
    topple(0.0);
    const CollisionEvent hit = only();
    EXPECT_NEAR(hit.source.impulseNewtonSeconds, 3.0 / 3.0 * 7.0, 0.01);
    EXPECT_NEAR(hit.x, 2.0, 1.0e-6);
}

// The foot holds with half as much as the head, upwards: m/3 v and m/6 v of m/2 v.
TEST_P(ToppledPoles, HaveTheShareOfTheirHeadWhereTheEngineTellsOnlyThePairs) {
    topple(12.0);
    EXPECT_NEAR(onlyImpulse(), 12.0 * 2.0 / 3.0, 0.02);
}
INSTANTIATE_TEST_SUITE_P(Points, ToppledPoles, testing::Values(0, FedContact::byPlace));

// Its foot has landed a step before and still comes down, as where springs push: it only stops, the head
// bounces. Two points of a pole, by pencil: each stops its own speed and some of the other's.
TEST_F(ContactPoints, OnlyWhatIsNewBounces) {
    constexpr double perKg = 1.0 / 3.0, perInertia = 1.0, own = perKg + perInertia, of = perKg - perInertia;
    setBody(1.0 / perKg, 1.0 / perInertia);
    fall({1.0F, 0.0F}, {});
    for (const double restitution : {0.0, 0.5, 1.0})
        for (const double footSpeed : {0.0, 1.0, 3.0}) {
            FedContact foot = at(0.0F, 4), head = at(2.0F, 9);
            foot.restitution = head.restitution = restitution;
            foot.approachMetresPerSecond = head.approachMetresPerSecond = 3.0;
            step({foot});
            EXPECT_NEAR(onlyImpulse(), (1.0 + restitution) * 3.0 / own, 1e-6);
            foot.approachMetresPerSecond = footSpeed;
            step({foot, head});
            EXPECT_NEAR(onlyImpulse(),
                        (own * (1.0 + restitution) * 3.0 - of * footSpeed) / (own * own - of * of), 1e-6)
                << restitution << ", foot at " << footSpeed << " m/s";
            step(); // apart again
        }
}

TEST_F(ContactPoints, ABallThatRollsHasOnePointWhereverItIs) {
    setBody(2.0, 0.0125);
    for (int k = 0; k < 100; ++k) {
        fall({3.0F * 0.01F * static_cast<float>(k), 0.1F}, {3.0F, -0.1F}, -30.0F);
        FedContact contact = at(3.0F * 0.01F * static_cast<float>(k), FedContact::byPlace);
        contact.approachMetresPerSecond = k == 0 ? 0.1 : 0.2; // of a new point an impact, and no kick
        step({contact});
    }
    EXPECT_TRUE(events().empty());
}

TEST_F(ContactPoints, ANewPointIsNoCollisionWhereOnlyAnImpulseIsTold) {
    setBody(2.0, 0.0);
    for (int step = 0; step < 4; ++step) {
        begin();
        for (std::int32_t id = 0; id <= step; ++id) {
            FedContact contact = at(0.2F * static_cast<float>(id), id);
            contact.impulseNewtonSeconds = step == 0 ? 2.0 * g * dt : 3.0; // leans, loaded
            touch(contact);
        }
        end();
    }
    EXPECT_TRUE(events().empty());
}

TEST_F(ContactPoints, APointThatGoesAndComesBackIsNew) {
    setBody(2.0, 0.0);
    FedContact resting = at(0.0F, 0), rocking = at(1.0F, 1);
    resting.approachMetresPerSecond = 0.0;
    rocking.approachMetresPerSecond = 1.0;
    for (int k = 0; k < 3; ++k) {
        step({resting});
        step({resting, rocking});
    }
    EXPECT_EQ(events().size(), 3U);
}

TEST_F(ContactPoints, WhatBeginsAndEndsWithinAStepIsFelt) {
    setBody(2.0, 0.0);
    begin();
    FedContact contact = at(0.0F, FedContact::noPoint);
    contact.approachMetresPerSecond = 2.0;
    EXPECT_EQ(feed.begin(contact), "");
    EXPECT_EQ(feed.end(ground, body), "");
    end();
    EXPECT_EQ(onlyImpulse(), 4.0);
}

/// Five balls of 1 kg in a row, the last one feels; velocities before and after are all that is told.
TEST_F(ContactPoints, ARowHandsOnByMomentumAlone) {
    for (const std::int32_t id : {1, 2, 3, 4, 5})
        set(id, {.massKg = 1.0}, {.frequencyHz = 200.0, .decayPerSecond = 30.0, .isCamera = id == 5});
    const float after[] = {0.1F, 0.15F, 0.2F, 0.55F, 2.0F};
    for (int step = 0; step < 8; ++step) {
        begin();
        for (const std::int32_t id : {1, 2, 3, 4, 5}) {
            const float before = id == 1 ? 3.0F : 0.0F;
            move(id, {0.2F * static_cast<float>(id), 0.0F}, {{before, 0.0F}, 0.0F},
                 {{step == 5 ? after[id - 1] : before, 0.0F}, 0.0F});
        }
        for (const std::int32_t id : {1, 2, 3, 4}) {
            if ((id == 1) != (step == 5) && id == 1) continue;
            FedContact contact = at(0.0F, 0);
            contact.a = id;
            contact.b = id + 1;
            contact.normal = {1.0F, 0.0F};
            contact.isSoft = true;
            contact.restitution = 0.9;           // told by its speed, and the most that can be
            contact.impulseNewtonSeconds = 77.0; // whatever the engine says
            touch(contact);
        }
        end();
    }
    const CollisionEvent hit = only();
    EXPECT_NEAR(hit.source.impulseNewtonSeconds, 2.0, 0.01); // its own momentum
    EXPECT_EQ(hit.source.other, 4);
}

/// A ball of 1 kg at 3 m/s lands on a slab of 1 kg that lies on the ground, and all comes to rest: 3 N s,
/// where two free bodies would have half of it.
TEST_F(ContactPoints, ALandingOnWhatIsSupportedIsThatOfTheWhole) {
    constexpr std::int32_t slab = 2;
    setBody(1.0, 0.0);
    set(slab, {.massKg = 1.0});
    for (int step = 0; step < 4; ++step) {
        begin();
        move(body, {0.0F, 0.3F}, {{0.0F, -3.0F}, 0.0F}, {{0.0F, step == 3 ? 0.0F : -3.0F}, 0.0F});
        move(slab, {0.0F, 0.1F}, {{0.0F, -static_cast<float>(g * dt)}, 0.0F}, {});
        FedContact rests = at(0.0F, 0), lands = at(0.0F, 0);
        rests.b = slab;
        lands.a = slab;
        touch(rests);
        if (step == 3) touch(lands);
        end();
    }
    EXPECT_NEAR(onlyImpulse(), 3.0, 0.02);
    EXPECT_EQ(feed.moved(body, {}), "step: expected to be within one");
}

// A box of 1 kg that carries two of its kind: the engine says that it gave 3 m v and what gravity adds; at
// one corner, and at two.
TEST_F(ContactPoints, WhatCarriesOthersIsStruckByAllThatTheEnginePushes) {
    constexpr double speed = 3.0;
    const auto felt = [&](int points, bool isPushWhole, double pushed) {
        setBody(1.0, 0.0);
        fall({0.0F, 0.25F}, {0.0F, -static_cast<float>(speed)});
        begin();
        for (int i = 0; i < points; ++i) {
            FedContact contact =
                at(points == 1 ? 0.0F : static_cast<float>(i) - 0.5F, points == 1 ? FedContact::noPoint : i);
            contact.isSoft = true;
            contact.isPushWhole = isPushWhole;
            contact.impulseNewtonSeconds = pushed / points;
            contact.fraction = 0.0;
            touch(contact);
        }
        end();
        step(); // it bounces
        const auto all = events();
        return all.size() == 1 ? all[0].source.impulseNewtonSeconds : -1.0 - static_cast<double>(all.size());
    };
    for (const int points : {1, 2}) {
        SCOPED_TRACE(points);
        EXPECT_NEAR(felt(points, true, 3.0 * (speed + g * dt)), 3.0 * speed, 1e-3);
        EXPECT_NEAR(felt(points, true, 1.1 * speed), speed, 1e-3) << "pushes also move overlaps apart";
        EXPECT_NEAR(felt(points, true, 0.2), speed, 1e-3) << "it takes several steps";
        EXPECT_NEAR(felt(points, false, 3.0 * speed), speed, 1e-3) << "nobody said that this is all of it";
    }
}

TEST_F(ContactPoints, OfNumbersBelowTwoAndImpulsesThatAreMissingAreRefused) {
    setBody(2.0, 0.0);
    begin();
    EXPECT_EQ(feed.touch(at(0.0F, -3)), "point: expected a number from 0 on, -1 (none) or -2 (by place)");
    FedContact contact = at(0.0F, 0);
    contact.isImpulseOfPair = true;
    EXPECT_EQ(feed.touch(contact), "impulse: expected one, as it is said to be the pair's");
    end();
    EXPECT_TRUE(events().empty());
}

} // namespace physvib::contact_points_test
