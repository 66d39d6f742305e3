// SPDX-License-Identifier: MIT
// Contacts in space: a plane that is turned gives the same events, and bodies turn about every axis.
#include "FedWorld.h"
#include <array>
#include <random>

namespace physvib::contact_space_test {

constexpr std::int64_t stepNs = 10'000'000;

/// Columns: where x, y and z go.
struct Rotation {
    std::array<Vector3, 3> columns{Vector3{1.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}, {0.0F, 0.0F, 1.0F}};

    Vector3 operator()(Vector3 v) const { return v.x * columns[0] + v.y * columns[1] + v.z * columns[2]; }
    Rotation transposed() const {
        const auto& [x, y, z] = columns;
        return {{Vector3{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}}};
    }
    /// Of a body whose axes it turns, with these moments of inertia.
    InverseInertia inverse(double x, double y, double z) const {
        InverseInertia sum;
        const std::array<double, 3> about{x, y, z};
        for (std::size_t i = 0; i < 3; ++i) {
            const auto a = static_cast<double>(columns[i].x), b = static_cast<double>(columns[i].y),
                       c = static_cast<double>(columns[i].z);
            sum.xx += a * a / about[i], sum.yy += b * b / about[i], sum.zz += c * c / about[i];
            sum.xy += a * b / about[i], sum.xz += a * c / about[i], sum.yz += b * c / about[i];
        }
        return sum;
    }
    /// By two angles, about z and then about x.
    static Rotation by(double aboutZ, double aboutX) {
        const auto c = static_cast<float>(std::cos(aboutZ)), s = static_cast<float>(std::sin(aboutZ)),
                   d = static_cast<float>(std::cos(aboutX)), t = static_cast<float>(std::sin(aboutX));
        return {{Vector3{c, s * d, s * t}, {-s, c * d, c * t}, {0.0F, -t, d}}};
    }
};

/// Exact: x stays, y becomes z.
Rotation upright() { return {{Vector3{1.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 1.0F}, {0.0F, -1.0F, 0.0F}}}; }

/// A random world in the plane, told as it is turned. Style: how contacts are told. Mixed: every second one
/// names its bodies in the other order.
std::vector<CollisionEvent> randomWorld(unsigned seed, int style, const Rotation& turned,
                                        bool isMixed = false) {
    std::mt19937 random{seed};
    const auto number = [&random](float least, float most) {
        return least + (most - least) * static_cast<float>(random() >> 8U) * 0x1p-24F;
    };
    ContactFeed feed{unity()};
    constexpr std::int32_t bodies = 6;
    for (std::int32_t id = 0; id < bodies; ++id) {
        HapticFixture values = source;
        values.isCamera = id % 2 == 0;
        values.staticMassKg = 1.0;
        if (id == 3) values.texture.grainMetres = 0.004;
        const double massKg = id == 0 ? 0.0 : static_cast<double>(number(0.1F, 4.0F));
        EXPECT_EQ(feed.set(id, {massKg, static_cast<double>(number(0.01F, 0.3F))}, values), "");
    }
    for (int step = 1; step <= 60; ++step) {
        EXPECT_EQ(feed.beginStep(step * stepNs, g), "");
        for (std::int32_t id = 0; id < bodies; ++id) {
            const Vector3 centre{number(-1.0F, 1.0F), number(-1.0F, 1.0F)},
                velocity{number(-3.0F, 3.0F), number(-3.0F, 3.0F)}, spin{0.0F, 0.0F, number(-9.0F, 9.0F)};
            EXPECT_EQ(feed.moveInSpace(id, turned(centre), {turned(velocity), turned(spin)}), "");
            if (style == 2)
                EXPECT_EQ(feed.movedInSpace(id, {0.5F * turned(velocity), 0.3F * turned(spin)}), "");
        }
        for (std::int32_t id = 0; id + 1 < bodies; ++id)
            for (std::int32_t point = 0; point < 2; ++point) {
                const float angle = number(-3.0F, 3.0F);
                const Vector3 normal{std::cos(angle), std::sin(angle)};
                FedContact contact;
                contact.a = id, contact.b = id + 1;
                contact.point = turned({number(-1.0F, 1.0F), number(-1.0F, 1.0F)});
                contact.normal = turned(normal);
                contact.restitution = static_cast<double>(number(0.0F, 1.0F));
                contact.gapMetres = static_cast<double>(number(-0.01F, 0.01F));
                contact.pointId = FedContact::byPlace;
                contact.isSoft = contact.isPushWhole = style > 0;
                if (style != 2) contact.impulseNewtonSeconds = static_cast<double>(number(0.0F, 2.0F));
                if (style == 0) {
                    contact.frictionNewtonSeconds =
                        turned(number(-1.0F, 1.0F) * Vector3{-normal.y, normal.x});
                    contact.alongAMetresPerSecond = static_cast<double>(number(0.0F, 2.0F));
                    contact.alongBMetresPerSecond = static_cast<double>(number(0.0F, 2.0F));
                }
                if (isMixed && (step + point) % 2 == 0) {
                    std::swap(contact.a, contact.b);
                    std::swap(contact.alongAMetresPerSecond, contact.alongBMetresPerSecond);
                    contact.normal = -contact.normal;
                    contact.frictionNewtonSeconds = -contact.frictionNewtonSeconds;
                }
                EXPECT_EQ(feed.touch(contact), "");
            }
        EXPECT_EQ(feed.endStep(), "");
    }
    std::vector<CollisionEvent> events;
    feed.flush(events);
    return events;
}

class TurnedWorlds : public testing::TestWithParam<int> {};

TEST_P(TurnedWorlds, OfAPlaneThatStandsUprightAreTheSameToTheBitButForThePlace) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        const auto flat = randomWorld(seed, GetParam(), {}),
                   upright = randomWorld(seed, GetParam(), contact_space_test::upright());
        ASSERT_GT(flat.size(), 50U);
        ASSERT_EQ(flat.size(), upright.size());
        for (std::size_t i = 0; i < flat.size(); ++i) {
            EXPECT_EQ(flat[i].z, 0.0);
            CollisionEvent back = upright[i];
            EXPECT_EQ(back.y, 0.0);
            std::swap(back.y, back.z);
            EXPECT_EQ(back, flat[i]);
        }
    }
}

