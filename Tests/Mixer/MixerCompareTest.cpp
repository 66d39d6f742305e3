// SPDX-License-Identifier: GPL-3.0-or-later
// Two laws, layouts or mixes are compared by one key, equally loud, and nothing is ever turned up.
#include "Host/FakeAudioDevice.h"
#include "Mixer/Model/MixerDevice.h"
#include "MixerTesting.h"
#include "Session/FakeHost.h"
#include "Stimuli/SeededRandom.h"
#include <cmath>
#include <set>

namespace physvib::mixer_compare_test {

using namespace test;

struct Compared : testing::Test {
    MixerModel model{onlyNoDevice(), noDevice, MixerModel::defaultMix(), {.isPaused = true}};
    MixerView view{model};
    std::vector<CollisionEvent> events;

    Compared() {
        for (const double x : {0.1, 0.3, 0.5, 0.7, 0.9}) // as long as nothing was played
            for (const double y : {0.2, 0.5, 0.8}) {
                CollisionEvent e;
                e.x = x * model.world().scene().fieldWidthMetres;
                e.y = y * model.world().scene().fieldHeightMetres;
                e.amplitude = 1.0;
                events.push_back(e);
            }
    }
    void key() {
        view.keyPressed(KeyPress{'A', {}, 'a'});
        model.dispatchPendingMessages();
    }
    double db() const { return 10.0 * std::log10(contactEnergyG2(model.mix(), events)); }
    char shown() { return view.world().compare().isComparing() ? view.world().compare().activeState() : '-'; }
};

TEST_F(Compared, OneKeyChangesBetweenTwoMixesAtMatchedLevels) {
    const double before = db();
    key();
    EXPECT_EQ(shown(), 'B');
    EXPECT_EQ(db(), before) << "a copy of A";
    model.change("Law", [](Mix& mix) {
        mix.law = PanningLaw::energy;
        for (Strip& strip : mix.strips) strip.gainDb = 6.0;
        mix.layout = presetLayout("phone2", mix.layout.actuators);
        mix.resizeStrips();
    });
    const double louder = db();
    ASSERT_GT(louder, before + 1.0);
    key();
    EXPECT_EQ(shown(), 'A');
    EXPECT_EQ(model.mix().count(), 4);
    EXPECT_EQ(db(), before) << "the quieter one is not turned up";
    key();
    EXPECT_EQ(model.mix().count(), 2);
    EXPECT_EQ(model.mix().law, PanningLaw::energy);
    EXPECT_NEAR(db(), before, 0.05) << "the louder one is turned down";
    EXPECT_NEAR(view.world().compare().loweredDb(), louder - before, 0.05);
    const auto& button = the<juce::Button>(view, "Compare A and B");
    EXPECT_EQ(button.getButtonText(), "B");
    key();
    key();
    EXPECT_NEAR(db(), before, 0.05) << "again and again";
    view.world().compare().end();
    EXPECT_EQ(shown(), '-');
    EXPECT_NEAR(db(), before, 0.05) << "the end makes nothing louder";
}

TEST_F(Compared, ALevelThatIsSetMeanwhileIsMeant) {
    key();
    model.change("Gains", [](Mix& mix) {
        for (Strip& strip : mix.strips) strip.gainDb = 6.0;
    });
    key();
    key(); // B, turned down by 6 dB
    model.change("Level", [](Mix& mix) { mix.levelDb = -40.0; });
    key();
    key();
    EXPECT_LE(model.mix().levelDb, -40.0);
}

TEST_F(Compared, TheWorldStaysAndUndoEndsTheComparison) {
    key();
    model.change("Exponent", [](Mix& mix) { mix.exponent = 2.0; });
    model.change("Seed", [](Mix& mix) { mix.seed = 7; });
    key();
    EXPECT_EQ(model.mix().seed, 7u);
    EXPECT_EQ(model.mix().exponent, 1.0);
    for (int k = 0; k < 4 && model.undoManager().canUndo(); ++k) model.undoManager().undo();
    EXPECT_FALSE(view.world().compare().isComparing());
    EXPECT_EQ(model.mix().exponent, 1.0);
}

// A comparison leaves no level lowered, whichever side was the louder one and however often it is changed;
// new strips get no output of ears or meters; and a dose that was felt stays what it was when the layout's
// full scales change.

TEST(MatchedLevels, BothSidesHaveTheirOwnAgainWhenTheyAreAlike) {
    MixerModel desk{onlyNoDevice(), noDevice, MixerModel::defaultMix(), {.isPaused = true}};
    MixerView view{desk};
    const auto key = [&] {
        view.keyPressed(KeyPress{'A', {}, 'a'});
        desk.dispatchPendingMessages();
    };
    const auto gains = [&](double db) {
        desk.change("Gains", [db](Mix& mix) {
            for (Strip& strip : mix.strips) strip.gainDb = db;
        });
    };
    gains(0.0);
    const double level = desk.mix().levelDb;
    key(); // B, a copy
    for (const double other : {-12.0, -3.0, -20.0}) {
        gains(other); // B is quieter
        for (int times = 0; times < 3; ++times) {
            key(); // A, turned down to be as loud as B
            EXPECT_NEAR(desk.mix().levelDb, level + other, 0.05) << other;
            key();
            EXPECT_NEAR(desk.mix().levelDb, level, 0.05) << other << ": B was never turned down";
        }
        gains(0.0); // as loud as A again
        key();
        EXPECT_NEAR(desk.mix().levelDb, level, 0.05) << "after " << other;
        key();
    }
}

TEST(NewStrips, GetNoOutputOfEarsOrMeters) {
    SeededRandom random{115};
    int without = 0;
    for (int round = 0; round < 5000; ++round) {
        DeviceChoice choice;
        choice.isHeadphones = random.chance(0.2);
        for (std::size_t n = random.below(3); n > 0; --n)
            choice.monitorOutputs.push_back(static_cast<int>(random.below(12)));
        choice.markerOutput = static_cast<int>(random.below(12)) - 1;
        std::vector<Strip> strips(1 + random.below(8));
        int last = 0;
        for (Strip& strip : strips) strip.output = random.chance(0.2) ? -1 : last++;
        const auto before = strips;
        const std::size_t first = random.below(strips.size());
        const auto told = assignNewStrips(choice, strips, first);
        std::set<int> used;
        for (std::size_t j = 0; j < strips.size(); ++j) {
            const int output = strips[j].output;
            ASSERT_TRUE(j >= first || output == before[j].output);
            if (output < 0) continue;
            ASSERT_TRUE(used.insert(output).second) << "round " << round;
            if (j < first) continue;
            ASSERT_NE(output, choice.markerOutput) << "round " << round << ": pulses at full scale";
            ASSERT_EQ(std::ranges::count(choice.monitorOutputs, output), 0) << "round " << round;
            ASSERT_TRUE(!choice.isHeadphones || output < 2);
        }
        for (const std::size_t j : told) ASSERT_EQ(strips[j].output, -1);
        without += !told.empty();
    }
    EXPECT_GT(without, 10);
}

/// What was felt counts with the full scales of its time.
TEST(Doses, OfBeforeKeepTheFullScalesOfBefore) {
    SessionSetup setup = shakeTheBoxSetup(0.05);
    Session session{setup};
    FakeInterface hands;
    AudioOutput output{session, fakeDrivers({&hands})};
    ASSERT_EQ(output.open({"hands", {}, 0, 0, 1.0f}), "");
    LayoutDescription layout = presetLayout("phone4");
    const auto withScale = [&](double fullScaleG) {
        for (ActuatorDescription& enchanter : layout.actuators) enchanter.fullScaleG = fullScaleG;
        return layout;
    };
    MixerExposure updated{output}, forgetful{output}, ofOne{output};
    for (MixerExposure* exposure : {&updated, &forgetful, &ofOne}) exposure->setLayout(withScale(1.0));
    const auto play = [&] {
        for (int k = 0; k < 1500; ++k) { // two seconds
            if (k % 4 == 0) session.advance();
            hands.play(64);
        }
    };
    play();
    updated.update();
    const double before = updated.squareGSeconds();
    EXPECT_GT(before, 0.0);
    for (MixerExposure* exposure : {&updated, &forgetful}) exposure->setLayout(withScale(4.0));
    EXPECT_DOUBLE_EQ(forgetful.squareGSeconds(), before);
    play();
    for (MixerExposure* exposure : {&updated, &forgetful, &ofOne}) exposure->update();
    EXPECT_GT(updated.squareGSeconds(), before);
    const double more = ofOne.squareGSeconds() - before;
    EXPECT_NEAR((updated.squareGSeconds() - before) / more, 16.0, 1e-9) << "in g: 4 squared";
    EXPECT_DOUBLE_EQ(forgetful.squareGSeconds(), updated.squareGSeconds());
}

} // namespace physvib::mixer_compare_test
