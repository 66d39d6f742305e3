// SPDX-License-Identifier: GPL-3.0-or-later
// Badges of actuators can be read and pressed, however many there are and wherever they are.
#include "Host/Views/WorldPictures.h"
#include "MixerTesting.h"
#include "Stimuli/SeededRandom.h"
#include <cmath>

namespace physvib {
namespace {

using namespace test;
using Places = std::vector<juce::Point<float>>;

const juce::Rectangle<float> room{4.0f, 4.0f, 560.0f, 300.0f};

void expectApart(const std::vector<juce::Rectangle<float>>& badges, juce::Rectangle<float> in,
                 const std::string& what) {
    for (std::size_t i = 0; i < badges.size(); ++i) {
        EXPECT_TRUE(in.expanded(0.01f).contains(badges[i])) << what << ": " << i;
        EXPECT_GE(badges[i].getHeight(), lowestBadge) << what;
        for (std::size_t k = 0; k < i; ++k)
            EXPECT_FALSE(badges[i].reduced(0.5f).intersects(badges[k])) << what << ": " << k << ", " << i;
    }
}

Places grid(int count, juce::Rectangle<float> field) {
    const int columns = static_cast<int>(std::ceil(std::sqrt(2.0 * count))),
              rows = (count + columns - 1) / std::max(1, columns);
    Places places;
    for (int j = 0; j < count; ++j)
        places.push_back(
            field.getRelativePoint((static_cast<float>(j % columns) + 0.5f) / static_cast<float>(columns),
                                   (static_cast<float>(j / columns) + 0.5f) / static_cast<float>(rows)));
    return places;
}

TEST(Badges, DoNotOverlapWhateverTheyAreNamed) {
    for (const int count : {0, 1, 4, 16, 64})
        for (const float words : {12.0f, 25.0f, 300.0f}) {
            const std::vector<float> widths(static_cast<std::size_t>(count), words);
            expectApart(badgesAround(grid(count, room.reduced(60.0f, 40.0f)), widths, room), room,
                        std::to_string(count) + " of " + std::to_string(words));
        }
}

TEST(Badges, OfOnePlaceLieBesideEachOther) {
    const Places places(64, room.getCentre());
    expectApart(badgesAround(places, std::vector<float>(64, 25.0f), room), room, "in the middle");
    expectApart(badgesAround(Places(16, room.getTopLeft()), std::vector<float>(16, 200.0f), room), room,
                "in a corner");
    SeededRandom random{59};
    for (int k = 0; k < 20; ++k) {
        Places any;
        std::vector<float> widths;
        for (int j = 0; j < 24; ++j) {
            any.push_back(room.getRelativePoint(static_cast<float>(random.below(100)) / 99.0f,
                                                static_cast<float>(random.below(100)) / 99.0f));
            widths.push_back(static_cast<float>(10 + random.below(120)));
        }
        expectApart(badgesAround(any, widths, room), room, "random " + std::to_string(k));
    }
}

TEST(Badges, StayWhereTheirActuatorsAreWhereThereIsRoom) {
    const auto places = grid(16, room.reduced(40.0f));
    const auto badges = badgesAround(places, std::vector<float>(16, 20.0f), room);
    for (std::size_t j = 0; j < 16; ++j) {
        EXPECT_NEAR(badges[j].getCentreX(), places[j].x, 0.5f);
        EXPECT_NEAR(badges[j].getCentreY(), places[j].y, 0.5f);
        EXPECT_EQ(badges[j].getHeight(), highestBadge);
    }
}

TEST(Badges, ALongNameGetsWhatItsNeighbourDoesNotNeed) {
    const Places two{{100.0f, 100.0f}, {170.0f, 100.0f}};
    const auto unlike = badgesAround(two, std::vector{200.0f, 12.0f}, room),
               alike = badgesAround(two, std::vector{200.0f, 200.0f}, room);
    EXPECT_EQ(unlike[0].getWidth(), widestBadge);
    EXPECT_EQ(unlike[1].getWidth(), highestBadge);
    EXPECT_EQ(alike[0].getWidth(), alike[1].getWidth());
    EXPECT_NEAR(alike[0].getWidth(), 67.0f, 0.1f);
}

TEST(Badges, AreGrippedWhereTheyAreDrawn) {
    MixerModel model{onlyNoDevice(), noDevice};
    MixerView view{model};
    view.setSize(1024, 700);
    model.attach(0.5, 0.5);
    model.attach(0.5, 0.5);
    model.dispatchPendingMessages();
    auto& world = view.world().view();
    EXPECT_FALSE(world.badgeAt(4).intersects(world.badgeAt(5)));
    for (const int j : {4, 5}) EXPECT_EQ(world.targetAt(world.badgeAt(j).getCentre()).enchanter, j);
    const auto before = world.badgeAt(4);
    view.setSize(1920, 1080);
    EXPECT_NE(world.badgeAt(4), before) << "placed again";
    model.detach(5);
    model.dispatchPendingMessages();
    EXPECT_EQ(world.badgeAt(4).getCentre(), world.placeOfEnchanter(4));
}

} // namespace
} // namespace physvib
