// SPDX-License-Identifier: MIT
// Whose sound a hit has, and where it is felt.
#include "Contacts/EventMaker.h"
#include "AttachedWorld.h"

namespace physvib {
namespace {

/// A ball falls on the right half of a floor that is 4 m long and a camera.
class EventMakerWorld : public AttachedWorld {
protected:
    std::vector<CollisionEvent> hit(Voice voice, const HapticFixture& other, double ownHz = 250.0) {
        (void)attachment.set(edge({-1.0F, 0.0F}, {3.0F, 0.0F}), {ownHz, 20.0, true, 10.0, voice});
        b2Fixture& falling = ball(2.0F, 0.5F, 0.0F, -5.0F);
        if (other.frequencyHz > 0.0) (void)attachment.set(falling, other);
        return run(20);
    }
};

TEST_F(EventMakerWorld, OwnVoiceIsTheCamerasMaterial) {
    const auto events = hit(Voice::own, object);
    ASSERT_EQ(events.size(), 1U);
    EXPECT_EQ(events[0].frequencyHz, 250.0);
    EXPECT_EQ(events[0].decayPerSecond, 20.0);
}

TEST_F(EventMakerWorld, OtherVoiceIsTheMaterialOfWhatStruck) {
    const auto events = hit(Voice::other, object);
    ASSERT_EQ(events.size(), 1U);
    EXPECT_EQ(events[0].frequencyHz, object.frequencyHz);
    EXPECT_EQ(events[0].decayPerSecond, object.decayPerSecond);
    EXPECT_EQ(events[0].source.fixture, 0);
    EXPECT_EQ(events[0].source.massKg, 10.0); // the camera's: only the sound is the other's
}

TEST_F(EventMakerWorld, OtherVoiceWithoutASoundIsOwn) {
    const auto events = hit(Voice::other, {});
    ASSERT_EQ(events.size(), 1U);
    EXPECT_EQ(events[0].frequencyHz, 250.0);
}

TEST_F(EventMakerWorld, BothVoicesSoundWithTheFullAmplitudeEach) {
    const auto events = hit(Voice::both, object);
    ASSERT_EQ(events.size(), 2U);
    EXPECT_EQ(events[0].frequencyHz, 250.0);
    EXPECT_EQ(events[1].frequencyHz, object.frequencyHz);
    EXPECT_EQ(events[0].amplitude, events[1].amplitude);
    EXPECT_EQ(events[0].timeNs, events[1].timeNs);
    EXPECT_GT(events[0].amplitude, 0.0);
}

TEST_F(EventMakerWorld, NothingSoundsWithoutAnyFrequency) {
    EXPECT_TRUE(hit(Voice::own, object, 0.0).empty());
}

TEST_F(EventMakerWorld, OtherVoiceNeedsNoFrequencyOfTheCameras) {
    EXPECT_EQ(hit(Voice::both, object, 0.0).size(), 1U);
}

TEST_F(EventMakerWorld, IsFeltAtTheContact) {
    const auto events = hit(Voice::own, object);
    ASSERT_EQ(events.size(), 1U);
    EXPECT_NEAR(events[0].x, 2.0, 1.0e-3);
}

TEST_F(EventMakerWorld, IsFeltAtTheCentreOfTheCamerasFixtureOnDemand) {
    ImpactSettings settings = unity();
    settings.location = ImpactLocation::fixture;
    attachment.configure(settings);
    const auto events = hit(Voice::own, object);
    ASSERT_EQ(events.size(), 1U);
    EXPECT_NEAR(events[0].x, 1.0, 1.0e-6);
    EXPECT_NEAR(events[0].y, 0.0, 1.0e-6);
}

TEST_F(EventMakerWorld, CameraWithoutAnyMassIsSilent) {
    (void)attachment.set(floor(), {250.0, 20.0, true, 0.0, Voice::own}); // m_i + m_h = 0 in Eq. 5.4
    (void)attachment.set(ball(0.0F, 0.5F, 0.0F, -5.0F), object);
    EXPECT_TRUE(run(20).empty());
}

} // namespace
} // namespace physvib
