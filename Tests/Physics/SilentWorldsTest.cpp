// SPDX-License-Identifier: MIT
// Box2D worlds from which nothing is felt, each for one reason: the explanation names it.
#include "AttachedWorld.h"
#include "Core/PhantomPanner.h"
#include <string>

namespace physvib {
namespace {

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
    EnchanterLayout layout;
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

} // namespace
} // namespace physvib
