// SPDX-License-Identifier: MIT
// PhantomPanner: the printed equations at printed places, and what every law must keep.
#include "Core/PhantomPanner.h"
#include "Core/EnchanterLayout.h"
#include "Support/ClosedForm.h"
#include "Support/Rendering.h"
#include "TestPlaces.h"
#include <array>
#include <bit>
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <limits>
#include <numeric>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace physvib::phantom_panner_test {

constexpr double W = 6.4, H = 3.6; // field metres

PhantomPanner::Gains gainsOf(const ActuatorLayout& layout, PanningLaw law, double x, double y,
                             double exponent = 1) {
    PhantomPanner::Gains gains{};
    PhantomPanner{layout, law, exponent, W, H}.gainsAt(x, y, gains);
    return gains;
}

ActuatorLayout preset(std::string_view name) {
    ActuatorLayout layout;
    EXPECT_TRUE(layoutPreset(name, layout)) << name;
    return layout;
}

double sumOfSquares(const PhantomPanner::Gains& gains) {
    double sum = 0;
    for (const double g : gains) sum += g * g;
    return sum;
}

TEST(PhantomPanner, OneEnchanterPlaysEverythingFully) {
    for (const auto& one : panningLaws) EXPECT_EQ(gainsOf(preset("phone1"), one.law, 0.3, 3.0)[0], 1.0);
}

// Equations 4.2, with its gamma, and 4.3 in its two reconstructions; two follow the line only.
TEST(PhantomPanner, GainsAreThoseOfTheEquationsUpperLeftFirst) {
    struct Case {
        ActuatorLayout layout;
        PanningLaw law;
        double x, y, exponent;
        std::vector<std::pair<std::size_t, double>> gains;
    };
    ActuatorLayout diagonal{1, 1, 2, {}};
    diagonal.places[1] = {1, 1};
    std::vector<Case> cases{{preset("phone4"),
                             PanningLaw::linear,
                             1.6,
                             2.7,
                             1.0,
                             {{0, 0.75 * 0.75}, {1, 0.25 * 0.75}, {2, 0.75 * 0.25}, {3, 0.25 * 0.25}}},
                            {preset("ring4"), PanningLaw::linear, 1.6, 2.7, 2.0, {{1, 0.0625 * 0.5625}}},
                            {preset("phone4"),
                             PanningLaw::log,
                             1.6,
                             2.7,
                             1.0,
                             {{0, std::pow(1 - std::log2(1.25), 2)}, {3, std::pow(1 - std::log2(1.75), 2)}}},
                            {preset("phone4"),
                             PanningLaw::logOuter,
                             1.6,
                             2.7,
                             1.0,
                             {{0, std::pow(std::log2(1.75), 2)}, {3, std::pow(std::log2(1.25), 2)}}},
                            {diagonal, PanningLaw::linear, W / 4, H / 4, 1.0, {{0, 0.75}}},
                            {test::gridLayout(8, 1), PanningLaw::linear, W / 7.0 * 3, 0.0, 1.0, {}}};
    for (std::size_t j = 0; j < 8; ++j)
        cases.back().gains.emplace_back(j, 1 - std::abs(static_cast<double>(j) - 3) / 7.0);
    for (const double y : {0.0, 1.0, H})
        cases.push_back({preset("phone2"), PanningLaw::linear, 1.6, y, 1.0, {{0, 0.75}, {1, 0.25}}});
    for (const Case& c : cases)
        for (const auto& [j, gain] : c.gains)
            EXPECT_NEAR(gainsOf(c.layout, c.law, c.x, c.y, c.exponent)[j], gain, 1e-12)
                << nameOf(c.law) << " of " << c.layout.count << ", actuator " << j;
}

TEST(PhantomPanner, CentreOfFourIs6dBDownLinearAnd9Point3Logarithmic) {
    EXPECT_NEAR(10 * std::log10(sumOfSquares(gainsOf(preset("phone4"), PanningLaw::linear, W / 2, H / 2))),
                -6.02, 0.01);
    EXPECT_NEAR(10 * std::log10(sumOfSquares(gainsOf(preset("phone4"), PanningLaw::log, W / 2, H / 2))),
                -9.26, 0.01);
    EXPECT_NEAR(sumOfSquares(gainsOf(preset("ring4"), PanningLaw::energy, W / 2, H / 2)), 1.0, 1e-9);
}

