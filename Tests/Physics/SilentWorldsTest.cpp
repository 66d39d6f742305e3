// SPDX-License-Identifier: MIT
// Box2D worlds from which nothing is felt, each for one reason: the explanation names it.
#include "AttachedWorld.h"
#include "Core/PhantomPanner.h"
#include "Physics/Attachment.h"
#include "Support/Rendering.h"
#include <cmath>
#include <gtest/gtest.h>
#include <set>
#include <string>
#include <vector>

namespace physvib::silent_worlds_test {

class SilentBoxes : public AttachedWorld {
protected:
    /// A source that falls to the floor at 3 m/s; it stands for a step, and is struck after three.
    b2Fixture& source() {
        b2Fixture& made = ball(0.5F, 0.26F, 0.0F, -3.0F);
        EXPECT_TRUE(attachment.set(made, camera));
        floor();
        return made;
    }
    std::string after(int steps, const OutputFacts* output = nullptr) {
        (void)run(steps);
        return attachment.explain(output);
    }
    static void expect(const std::string& why, const std::string& said) {
        EXPECT_NE(why.find(said), std::string::npos) << why;
    }
};

TEST_F(SilentBoxes, NameTheBodiesState) {
    expect(attachment.explain(), "engine (beginStep and endStep)");
    b2Fixture& fixture = source();
    fixture.SetSensor(true);
    expect(after(3), "body 0 is a sensor");
    fixture.SetSensor(false);
    fixture.GetBody()->SetTransform({0.5F, 1.0F}, 0.0F);
    b2Filter none;
    none.maskBits = 0;
    fixture.SetFilterData(none);
    expect(after(3), "body 0 is filtered");
    fixture.SetFilterData({});
    fixture.GetBody()->SetEnabled(false);
    expect(after(3), "body 0 is disabled");
    fixture.GetBody()->SetEnabled(true);
    fixture.GetBody()->SetTransform({0.5F, 1.0F}, 0.0F);
    fixture.GetBody()->SetAwake(false);
    expect(after(3), "body 0 is asleep");
}

// Box2D's own filter says what may touch: a mask of either side, or a group.
TEST(SilentFilters, AreNamedExactlyWhereTheEngineLetsNoOtherTouchTheSource) {
    b2Filter deaf, second, notSecond, friends, foes;
    deaf.maskBits = 0;
    second.categoryBits = 2;
    notSecond.maskBits = 0xfffd;
    friends.maskBits = 0;
    friends.groupIndex = 1;
    foes.groupIndex = -1;
    const b2Filter filters[]{{}, deaf, second, notSecond, friends, foes};
    std::set<bool> seen;
    for (const b2Filter& own : filters)
        for (const b2Filter& first : filters)
            for (const b2Filter& last : filters) {
                b2World world{{0.0F, 0.0F}};
                Attachment attachment{world, unity()};
                b2Fixture &source = addTo(world, discOf(0.25F), {0.0F, 5.0F}),
                          &one = addStill(world, discOf(0.25F)), &other = addStill(world, discOf(0.5F));
                source.SetFilterData(own), one.SetFilterData(first), other.SetFilterData(last);
                EXPECT_TRUE(attachment.set(source, camera));
                attachment.step(0.01F);
                b2ContactFilter engine;
                const bool isFiltered =
                    !engine.ShouldCollide(&source, &one) && !engine.ShouldCollide(&source, &other);
                EXPECT_EQ(attachment.explain().find("is filtered") != std::string::npos, isFiltered)
                    << &own - filters << ' ' << &first - filters << ' ' << &last - filters;
                seen.insert(isFiltered);
            }
    EXPECT_EQ(seen.size(), 2U);
}

TEST_F(SilentBoxes, NameWhatTheStepsLack) {
    source().GetBody()->SetTransform({0.5F, 5.0F}, 0.0F);
    attachment.step(0.0F);
    expect(attachment.explain(), "Steps were 0 s long");
    attachment.step(16.7F);
    expect(attachment.explain(), "seconds, not milliseconds");
    expect(attachment.explain(), "Nothing was stepped since the last explanation; before: ");
}

TEST_F(SilentBoxes, NameWhatTheImpactsLack) {
    b2Fixture& fixture = source();
    HapticFixture values = camera;
    const auto fall = [&](float speed) {
        EXPECT_TRUE(attachment.set(fixture, values));
        fixture.GetBody()->SetTransform({0.5F, 1.0F}, 0.0F);
        (void)run(2);
        fixture.GetBody()->SetTransform({0.5F, 0.251F}, 0.0F);
        fixture.GetBody()->SetLinearVelocity({0.0F, -speed});
        return after(3);
    };
    values.isCamera = false;
    expect(fall(3.0F), "set isCamera");
    values = camera;
    expect(fall(0.05F), "slower than the threshold of 0.15 m/s");
    values.gain = 0.0;
    expect(fall(3.0F), "gain of 0");
    values = camera;
    values.frequencyHz = values.decayPerSecond = 0.0;
    expect(fall(3.0F), "set frequencyHz and decayPerSecond");
    values = camera;
    ImpactSettings muted = unity();
    muted.isMuted = true;
    attachment.configure(muted);
    expect(fall(3.0F), "set isMuted");
    attachment.configure(unity());
    expect(fall(3.0F), "event was made, at x 0.5");
}

TEST_F(SilentBoxes, NameAMovableSourceBetweenOthers) {
    world.SetGravity({0.0F, -9.81F});
    floor();
    EXPECT_TRUE(attachment.set(box(0.0F, 0.0F, 0.0F), camera));
    (void)ball(0.0F, 0.8F, 0.0F, 0.0F); // comes to rest on it
    EXPECT_FALSE(run(100).empty());
    (void)attachment.explain();
    (void)ball(0.0F, 1.4F, 0.0F, -3.0F);
    expect(after(20), "push and reaction cancel");
}

TEST_F(SilentBoxes, NameTheOutput) {
    source();
    ActuatorLayout layout;
    layout.extentWidthMetres = 0.12;
    layout.extentHeightMetres = 0.06;
    layout.count = 2;
    layout.places[1] = {0.12, 0.06};
    PhantomPanner panner{layout, PanningLaw::linear, 1.0, 0.12, 0.06};
    OutputFacts output;
    output.panner = &panner;
    expect(after(3, &output), "set fieldWidthMetres and fieldHeightMetres of the renderer");
    panner = {layout, PanningLaw::linear, 1.0, 1.0, 1.0};
    output.mutedChannels = 3;
    EXPECT_EQ(attachment.explain(&output).find("Nothing was stepped since"), 0U);
    expect(attachment.explain(&output), "channels that play these places are muted");
    output.mutedChannels = 0;
    output.withoutPart = 3;
    expect(attachment.explain(&output), "3 events belong to a part of the body that no actuator is on");
    output.levelGain = 0.0;
    expect(attachment.explain(&output), "level of the output is 0");
}

// Worlds as a newcomer makes them, with the automatic full-scale impulse: none clips and none whispers.

constexpr HapticFixture felt{.frequencyHz = 200.0, .decayPerSecond = 30.0, .isCamera = true};

/// The peak of the samples, without a limiter, of 4 actuators at the corners of the field.
double peakOf(const std::vector<CollisionEvent>& events, double width, double height, double seconds) {
    ActuatorLayout layout;
    layoutPreset("phone4", layout);
    RendererSettings settings;
    settings.limiterEnabled = false;
    settings.channels = 4;
    settings.panner = {layout, PanningLaw::linear, 1.0, width, height};
    float peak = 0.0F;
    const auto frames = static_cast<int>(std::lround(seconds * settings.sampleRateHz));
    for (const auto& channel : test::renderEvents(events, settings, frames).channels)
        for (const float sample : channel) peak = std::max(peak, std::abs(sample));
    return static_cast<double>(peak);
}

/// A walled field that is `width` by `height`.
struct Room {
    Room(float w, float h, float gravity, double fullScaleNewtonSeconds)
        : width{w}
        , height{h}
        , world{{0.0F, gravity}}
        , haptics{world, {.fieldWidthMetres = w, .fullScaleNewtonSeconds = fullScaleNewtonSeconds}} {
        b2BodyDef def;
        b2Body* const walls = world.CreateBody(&def);
        const b2Vec2 corners[] = {{0.0F, 0.0F}, {w, 0.0F}, {w, h}, {0.0F, h}};
        for (int i = 0; i < 4; ++i) {
            b2EdgeShape edge;
            edge.SetTwoSided(corners[i], corners[(i + 1) % 4]);
            walls->CreateFixture(&edge, 0.0F)->SetRestitution(0.3F);
        }
    }
    b2Body& add(float x, float y, const b2Shape& shape, float restitution, double massKg) {
        b2MassData unit;
        shape.ComputeMass(&unit, 1.0F);
        b2Fixture& fixture =
            addTo(world, shape, {x, y}, {0.0F, 0.0F}, static_cast<float>(massKg) / unit.mass);
        fixture.GetBody()->SetBullet(true);
        fixture.SetRestitution(restitution);
        EXPECT_TRUE(haptics.set(fixture, felt));
        return *fixture.GetBody();
    }
    template <class Act>
    double peak(double seconds, int stepsPerSecond, Act act) {
        std::vector<CollisionEvent> events;
        for (int i = 0; i < std::lround(seconds * stepsPerSecond); ++i) {
            act(i);
            haptics.step(1.0F / static_cast<float>(stepsPerSecond));
        }
        haptics.take(events);
        EXPECT_GT(events.size(), 3U);
        return peakOf(events, static_cast<double>(width), static_cast<double>(height), seconds);
    }
    float width, height;
    b2World world;
    Attachment haptics;
};

double ball(double massKg, double full) {
    Room room{1.0F, 1.0F, -9.81F, full};
    room.add(0.3F, 0.85F, discOf(0.05F), 0.6F, massKg);
    return room.peak(3.0, 100, [](int) {});
}

double heap(double massKg, double full) {
    Room room{8.0F, 6.0F, -9.81F, full};
    b2PolygonShape box;
    box.SetAsBox(0.25F, 0.25F);
    for (int i = 0; i < 40; ++i)
        room.add(2.0F + 0.37F * static_cast<float>(i % 11), 0.5F + 0.13F * static_cast<float>(i), box, 0.3F,
                 massKg);
    return room.peak(5.0, 100, [](int) {});
}

double pinball(double massKg, double full) {
    Room room{0.5F, 1.0F, -1.2F, full};
    b2Body& thrown = room.add(0.25F, 0.5F, discOf(0.0135F), 0.5F, massKg);
    return room.peak(10.0, 240, [&thrown](int i) {
        const auto turn = static_cast<float>(i);
        if (i % 120 == 0)
            thrown.SetLinearVelocity({3.0F * std::cos(turn), 3.0F + 5.0F * std::abs(std::sin(turn))});
    });
}

TEST(FirstWorlds, NeitherClipNorWhisperWhateverTheirMasses) {
    for (const double massKg : {0.01, 0.1, 1.0, 10.0})
        for (double (*const world)(double, double) : {ball, heap, pinball}) {
            const double peak = world(massKg, ImpactSettings::automatic);
            EXPECT_LT(peak, 1.0) << massKg;
            EXPECT_GT(peak, 0.2) << massKg;
        }
    EXPECT_GT(pinball(0.1, 0.0), 2.0); // what they would do without it
}

} // namespace physvib::silent_worlds_test
