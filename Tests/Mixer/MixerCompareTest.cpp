// SPDX-License-Identifier: GPL-3.0-or-later
// Two laws, layouts or mixes are compared by one key, equally loud, and nothing is ever turned up.
#include "MixerTesting.h"
#include <cmath>

namespace physvib {
namespace {

using namespace test;

struct Compared {
    MixerModel model{onlyNoDevice(), noDevice, MixerModel::firstMix(), {.isPaused = true}};
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
        view.keyPressed(juce::KeyPress{'A', {}, 'a'});
        model.dispatchPendingMessages();
    }
    double db() const { return 10.0 * std::log10(energyOf(model.mix(), events)); }
    char shown() { return view.world().compare().isOn() ? view.world().compare().shown() : '-'; }
};

TEST(MixerCompare, OneKeyChangesBetweenTwoMixesAtMatchedLevels) {
    Compared c;
    const double before = c.db();
    c.key();
    EXPECT_EQ(c.shown(), 'B');
    EXPECT_EQ(c.db(), before) << "a copy of A";
    c.model.change("Law", [](Mix& mix) {
        mix.law = PanningLaw::energy;
        for (Strip& strip : mix.strips) strip.gainDb = 6.0;
        mix.layout = presetLayout("phone2", mix.layout.enchanters);
        mix.resizeStrips();
    });
    const double louder = c.db();
    ASSERT_GT(louder, before + 1.0);
    c.key();
    EXPECT_EQ(c.shown(), 'A');
    EXPECT_EQ(c.model.mix().count(), 4);
    EXPECT_EQ(c.db(), before) << "the quieter one is not turned up";
    c.key();
    EXPECT_EQ(c.model.mix().count(), 2);
    EXPECT_EQ(c.model.mix().law, PanningLaw::energy);
    EXPECT_NEAR(c.db(), before, 0.05) << "the louder one is turned down";
    EXPECT_NEAR(c.view.world().compare().loweredDb(), louder - before, 0.05);
    const auto* button = dynamic_cast<juce::Button*>(find(c.view, "Compare A and B"));
    EXPECT_EQ(button->getButtonText(), "B");
    c.key();
    c.key();
    EXPECT_NEAR(c.db(), before, 0.05) << "again and again";
    c.view.world().compare().end();
    EXPECT_EQ(c.shown(), '-');
    EXPECT_NEAR(c.db(), before, 0.05) << "the end makes nothing louder";
}

TEST(MixerCompare, ALevelThatIsSetMeanwhileIsMeant) {
    Compared c;
    c.key();
    c.model.change("Gains", [](Mix& mix) {
        for (Strip& strip : mix.strips) strip.gainDb = 6.0;
    });
    c.key();
    c.key(); // B, turned down by 6 dB
    c.model.change("Level", [](Mix& mix) { mix.levelDb = -40.0; });
    c.key();
    c.key();
    EXPECT_LE(c.model.mix().levelDb, -40.0);
}

TEST(MixerCompare, TheWorldStaysAndUndoEndsTheComparison) {
    Compared c;
    c.key();
    c.model.change("Exponent", [](Mix& mix) { mix.exponent = 2.0; });
    c.model.change("Seed", [](Mix& mix) { mix.seed = 7; });
    c.key();
    EXPECT_EQ(c.model.mix().seed, 7u);
    EXPECT_EQ(c.model.mix().exponent, 1.0);
    for (int k = 0; k < 4 && c.model.undoManager().canUndo(); ++k) c.model.undoManager().undo();
    EXPECT_FALSE(c.view.world().compare().isOn());
    EXPECT_EQ(c.model.mix().exponent, 1.0);
}

} // namespace
} // namespace physvib