TEST(PhantomPanner, TriangleIsBarycentricAndProjectsWhatLiesOutside) {
    const auto layout = preset("phone3"); // A upper left, B upper right, C lower centre
    const auto centre = gainsOf(layout, PanningLaw::linear, W / 2, H * 2 / 3);
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(centre[static_cast<std::size_t>(j)], 1.0 / 3, 1e-12);
    const auto corner = gainsOf(layout, PanningLaw::linear, W / 2, 0);
    EXPECT_NEAR(corner[2], 1, 1e-12);
    const auto outside = gainsOf(layout, PanningLaw::energy, 0, 0);
    EXPECT_NEAR(sumOfSquares(outside), 1, 1e-12);
    EXPECT_EQ(outside[1], 0.0);
}

TEST(PhantomPanner, OtherArrangementsWeighByInverseSquareDistance) {
    const auto layout = test::gridLayout(3, 3);
    const auto g = gainsOf(layout, PanningLaw::linear, 0.2 * W, 0.1 * H);
    const auto weight = [](int j) {
        return 1 / (std::pow(0.2 - (j % 3) / 2.0, 2) + std::pow(0.1 - (j / 3) / 2.0, 2));
    };
    double sum = 0;
    for (int j = 0; j < 9; ++j) sum += weight(j);
    for (int j = 0; j < 9; ++j) EXPECT_NEAR(g[static_cast<std::size_t>(j)], weight(j) / sum, 1e-12);
    EXPECT_NEAR(gainsOf(layout, PanningLaw::log, 0.5 * W, 0.5 * H)[4], 1, 1e-9);
}

// All ways in which four can stand on the corners of a rectangle: each on one of its own, in any order, or
// two on the same, which leaves one corner to nobody.
TEST(PhantomPanner, FourAreARectangleOnlyIfEachHasACornerOfItsOwn) {
    const ActuatorPlace corners[]{
        {0.1 * W, 0.2 * H}, {0.8 * W, 0.2 * H}, {0.1 * W, 0.9 * H}, {0.8 * W, 0.9 * H}};
    constexpr double x = 0.3 * W, y = 0.6 * H;
    for (unsigned way = 0; way < 256; ++way) {
        ActuatorLayout layout{W, H, 4, {}};
        std::array<double, 4> products{}, weights{};
        unsigned taken = 0;
        for (std::size_t j = 0; j < 4; ++j) {
            const std::size_t corner = way >> 2 * j & 3U;
            taken |= 1U << corner;
            layout.places[j] = corners[corner];
            const double dx = x - corners[corner].xMetres, dy = y - corners[corner].yMetres;
            products[j] = (1 - std::abs(dx) / W) * (1 - std::abs(dy) / H);
            weights[j] = 1 / (dx * dx + dy * dy);
        }
        const int count = std::popcount(taken);
        if (count < 3) continue; // on one line
        const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
        const auto gains = gainsOf(layout, PanningLaw::linear, x, y);
        for (std::size_t j = 0; j < 4; ++j)
            EXPECT_NEAR(gains[j], count == 4 ? products[j] : weights[j] / sum, 1e-12) << way << ' ' << j;
    }
}

TEST(PhantomPanner, EnergySquaresSumToOneAndNoGainLeavesZeroToOne) {
    test::Random random{11};
    for (const auto& layout : {preset("phone2"), preset("phone3"), preset("phone4"), test::gridLayout(4, 4)})
        for (int i = 0; i < 500; ++i) {
            const double x = random.uniform(-1, W + 1), y = random.uniform(-1, H + 1);
            for (const auto& one : panningLaws)
                for (const double g : gainsOf(layout, one.law, x, y)) ASSERT_TRUE(g >= 0 && g <= 1);
            if (x >= 0 && x <= W && y >= 0 && y <= H)
                ASSERT_NEAR(sumOfSquares(gainsOf(layout, PanningLaw::energy, x, y)), 1, 1e-9);
        }
}

