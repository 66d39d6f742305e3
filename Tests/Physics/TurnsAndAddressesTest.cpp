// SPDX-License-Identifier: MIT
// Grains that pass are how much two surfaces turn against each other, whichever of them turns and which way;
// a load that falls gives no more than it did; and what takes a destroyed body's address or slot has nothing
// of it.
#include "AttachedWorld.h"
#include "Support/Sanitizers.h"
#include <algorithm>
#include <string>
#include <utility>

namespace physvib::turns_and_addresses_test {

constexpr double spacing = 0.002;

HapticFixture ridged() {
    HapticFixture values = camera;
    values.texture.grainMetres = spacing;
    values.texture.pattern = GrainPattern::regular;
    return values;
}

class Turns : public AttachedWorld {
protected:
    Turns() { world.SetAllowSleeping(false); }
    b2Fixture& disc(float radius, b2Vec2 at, b2BodyType type) {
        b2BodyDef def;
        def.type = type;
        def.position = at;
        b2CircleShape circle;
        circle.m_radius = radius;
        b2Fixture& fixture = *world.CreateBody(&def)->CreateFixture(&circle, 10.0F);
        fixture.SetFriction(0.0F);
        return fixture;
    }
    /// A vector of the start, turned by that angle.
    static b2Vec2 turned(b2Vec2 v, float angle) { return b2Mul(b2Rot(angle), v); }

