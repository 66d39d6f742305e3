// SPDX-License-Identifier: MIT
// What a game may say of its cameras beyond three values: overtones, sounds of pairs, gain, a hand of its
// own, a budget.
#include "AttachedWorld.h"
#include "Contacts/EventMaker.h"
#include <stdexcept>

namespace physvib::sound_of_hits_test {

class SoundOfHits : public AttachedWorld {
protected:
    SoundOfHits() { give(floor(), object); }

    /// Events of a ball that strikes the floor, a camera.
    std::vector<CollisionEvent> hit(const HapticFixture& values) {
        b2Fixture& falling = ball(4.0F * static_cast<float>(++balls_), 0.26F, 0.0F, -5.0F);
        EXPECT_TRUE(attachment.set(falling, values));
        return run(1);
    }

private:
    int balls_ = 0;
};

TEST_F(SoundOfHits, OvertonesSoundWithTheFirstModeAtTheirShare) {
    HapticFixture bell = camera;
    bell.overtones = {{{500.0, 40.0, 0.5}, {750.0, 60.0, 0.25}}};
    const auto events = hit(bell);
    ASSERT_EQ(events.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(events[i].timeNs, events[0].timeNs);
        EXPECT_EQ(events[i].x, events[0].x);
        EXPECT_EQ(events[i].source, events[0].source);
        EXPECT_EQ(events[i].frequencyHz, 250.0 * static_cast<double>(i + 1));
        EXPECT_EQ(events[i].decayPerSecond, 20.0 * static_cast<double>(i + 1));
        EXPECT_EQ(events[i].amplitude, events[0].amplitude * (i == 0 ? 1.0 : 0.5 / static_cast<double>(i)));
    }
}

TEST_F(SoundOfHits, PairsHaveASoundOfTheirOwnInAnyOrder) {
    HapticFixture skate = camera, ice = object;
    skate.surface = 3;
    ice.surface = 7;
    skate.voice = Voice::both; // a pair's sound is one, whatever the voice
    give(edge({-100.0F, -2.0F}, {100.0F, -2.0F}), ice);
    EXPECT_EQ(
        attachment.setPair(
            7, 3,
            {.frequencyHz = 77.0, .decayPerSecond = 7.0, .overtones = {{{154.0, 9.0, 0.5}}}, .gain = 2.0}),
        "");
    give(ball(0.0F, -1.74F, 0.0F, -5.0F), skate);
    give(ball(-4.0F, 0.27F, 0.0F, -5.0F), camera); // on the floor in the same step, a little later
    const auto events = run(1);
    ASSERT_EQ(events.size(), 3U);
    EXPECT_EQ(events[0].frequencyHz, 77.0);
    EXPECT_EQ(events[0].decayPerSecond, 7.0);
    EXPECT_DOUBLE_EQ(events[0].amplitude,
                     2.0 * events[0].source.impulseNewtonSeconds / events[0].source.massKg);
    EXPECT_EQ(events[1].frequencyHz, 154.0);
    EXPECT_DOUBLE_EQ(events[2].amplitude, events[2].source.impulseNewtonSeconds / events[2].source.massKg);
    EXPECT_EQ(hit(skate).size(), 2U) << "the floor is of no kind: both voices";
}

TEST_F(SoundOfHits, RefusesSoundsThatCannotBePlayed) {
    EXPECT_NE(attachment.setPair(0, 1, {100.0, 10.0}), "");
    EXPECT_NE(attachment.setPair(1, 2, {-1.0, 10.0}), "");
    const b2Fixture& fixture = ball(0.0F, 3.0F, 0.0F, 0.0F);
    for (const HapticFixture& bad : {HapticFixture{.overtones = {{{1.0e6, 1.0, 1.0}}}},
                                     HapticFixture{.overtones = {{{100.0, 5000.0, 1.0}}}},
                                     HapticFixture{.overtones = {{{100.0, 10.0, -1.0}}}},
                                     HapticFixture{.gain = -1.0}, HapticFixture{.handMassKg = -1.0}})
        EXPECT_FALSE(attachment.set(fixture, bad));
}

TEST_F(SoundOfHits, GainOfACameraScalesAndMutesIt) {
    const double full = hit(camera).at(0).amplitude;
    HapticFixture half = camera, muted = camera;
    half.gain = 0.5;
    muted.gain = 0.0;
    EXPECT_NEAR(hit(half).at(0).amplitude, 0.5 * full, 1.0e-6);
    EXPECT_TRUE(hit(muted).empty());
}

TEST_F(SoundOfHits, CameraMayHaveAHandOfItsOwn) {
    HapticFixture held = camera;
    held.handMassKg = 3.0;
    const CollisionEvent event = hit(held).at(0);
    EXPECT_DOUBLE_EQ(event.amplitude, event.source.impulseNewtonSeconds / (event.source.massKg + 3.0));
}

TEST_F(SoundOfHits, MutedAttachmentIsSilentAndRightAtOnceWhenItIsNotAnyMore) {
    world.SetGravity({0.0F, -10.0F});
    ImpactSettings settings = unity();
    settings.isMuted = true;
    attachment.configure(settings);
    for (int i = 0; i < 3; ++i)
        give(ball(0.0F, 0.26F + 0.51F * static_cast<float>(i), 0.0F, -2.0F, 0.0F), camera);
    EXPECT_TRUE(run(100).empty());
    settings.isMuted = false;
    attachment.configure(settings);
    EXPECT_TRUE(run(100).empty()) << "what rests is a load that was known all along";
    EXPECT_FALSE(hit(camera).empty());
}

TEST_F(SoundOfHits, BudgetKeepsTheStrongestHitsOfAStep) {
    ImpactSettings settings = unity();
    settings.hitsPerStep = 3;
    attachment.configure(settings);
    for (int i = 0; i < 8; ++i)
        give(ball(static_cast<float>(i), 0.24F, 0.0F, -1.0F - static_cast<float>((5 * i) % 8)), camera);
    const auto events = run(1);
    ASSERT_EQ(events.size(), 3U);
    // m v (1 + e) of 6, 7 and 8 m/s
    for (const CollisionEvent& event : events) EXPECT_GT(event.amplitude, 1.5 * 5.9);
    EXPECT_EQ(attachment.overBudget(), 5U);
    EXPECT_EQ(attachment.drops(), 0U);
    settings.hitsPerStep = -1;
    EXPECT_THROW(attachment.configure(settings), std::invalid_argument);
}

// Whose sound a hit has, and where it is felt.

/// A ball falls on the right half of a floor that is 4 m long and a camera.
class EventMakerWorld : public AttachedWorld {
protected:
    std::vector<CollisionEvent> hit(Voice voice, const HapticFixture& other, double ownHz = 250.0) {
        give(edge({-1.0F, 0.0F}, {3.0F, 0.0F}), {ownHz, 20.0, true, 10.0, voice});
        b2Fixture& falling = ball(2.0F, 0.5F, 0.0F, -5.0F);
        if (other.frequencyHz > 0.0) give(falling, other);
        return run(20);
    }
};

struct VoicedHit {
    Voice voice;
    HapticFixture other;
    double ownHz;
    std::vector<std::pair<double, double>> sounds; ///< Hz, decay per second
};
class Voices : public EventMakerWorld, public testing::WithParamInterface<VoicedHit> {};

TEST_P(Voices, SayWhoseMaterialSounds) {
    const auto& [voice, other, ownHz, sounds] = GetParam();
    const auto events = hit(voice, other, ownHz);
    ASSERT_EQ(events.size(), sounds.size());
    for (std::size_t i = 0; i < events.size(); ++i) {
        EXPECT_EQ((std::pair{events[i].frequencyHz, events[i].decayPerSecond}), sounds[i]);
        EXPECT_EQ(events[i].source.fixture, 0);
        EXPECT_EQ(events[i].source.massKg, 10.0) << "the camera's: only the sound is the other's";
        EXPECT_EQ(events[i].amplitude, events[0].amplitude) << "each has all of it";
        EXPECT_GT(events[i].amplitude, 0.0);
        EXPECT_EQ(events[i].timeNs, events[0].timeNs);
        EXPECT_NEAR(events[i].x, 2.0, 1.0e-3) << "at the contact";
    }
}
constexpr std::pair ofCamera{250.0, 20.0}, ofObject{120.0, 30.0};
INSTANTIATE_TEST_SUITE_P(, Voices,
                         testing::Values(VoicedHit{Voice::own, object, 250.0, {ofCamera}},
                                         VoicedHit{Voice::other, object, 250.0, {ofObject}},
                                         VoicedHit{Voice::other, {}, 250.0, {ofCamera}},
                                         VoicedHit{Voice::both, object, 250.0, {ofCamera, ofObject}},
                                         VoicedHit{Voice::own, object, 0.0, {}},
                                         VoicedHit{Voice::both, object, 0.0, {ofObject}}));

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
    give(floor(), {250.0, 20.0, true, 0.0, Voice::own}); // m_i + m_h = 0 in Eq. 5.4
    give(ball(0.0F, 0.5F, 0.0F, -5.0F), object);
    EXPECT_TRUE(run(20).empty());
}

} // namespace physvib::sound_of_hits_test