TEST(PhantomPanner, EveryLawFallsFromOneToZero) {
    for (const auto& one : panningLaws) {
        EXPECT_EQ(one.gain(0.0), 1.0) << one.name;
        EXPECT_EQ(one.gain(1.0), 0.0) << one.name;
        for (int i = 1; i <= 64; ++i)
            EXPECT_LT(one.gain(i / 64.0), one.gain((i - 1) / 64.0)) << one.name << ' ' << i;
    }
}

/// Where between the left and the right edge an event is felt: the centroid of intensity.
double centroidOf(const PhantomPanner& panner, const CollisionEvent& event) {
    PhantomPanner::Gains gains{};
    panner.gainsAt(event, gains);
    double sum = 0.0, moment = 0.0;
    for (int j = 0; j < panner.channels(); ++j) {
        const auto i = static_cast<std::size_t>(j);
        sum += gains[i] * gains[i];
        moment += gains[i] * gains[i] * panner.layout().places[i].xMetres / panner.layout().extentWidthMetres;
    }
    return moment / sum;
}

TEST(PhantomPanner, GrainsAreFeltWhereTheyAre) {
    for (const char* name : {"phone2", "phone4"}) {
        PhantomPanner panner{preset(name), PanningLaw::linear, 1.0, W, H};
        CollisionEvent grain;
        grain.y = 0.5 * H;
        grain.source.kind = ContactKind::roll;
        grain.x = 0.3 * W;
        EXPECT_NEAR(centroidOf(panner, grain), 0.16, 0.005)
            << name << ": as everything, before anybody says otherwise";
        EXPECT_NEAR(centroidOf(panner, grain), centroidOf(PanningLaw::linear, 0.3), 1e-9) << name;
        panner.setGrains(grainSpread);
        for (double share = 0.0; share <= 1.0; share += 0.05) {
            grain.x = share * W;
            EXPECT_NEAR(centroidOf(panner, grain), share, 0.01) << name;
        }
        grain.x = 0.3 * W;
        grain.spread = spreadBy(PanningLaw::linear);
        EXPECT_NEAR(centroidOf(panner, grain), 0.16, 0.005) << name << ": what an event asks for stands";
        grain.spread = Spread::layout;
        grain.source.kind = ContactKind::hit;
        EXPECT_NEAR(centroidOf(panner, grain), 0.16, 0.005) << name << ": hits go by the law";
    }
}

// Every law has a row in Docs/panning.md, in this order, with its formula's gains at 1/4, 1/2 and 3/4.
TEST(PhantomPanner, ThePageHasTheTableOfLaws) {
    std::ifstream page{PHYSVIB_SOURCE_DIR "/Docs/panning.md"};
    std::string line;
    while (std::getline(page, line) && !line.starts_with("| `--law`")) continue;
    std::getline(page, line); // the rule below the heads
    for (const auto& one : panningLaws) {
        std::getline(page, line);
        ASSERT_TRUE(line.starts_with("| `" + std::string{one.name} + "`"))
            << "expected the row of " << one.name << " in Docs/panning.md, found " << line;
        std::istringstream gains{line.substr(line.find(" |", line.find(" |") + 1) + 2)};
        for (const double u : {0.25, 0.5, 0.75}) {
            double gain = 0.0;
            gains >> gain;
            EXPECT_NEAR(gain, one.gain(u), 5.1e-5) << one.name << ' ' << u;
        }
    }
    std::getline(page, line);
    EXPECT_EQ(line, "") << "expected no other law in Docs/panning.md";
}

// Presets stand where Docs/panning.md says, and isValid refuses what cannot be panned over.

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();

void expectPlaces(std::string_view name, const std::vector<std::pair<double, double>>& expected) {
    const ActuatorLayout layout = preset(name);
    ASSERT_EQ(layout.count, static_cast<int>(expected.size())) << name;
    for (std::size_t j = 0; j < expected.size(); ++j) {
        EXPECT_DOUBLE_EQ(layout.places[j].xMetres, expected[j].first) << name << " " << j;
        EXPECT_DOUBLE_EQ(layout.places[j].yMetres, expected[j].second) << name << " " << j;
    }
}