// Single precision lets an impact near a threshold be one in the one world alone.
TEST_P(TurnedWorlds, InAnyDirectionAreTheSameButForRounding) {
    const Rotation turned = Rotation::by(0.7, -1.1);
    int alike = 0, all = 0;
    for (unsigned seed = 1; seed <= 20; ++seed) {
        const auto flat = randomWorld(seed, GetParam(), {}), tilted = randomWorld(seed, GetParam(), turned);
        if (flat.size() != tilted.size()) continue;
        for (std::size_t i = 0; i < flat.size(); ++i, ++all) {
            const Vector3 place = turned({static_cast<float>(flat[i].x), static_cast<float>(flat[i].y)});
            alike += std::abs(flat[i].timeNs - tilted[i].timeNs) < 2'000 &&
                     std::abs(flat[i].amplitude - tilted[i].amplitude) < 1.0e-4 * flat[i].amplitude + 1e-6 &&
                     std::abs(static_cast<double>(place.z) - tilted[i].z) < 1.0e-4 &&
                     std::abs(static_cast<double>(place.x) - tilted[i].x) < 1.0e-4;
        }
    }
    EXPECT_GT(all, 500);
    EXPECT_GT(alike, all * 98 / 100);
}

TEST_P(TurnedWorlds, AreTheSameWhicheverBodyOfAContactIsNamedFirst) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        const auto all = randomWorld(seed, GetParam(), {}), mixed = randomWorld(seed, GetParam(), {}, true);
        ASSERT_EQ(all.size(), mixed.size()) << seed;
        for (std::size_t i = 0; i < all.size(); ++i) {
            EXPECT_EQ(all[i].source.fixture, mixed[i].source.fixture) << seed;
            EXPECT_EQ(all[i].source.other, mixed[i].source.other) << seed;
            EXPECT_NEAR(static_cast<double>(all[i].timeNs), static_cast<double>(mixed[i].timeNs), 10.0)
                << seed;
            EXPECT_NEAR(all[i].amplitude, mixed[i].amplitude, 1e-5 * all[i].amplitude) << seed;
            EXPECT_NEAR(all[i].x, mixed[i].x, 1e-5) << seed;
            EXPECT_NEAR(all[i].y, mixed[i].y, 1e-5) << seed;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Styles, TurnedWorlds, testing::Values(0, 1, 2));

