// SPDX-License-Identifier: MIT
// Presets stand where Docs/panning.md says, and isValid refuses what cannot be panned over.
#include "Core/EnchanterLayout.h"
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace physvib {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();

EnchanterLayout preset(std::string_view name) {
    EnchanterLayout layout;
    EXPECT_TRUE(layoutPreset(name, layout)) << name;
    return layout;
}

void expectPlaces(std::string_view name, const std::vector<std::pair<double, double>>& expected) {
    const EnchanterLayout layout = preset(name);
    ASSERT_EQ(layout.count, static_cast<int>(expected.size())) << name;
    for (std::size_t j = 0; j < expected.size(); ++j) {
        EXPECT_DOUBLE_EQ(layout.places[j].xMetres, expected[j].first) << name << " " << j;
        EXPECT_DOUBLE_EQ(layout.places[j].yMetres, expected[j].second) << name << " " << j;
    }
}

TEST(EnchanterLayout, EveryPresetIsValidAndHasTheCountInItsName) {
    for (const std::string_view name : layoutPresetNames) {
        const EnchanterLayout layout = preset(name);
        EXPECT_TRUE(isValid(layout)) << name;
        EXPECT_EQ(std::to_string(layout.count), name.substr(name.find_first_of("0123456789"))) << name;
    }
}

TEST(EnchanterLayout, ExtentsArePhoneAndHands) {
    EXPECT_EQ(preset("phone1").extentWidthMetres, 0.12);
    EXPECT_EQ(preset("phone4").extentHeightMetres, 0.06);
    EXPECT_EQ(preset("ring1").extentWidthMetres, 0.16);
    EXPECT_EQ(preset("ring4").extentHeightMetres, 0.08);
}

TEST(EnchanterLayout, FourSitOnTheCornersUpperLeftFirst) {
    expectPlaces("phone4", {{0.0, 0.06}, {0.12, 0.06}, {0.0, 0.0}, {0.12, 0.0}});
    expectPlaces("ring4", {{0.0, 0.08}, {0.16, 0.08}, {0.0, 0.0}, {0.16, 0.0}});
}

TEST(EnchanterLayout, ACabinetHasItsFrontBelowAndFirst) {
    expectPlaces("cabinet4", {{0.0, 0.0}, {0.56, 0.0}, {0.0, 1.1}, {0.56, 1.1}});
}

TEST(EnchanterLayout, APadForAPicoIsReadInLines) {
    expectPlaces("pico4", {{0.0, 0.08}, {0.24, 0.08}, {0.0, 0.0}, {0.24, 0.0}});
    expectPlaces("pico8", {{0.0, 0.08},
                           {0.08, 0.08},
                           {0.16, 0.08},
                           {0.24, 0.08},
                           {0.0, 0.0},
                           {0.08, 0.0},
                           {0.16, 0.0},
                           {0.24, 0.0}});
}

TEST(EnchanterLayout, PresetsOnABodyAreInSpaceAndNameItsParts) {
    for (const char* name : {"glove5", "sleeve8", "vest16"}) {
        const EnchanterLayout layout = preset(name);
        EXPECT_FALSE(isFlat(layout)) << name;
        for (std::size_t j = 0; j < static_cast<std::size_t>(layout.count); ++j) {
            const auto& at = layout.places[j];
            EXPECT_TRUE(at.xMetres >= 0.0 && at.xMetres <= layout.extentWidthMetres) << name << ' ' << j;
            EXPECT_TRUE(at.yMetres >= 0.0 && at.yMetres <= layout.extentHeightMetres) << name << ' ' << j;
        }
    }
    EXPECT_EQ(preset("glove5").places[1].part, partNamed("index"));
    EXPECT_EQ(preset("sleeve8").places[7].part, partNamed("forearm"));
    EXPECT_EQ(preset("vest16").places[7].part, partNamed("chest"));
    EXPECT_EQ(preset("vest16").places[8].part, partNamed("back"));
    EXPECT_TRUE(isFlat(preset("cabinet4")));
}

TEST(EnchanterLayout, OneTwoAndThreeAreCentreSidesAndTriangle) {
    expectPlaces("phone1", {{0.06, 0.03}});
    expectPlaces("phone2", {{0.0, 0.03}, {0.12, 0.03}});
    expectPlaces("ring3", {{0.0, 0.08}, {0.16, 0.08}, {0.08, 0.0}});
}

TEST(EnchanterLayout, UnknownPresetLeavesTheLayoutUntouched) {
    for (const std::string_view name : {"", "phone", "phone0", "phone65", "PHONE4", "phone4 ", "ring44"}) {
        EnchanterLayout layout = preset("ring2");
        EXPECT_FALSE(layoutPreset(name, layout)) << name;
        EXPECT_EQ(layout.count, 2) << name;
        EXPECT_EQ(layout.extentWidthMetres, 0.16) << name;
    }
}

TEST(EnchanterLayout, CountOutsideOneTo64IsInvalid) {
    EnchanterLayout layout = preset("phone4");
    for (const int count : {-1, 0, 65}) {
        layout.count = count;
        EXPECT_FALSE(isValid(layout)) << count;
    }
    layout.count = 64;
    EXPECT_TRUE(isValid(layout));
}

TEST(EnchanterLayout, ExtentMustBePositiveAndFinite) {
    for (const double bad : {0.0, -0.1, infinity, notANumber}) {
        EnchanterLayout wide = preset("phone4"), high = preset("phone4");
        wide.extentWidthMetres = bad;
        high.extentHeightMetres = bad;
        EXPECT_FALSE(isValid(wide)) << bad;
        EXPECT_FALSE(isValid(high)) << bad;
    }
}

TEST(EnchanterLayout, OnlyTheFirstCountPlacesMustBeFinite) {
    EnchanterLayout layout = preset("phone3");
    layout.places[3] = {notANumber, infinity};
    EXPECT_TRUE(isValid(layout));
    layout.places[2].yMetres = notANumber;
    EXPECT_FALSE(isValid(layout));
    layout.places[2] = {-infinity, 0.0};
    EXPECT_FALSE(isValid(layout));
}

} // namespace
} // namespace physvib