TEST(ActuatorLayout, EveryPresetIsValidAndHasTheCountInItsName) {
    for (const std::string_view name : layoutPresetNames) {
        const ActuatorLayout layout = preset(name);
        EXPECT_TRUE(isValid(layout)) << name;
        EXPECT_EQ(std::to_string(layout.count), name.substr(name.find_first_of("0123456789"))) << name;
    }
}

// Corners upper left first; a cabinet has its front below and first; a pad for a Pico is read in lines.
TEST(ActuatorLayout, PresetsStandWhereThePageSays) {
    expectPlaces("phone1", {{0.06, 0.03}});
    expectPlaces("phone2", {{0.0, 0.03}, {0.12, 0.03}});
    expectPlaces("ring3", {{0.0, 0.08}, {0.16, 0.08}, {0.08, 0.0}});
    expectPlaces("phone4", {{0.0, 0.06}, {0.12, 0.06}, {0.0, 0.0}, {0.12, 0.0}});
    expectPlaces("ring4", {{0.0, 0.08}, {0.16, 0.08}, {0.0, 0.0}, {0.16, 0.0}});
    expectPlaces("cabinet4", {{0.0, 0.0}, {0.56, 0.0}, {0.0, 1.1}, {0.56, 1.1}});
    expectPlaces("pico4", {{0.0, 0.08}, {0.24, 0.08}, {0.0, 0.0}, {0.24, 0.0}});
    std::vector<std::pair<double, double>> lines;
    for (const double y : {0.08, 0.0})
        for (const double x : {0.0, 0.08, 0.16, 0.24}) lines.emplace_back(x, y);
    expectPlaces("pico8", lines);
    EXPECT_EQ(preset("phone1").extentWidthMetres, 0.12);
    EXPECT_EQ(preset("phone4").extentHeightMetres, 0.06);
    EXPECT_EQ(preset("ring1").extentWidthMetres, 0.16);
    EXPECT_EQ(preset("ring4").extentHeightMetres, 0.08);
}

TEST(ActuatorLayout, PresetsOnABodyAreInSpaceAndNameItsParts) {
    for (const char* name : {"glove5", "sleeve8", "vest16"}) {
        const ActuatorLayout layout = preset(name);
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

TEST(ActuatorLayout, UnknownPresetLeavesTheLayoutUntouched) {
    for (const std::string_view name : {"", "phone", "phone0", "phone65", "PHONE4", "phone4 ", "ring44"}) {
        ActuatorLayout layout = preset("ring2");
        EXPECT_FALSE(layoutPreset(name, layout)) << name;
        EXPECT_EQ(layout.count, 2) << name;
        EXPECT_EQ(layout.extentWidthMetres, 0.16) << name;
    }
}

TEST(ActuatorLayout, CountExtentsAndTheFirstCountPlacesMustBeValid) {
    const auto with = [](auto change) {
        ActuatorLayout layout = preset("phone3");
        change(layout);
        return isValid(layout);
    };
    for (const int count : {-1, 0, 65}) EXPECT_FALSE(with([=](auto& l) { l.count = count; })) << count;
    EXPECT_TRUE(with([](auto& l) { l.count = 64; }));
    for (const double bad : {0.0, -0.1, infinity, notANumber}) {
        EXPECT_FALSE(with([=](auto& l) { l.extentWidthMetres = bad; })) << bad;
        EXPECT_FALSE(with([=](auto& l) { l.extentHeightMetres = bad; })) << bad;
    }
    EXPECT_TRUE(with([](auto& l) { l.places[3] = {notANumber, infinity}; }));
    EXPECT_FALSE(with([](auto& l) { l.places[2].yMetres = notANumber; }));
    EXPECT_FALSE(with([](auto& l) { l.places[2] = {-infinity, 0.0}; }));
}

} // namespace physvib::phantom_panner_test