/// A floor, and a body of 2 kg.
class ContactSpace : public FedWorld {
protected:
    ContactSpace()
        : FedWorld{0.0} {
        set(0, {});
        set(1, {massKg, 0.05}, source);
    }
    FedContact at(Vector3 point, Vector3 normal, std::int32_t id = 0) const {
        FedContact contact;
        contact.a = 0, contact.b = 1;
        contact.point = point;
        contact.normal = normal;
        contact.restitution = restitution;
        contact.pointId = id;
        return contact;
    }
    CollisionEvent onlyOf(const std::vector<FedContact>& contacts) {
        step(contacts);
        return only();
    }
    static constexpr double massKg = 2.0, restitution = 0.5;
};

// J = (1 + e) v / (1/m + n . ((I^-1 (r x n)) x r))
TEST_F(ContactSpace, AnObliqueImpactFollowsFromTheInertiaAboutEveryAxis) {
    for (const auto [aboutZ, aboutX] : {std::pair{0.0, 0.0}, {0.4, 0.0}, {-0.9, 1.3}, {2.0, -0.5}}) {
        const Rotation turned = Rotation::by(aboutZ, aboutX);
        // in the body's own axes r x n = (0.3, 0.2, 0) x (0, 0, 1) = (0.2, -0.3, 0)
        const Vector3 arm = turned({0.3F, 0.2F, 0.0F}), normal = turned({0.0F, 0.0F, 1.0F}),
                      centre{0.5F, 0.5F, 0.25F};
        EXPECT_EQ(feed.moveInSpace(1, centre, {-3.0F * normal, {}}, turned.inverse(0.04, 0.09, 0.5)), "");
        const double perKg = 1.0 / massKg + 0.2 * 0.2 / 0.04 + 0.3 * 0.3 / 0.09;
        const CollisionEvent event = onlyOf({at(centre + arm, normal)});
        EXPECT_NEAR(event.source.impulseNewtonSeconds, 1.5 * 3.0 / perKg, 1.0e-5);
        EXPECT_NEAR(event.z, static_cast<double>(centre.z + arm.z), 1.0e-6);
        step(); // the next contact is new again
    }
}

TEST_F(ContactSpace, WithoutAMatrixABodyTurnsAboutEveryAxisAlike) {
    for (const Vector3 arm : {Vector3{0.2F, 0.0F, 0.0F}, {0.0F, 0.0F, 0.2F}, {0.12F, 0.0F, 0.16F}}) {
        EXPECT_EQ(feed.moveInSpace(1, {}, {{0.0F, -3.0F, 0.0F}, {}}), "");
        const CollisionEvent event = onlyOf({at(arm, {0.0F, 1.0F, 0.0F})});
        EXPECT_NEAR(event.source.impulseNewtonSeconds, 4.5 / (1.0 / massKg + 0.04 / 0.05), 1.0e-5);
        step(); // the next contact is new again
    }
}

// Solved together: four corners of a crate are one landing, in the middle.
TEST_F(ContactSpace, FourCornersAreOneLanding) {
    const Rotation turned = Rotation::by(0.8, 0.6);
    const Vector3 normal = turned({0.0F, 1.0F, 0.0F}), centre{0.1F, 0.2F, 0.3F};
    EXPECT_EQ(feed.moveInSpace(1, centre, {-2.0F * normal, {}}, turned.inverse(0.1, 0.2, 0.15)), "");
    std::vector<FedContact> corners;
    for (const float x : {-0.4F, 0.4F})
        for (const float z : {-0.3F, 0.3F})
            corners.push_back(
                at(centre + turned({x, -0.25F, z}), normal, static_cast<std::int32_t>(corners.size())));
    const CollisionEvent event = onlyOf(corners);
    EXPECT_NEAR(event.source.impulseNewtonSeconds, massKg * 2.0 * 1.5, 1.0e-3);
    const Vector3 middle = centre + turned({0.0F, -0.25F, 0.0F});
    EXPECT_NEAR(event.x, static_cast<double>(middle.x), 1.0e-4);
    EXPECT_NEAR(event.y, static_cast<double>(middle.y), 1.0e-4);
    EXPECT_NEAR(event.z, static_cast<double>(middle.z), 1.0e-4);
}