    /// Grains of 50 steps in which `upper` goes round the origin with `turn` (rad/s), pressed against what is
    /// there, turns by itself with `ownTurn`, and what is there with `lowerTurn`. They touch so far from the
    /// origin, on the line to `upper`, and each grain is felt there.
    double grainsOf(b2Body& upper, b2Vec2 start, float turn, float ownTurn, b2Body& lower, float lowerTurn,
                    float touchesAt) {
        std::vector<CollisionEvent> events;
        const std::int64_t began = attachment.timeNs();
        const double near = touchesAt > 0.0F ? 0.003 : 0.002; // what goes round is half a step behind
        for (int i = 0; i < 51; ++i) {
            const float angle = turn * 0.01F * static_cast<float>(i);
            const b2Vec2 at = turned(start, angle);
            upper.SetTransform(at, ownTurn * 0.01F * static_cast<float>(i));
            upper.SetLinearVelocity(b2Cross(turn, at));
            upper.SetAngularVelocity(ownTurn);
            lower.SetTransform(lower.GetPosition(), lowerTurn * 0.01F * static_cast<float>(i));
            lower.SetAngularVelocity(lowerTurn);
            world.SetGravity(-10.0F / at.Length() * at);
            attachment.step(0.01F);
        }
        attachment.flush(events);
        std::erase_if(events, [](const CollisionEvent& e) { return e.source.kind == ContactKind::hit; });
        for (const CollisionEvent& e : events) {
            const double t = seconds(e) - static_cast<double>(began) * 1.0e-9;
            const b2Vec2 at = turned({0.0F, touchesAt}, turn * static_cast<float>(t));
            EXPECT_NEAR(e.x, static_cast<double>(at.x), near) << t;
            EXPECT_NEAR(e.y, static_cast<double>(at.y), near) << t;
        }
        return static_cast<double>(events.size());
    }
};

/// On a face that turns about the point where the disc stands: r |own turn - turn of the face|.
TEST_F(Turns, ADiscPassesItsGrainsAsItTurnsAgainstAFace) {
    for (const float face : {-1.0F, 0.0F, 1.0F})
        for (const float own : {-2.0F, -1.0F, 0.0F, 1.0F, 2.0F}) {
            b2BodyDef def;
            def.type = b2_kinematicBody;
            b2EdgeShape shape;
            shape.SetTwoSided({-5.0F, 0.0F}, {5.0F, 0.0F});
            shape.m_radius = 0.0F;
            b2Fixture& floor = *world.CreateBody(&def)->CreateFixture(&shape, 0.0F);
            b2Fixture& stands = give(disc(0.25F, {0.0F, 0.25F}, b2_dynamicBody), ridged());
            const double grains =
                grainsOf(*stands.GetBody(), {0.0F, 0.25F}, face, own, *floor.GetBody(), face, 0.0F);
            const double expected = 0.25 * std::abs(static_cast<double>(own - face)) * 0.5 / spacing;
            EXPECT_NEAR(grains, expected, 2.0 + 0.04 * expected) << "face " << face << ", disc " << own;
            world.DestroyBody(stands.GetBody());
            world.DestroyBody(floor.GetBody());
        }
}

/// Round another disc: each passes r |its turn - turn of the line between the centres|.
TEST_F(Turns, TwoDiscsPassTheirGrainsEachByItsOwnTurn) {
    for (const bool isUpperRough : {true, false})
        for (const float line : {-1.0F, 0.0F, 1.0F})
            for (const float own : {-1.5F, -1.0F, 0.0F, 1.0F, 1.5F}) {
                b2Fixture& lower = disc(0.5F, {0.0F, 0.0F}, b2_kinematicBody);
                b2Fixture& upper = disc(0.25F, {0.0F, 0.749F}, b2_dynamicBody);
                give(isUpperRough ? upper : lower, ridged());
                const double grains =
                    isUpperRough
                        ? grainsOf(*upper.GetBody(), {0.0F, 0.749F}, line, own, *lower.GetBody(), 0.3F, 0.5F)
                        : grainsOf(*upper.GetBody(), {0.0F, 0.749F}, line, 0.3F, *lower.GetBody(), own, 0.5F);
                const double radius = isUpperRough ? 0.25 : 0.5;
                const double expected = radius * std::abs(static_cast<double>(own - line)) * 0.5 / spacing;
                EXPECT_NEAR(grains, expected, 2.0 + 0.04 * expected)
                    << (isUpperRough ? "upper" : "lower") << " turns " << own << ", line " << line;
                world.DestroyBody(upper.GetBody());
                world.DestroyBody(lower.GetBody());
            }
}

class Loads : public AttachedWorld {
protected:
    /// Amplitudes of the grains under a ball that slides, of the steps before and after gravity changes.
    std::pair<double, double> strongest(float before, float after) {
        b2Fixture& plane = floor();
        plane.SetFriction(0.0F);
        give(plane, ridged());
        b2Fixture& slides = ball(0.0F, 0.25F, 0.5F, 0.0F, 0.0F);
        world.SetGravity({0.0F, -before});
        run(10);
        double first = 0.0, second = 0.0;
        for (const CollisionEvent& e : run(10)) first = std::max(first, e.amplitude);
        std::vector<CollisionEvent> events;
        attachment.flush(events); // of before
        world.SetGravity({0.0F, -after});
        for (const CollisionEvent& e : run(8)) second = std::max(second, e.amplitude);
        attachment.remove(plane);
        world.DestroyBody(slides.GetBody());
        world.DestroyBody(plane.GetBody());
        return {first, second};
    }
};

TEST_F(Loads, GrainsAreAtMostAsStrongAsTheLoadWhenItFallsOrRises) {
    for (const float least : {1.0F, 2.0F, 9.0F}) {
        const auto [heavy, falling] = strongest(10.0F, least);
        const auto [light, rising] = strongest(least, 10.0F);
        ASSERT_GT(heavy, light);
        ASSERT_GT(light, 0.0);
        EXPECT_NEAR(falling, light, 0.01 * light) << least; // the step of the change itself included
        EXPECT_NEAR(rising, heavy, 0.01 * heavy) << least;
    }
}

#if defined(PHYSVIB_ADDRESS_SANITIZER) // keeps what was freed, to find who uses it
constexpr bool isReused = false;
#else
constexpr bool isReused = true;
#endif

/// A fixture that nobody said goodbye to: what comes to its address on another body is as unknown as any.
TEST_F(AttachedWorld, AnAddressThatIsUsedAgainHasNoSoundOfBefore) {
    world.SetGravity({0.0F, -10.0F});
    for (int round = 0; round < 3; ++round) {
        b2Fixture& plane = floor();
        b2Fixture* const first = &ball(0.0F, 9.0F, 0.0F, 0.0F);
        b2Body& body = *first->GetBody();
        const std::int32_t id = attachment.set(*first, camera).id;
        run(2);
        body.DestroyFixture(first);
        b2Fixture& heir = ball(5.0F, 0.4F, 0.0F, -1.0F);
        if (isReused) ASSERT_EQ(&heir, first) << "of this test: the address is used again";
        EXPECT_EQ(attachment.find(heir), nullptr);
        const std::vector<CollisionEvent> events = run(80);
        EXPECT_TRUE(events.empty()) << events.size();
        EXPECT_NE(attachment.set(heir, camera).id, id);
        heir.GetBody()->SetTransform({5.0F, 0.4F}, 0.0F);
        heir.GetBody()->SetLinearVelocity({0.0F, -1.0F});
        EXPECT_FALSE(run(80).empty());
        world.DestroyBody(heir.GetBody());
        world.DestroyBody(plane.GetBody());
        world.DestroyBody(&body);
        run(2);
    }
}

/// A partner that goes while its hit is pending, and another that takes its slot at once: the hit is of
/// nobody, or of the one that was, and sounds as it did.
class Slots : public testing::TestWithParam<std::tuple<ImpactTiming, Voice>> {
protected:
    struct Result {
        std::vector<CollisionEvent> events;
        std::int32_t partner = -1, heir = -1;
        std::int64_t goneNs = 0; ///< when the partner went
    };
    /// A ball strikes a row of `between` others, at whose end is a camera; then the camera's neighbour goes.
    static Result hit(int between, bool isTakenAgain) {
        b2World world{{0.0F, 0.0F}};
        ImpactSettings settings = unity();
        settings.timing = std::get<0>(GetParam());
        Attachment attachment{world, settings};
        const auto add = [&](float x, float y, float speed) -> b2Fixture& {
            return addTo(world, discOf(0.25F), {x, y}, {speed, 0.0F});
        };
        HapticFixture felt = camera;
        felt.voice = std::get<1>(GetParam());
        (void)attachment.set(add(0.0F, 0.0F, 0.0F), felt);
        Result result;
        b2Fixture* neighbour = nullptr;
        for (int i = 1; i <= between; ++i) {
            b2Fixture& lies = add(0.499F * static_cast<float>(i), 0.0F, 0.0F);
            const std::int32_t id = attachment.set(lies, object).id;
            if (i == 1) neighbour = &lies, result.partner = id;
        }
        b2Fixture& strikes = add(0.499F * static_cast<float>(between) + 0.6F, 0.0F, -2.0F);
        const std::int32_t striking = attachment.set(strikes, object).id;
        if (neighbour == nullptr) neighbour = &strikes, result.partner = striking;
        const auto touches = [&] {
            for (const b2ContactEdge* c = strikes.GetBody()->GetContactList(); c != nullptr; c = c->next)
                if (c->contact->IsTouching()) return true;
            return false;
        };
        for (int i = 0; i < 100 && !touches(); ++i) attachment.step(0.01F);
        EXPECT_TRUE(touches());
        attachment.step(0.01F);
        result.goneNs = attachment.timeNs();
        world.DestroyBody(neighbour->GetBody());
        if (isTakenAgain) {
            HapticFixture other = object;
            other.frequencyHz = 444.0;
            other.decayPerSecond = 44.0;
            b2Fixture& heir = add(5.0F, 50.0F, 0.0F);
            result.heir = attachment.set(heir, other).id;
        }
        for (int i = 0; i < 10; ++i) attachment.step(0.01F);
        attachment.flush(result.events);
        return result;
    }
};

TEST_P(Slots, AHitIsNotOfWhoTookItsPartnersPlace) {
    for (const int between : {0, 1, 2, 3}) {
        const Result alone = hit(between, false), taken = hit(between, true);
        ASSERT_FALSE(alone.events.empty()) << between;
        ASSERT_EQ(taken.events.size(), alone.events.size()) << between;
        for (std::size_t i = 0; i < alone.events.size(); ++i) {
            EXPECT_NE(taken.events[i].source.other, taken.heir) << between;
            EXPECT_LE(taken.events[i].timeNs, taken.goneNs) << between << ": it waits for nobody";
            EXPECT_EQ(taken.events[i].frequencyHz, alone.events[i].frequencyHz) << between;
            EXPECT_EQ(taken.events[i].decayPerSecond, alone.events[i].decayPerSecond) << between;
            EXPECT_EQ(taken.events[i].amplitude, alone.events[i].amplitude) << between;
        }
    }
}
INSTANTIATE_TEST_SUITE_P(Timings, Slots,
                         testing::Combine(testing::Values(ImpactTiming::onset, ImpactTiming::release),
                                          testing::Values(Voice::own, Voice::other, Voice::both)));

} // namespace physvib::turns_and_addresses_test