// A ball strikes two that touch, along a line in space; velocities before and after are all that is told.
TEST_F(ContactSpace, ARowInSpaceHandsAnImpactOnByMomentum) {
    const Vector3 along = Rotation::by(0.3, 1.0)({1.0F, 0.0F, 0.0F});
    for (const std::int32_t id : {2, 3}) set(id, {massKg, 0.05}, id == 3 ? source : HapticFixture{});
    set(1, {massKg, 0.05});
    const auto tell = [&](std::int32_t a, float speed, float after) {
        EXPECT_EQ(feed.moveInSpace(a, 0.2F * static_cast<float>(a) * along, {speed * along, {}}), "");
        EXPECT_EQ(feed.movedInSpace(a, {after * along, {}}), "");
    };
    const auto touching = [&](std::int32_t a) {
        FedContact contact = at(0.2F * (static_cast<float>(a) + 0.5F) * along, along);
        contact.a = a, contact.b = a + 1;
        touch(contact);
    };
    for (int step = 0; step < 4; ++step) {
        const bool isStruck = step == 2;
        begin();
        tell(1, isStruck ? 3.0F : 0.0F, 0.0F), tell(2, 0.0F, 0.0F), tell(3, 0.0F, isStruck ? 3.0F : 0.0F);
        if (isStruck) touching(1);
        touching(2);
        end();
    }
    const CollisionEvent hit = only();
    EXPECT_EQ(hit.source.fixture, 3);
    EXPECT_NEAR(hit.source.impulseNewtonSeconds, massKg * 3.0, 0.01);
    EXPECT_NEAR(hit.z, 0.5 * static_cast<double>(along.z), 1.0e-5);
}

TEST_F(ContactSpace, FrictionIsPartOfTheImpulseInWhicheverOrderBodiesAreNamed) {
    FedContact contact = at({}, {0.6F, 0.0F, 0.8F}), other = contact;
    contact.impulseNewtonSeconds = other.impulseNewtonSeconds = 2.0;
    contact.frictionNewtonSeconds = {0.0F, 1.5F, 0.0F};
    std::swap(other.a, other.b);
    other.normal = -other.normal;
    other.frictionNewtonSeconds = {0.0F, -1.5F, 0.0F};
    EXPECT_NEAR(onlyOf({contact, other}).source.impulseNewtonSeconds, 5.0, 1.0e-6); // of 4 and 3
}

TEST_F(ContactSpace, AnEventHasThePartOfItsSource) {
    HapticFixture values = source;
    values.part = 7;
    set(1, {massKg, 0.05}, values);
    EXPECT_EQ(feed.moveInSpace(1, {}, {{0.0F, -3.0F, 0.0F}, {}}), "");
    EXPECT_EQ(onlyOf({at({}, {0.0F, 1.0F, 0.0F})}).source.part, 7);
    values.part = -1;
    EXPECT_EQ(feed.set(1, {massKg, 0.05}, values), "part: expected a number from 0 on");
}

TEST_F(ContactSpace, WhatIsNoMotionInSpaceIsNamed) {
    const float nan = std::nanf("");
    EXPECT_EQ(feed.moveInSpace(9, {}, {}), "body: expected one that was set");
    EXPECT_EQ(feed.moveInSpace(1, {0.0F, 0.0F, nan}, {}), "place: expected numbers");
    EXPECT_EQ(feed.moveInSpace(1, {}, {{}, {nan, 0.0F, 0.0F}}), "velocity: expected numbers");
    const std::string_view fault =
        "inverse inertia: expected that of a body (xx, yy, zz, xy, xz, yz; 0 where it cannot turn)";
    for (const InverseInertia& wrong : {InverseInertia{-1.0}, InverseInertia{.xx = static_cast<double>(nan)},
                                        InverseInertia{.xx = 1.0, .yy = 1.0, .xy = 1.1},
                                        InverseInertia{1.0, 1.0, 1.0, -0.9, -0.9, -0.9}, // of no two axes
                                        InverseInertia{.xx = 1.0, .zz = 1.0, .yz = 0.1}})
        EXPECT_EQ(feed.moveInSpace(1, {}, {}, wrong), fault);
    // turns about one axis alone, and a thin rod, whose moments differ by a million
    for (const InverseInertia& right : {InverseInertia{1.0, 4.0, 9.0, 2.0, 3.0, 6.0},
                                        InverseInertia{1e6, 1e6, 1e6, 1e6 - 1.0, 1e6 - 1.0, 1e6 - 1.0}})
        EXPECT_EQ(feed.moveInSpace(1, {}, {}, right), "");
    EXPECT_EQ(feed.movedInSpace(1, {}), "step: expected to be within one");
    EXPECT_EQ(feed.beginStep(stepNs, 0.0), "");
    EXPECT_EQ(feed.touch(at({}, {0.0F, 1.0F, 0.5F})), "normal: expected a length of 1");
    EXPECT_EQ(feed.touch(at({0.0F, 0.0F, nan}, {0.0F, 1.0F, 0.0F})), "point: expected numbers");
}

} // namespace physvib::contact_space_test
