// SPDX-License-Identifier: MIT
// The law `neighbours` on rows, grids and belts, and where the default law chooses it.
#include "Core/PhantomPanner.h"
#include "Support/ClosedForm.h"
#include "Support/Rendering.h"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <string>

namespace physvib {
namespace {

using Places = std::vector<EnchanterPlace>;

EnchanterLayout layoutAt(const Places& places, double width = 1.0, double height = 1.0) {
    EnchanterLayout layout{width, height, static_cast<int>(places.size()), {}};
    std::copy(places.begin(), places.end(), layout.places.begin());
    return layout;
}

Places ellipse(int count, double width, double height) {
    Places places;
    for (int k = 0; k < count; ++k) {
        const double angle = 2 * std::numbers::pi * (k * 3 % count) / count; // not in order
        places.push_back({0.5 + 0.5 * width * std::cos(angle), 0.5 + 0.5 * height * std::sin(angle)});
    }
    return places;
}

PhantomPanner pannerOn(const EnchanterLayout& layout, PanningLaw law = PanningLaw::automatic) {
    return {layout, law, 1.0, layout.extentWidthMetres, layout.extentHeightMetres};
}

struct Felt {
    double x = 0.0, y = 0.0, energy = 0.0;
};

Felt feltAt(const PhantomPanner& panner, double x, double y) {
    PhantomPanner::Gains gains{};
    panner.gainsAt(x, y, gains);
    Felt felt;
    for (std::size_t j = 0; j < static_cast<std::size_t>(panner.channels()); ++j) {
        const double energy = gains[j] * gains[j];
        felt.energy += energy;
        felt.x += energy * panner.layout().places[j].xMetres;
        felt.y += energy * panner.layout().places[j].yMetres;
    }
    return felt;
}

const Places unevenRow{{0.3, 0.2}, {0.9, 0.2}, {0.1, 0.2}, {0.45, 0.2}};
const Places slantedRow{{0.1, 0.1}, {0.3, 0.3}, {0.5, 0.5}, {0.9, 0.9}};
const Places unevenGrid{{0.0, 0.0}, {0.2, 0.0}, {1.0, 0.0}, {0.0, 0.3}, {0.2, 0.3}, {1.0, 0.3}};

std::vector<EnchanterLayout> shapes() {
    return {layoutAt(unevenRow),
            layoutAt(slantedRow),
            layoutAt(unevenGrid),
            layoutAt(ellipse(8, 1.0, 1.0)),
            layoutAt(ellipse(7, 1.0, 0.6)),
            layoutAt(ellipse(64, 0.9, 0.9)),
            test::gridLayout(64, 1),
            test::gridLayout(1, 3),
            test::gridLayout(4, 2)};
}

TEST(NeighbourCells, TheCentroidOfIntensityIsThePlaceWithinTheShape) {
    test::Random random{5};
    for (const auto& layout : shapes()) {
        const PhantomPanner panner = pannerOn(layout);
        ASSERT_EQ(panner.law(), PanningLaw::neighbours) << layout.count;
        for (int i = 0; i < 500; ++i) { // between three of the actuators, so within
            Felt place;
            double left = 1.0;
            for (int k = 0; k < 3; ++k) {
                const auto& p = layout.places[static_cast<std::size_t>(random.uniform(0, layout.count))];
                const double share = k == 2 ? left : random.uniform(0, left);
                left -= share;
                place.x += share * p.xMetres;
                place.y += share * p.yMetres;
            }
            const Felt felt = feltAt(panner, place.x, place.y);
            ASSERT_NEAR(felt.x, place.x, 1e-9) << layout.count;
            ASSERT_NEAR(felt.y, place.y, 1e-9) << layout.count;
            ASSERT_NEAR(felt.energy, 1.0, 1e-9) << layout.count;
        }
    }
}

TEST(NeighbourCells, AnImpactAtAnActuatorIsThatActuatorAlone) {
    for (const auto& layout : shapes())
        for (std::size_t j = 0; j < static_cast<std::size_t>(layout.count); ++j) {
            PhantomPanner::Gains gains{};
            pannerOn(layout).gainsAt(layout.places[j].xMetres, layout.places[j].yMetres, gains);
            for (std::size_t k = 0; k < static_cast<std::size_t>(layout.count); ++k)
                ASSERT_NEAR(gains[k], j == k ? 1.0 : 0.0, 1e-7) << layout.count << ' ' << j << ' ' << k;
        }
}

// Energies, since a root is steep at zero. Their slope is at most the reciprocal of the narrowest part of a
// cell, which is 1/63 in the longest row.
TEST(NeighbourCells, NoGainJumpsOnAnyWay) {
    for (const auto& layout : shapes()) {
        const PhantomPanner panner = pannerOn(layout);
        for (int way = 0; way < 8; ++way) {
            PhantomPanner::Gains before{}, now{};
            constexpr int steps = 3'000;
            for (int i = 0; i <= steps; ++i) {
                const double x = -0.2 + 1.4 * i / steps, y = 0.5 + std::sin(way) * (x - 0.5 + 0.01 * way);
                panner.gainsAt(x, y, now);
                for (std::size_t j = 0; i > 0 && j < static_cast<std::size_t>(layout.count); ++j)
                    ASSERT_NEAR(now[j] * now[j], before[j] * before[j], 0.05) << layout.count << ' ' << x;
                before = now;
            }
        }
    }
}

TEST(NeighbourCells, APlaceOutsideIsMovedToTheEdge) {
    const Felt left = feltAt(pannerOn(layoutAt(unevenRow)), -3.0, 5.0);
    EXPECT_NEAR(left.x, 0.1, 1e-12);
    EXPECT_EQ(left.energy, 1.0);
    const Felt corner = feltAt(pannerOn(layoutAt(unevenGrid)), 7.0, 7.0);
    EXPECT_NEAR(corner.x, 1.0, 1e-12);
    EXPECT_NEAR(corner.y, 0.3, 1e-12);
    const Felt belt = feltAt(pannerOn(layoutAt(ellipse(8, 1.0, 1.0))), 0.5 + 3.0 * std::cos(0.3),
                             0.5 + 3.0 * std::sin(0.3));
    EXPECT_NEAR(std::atan2(belt.y - 0.5, belt.x - 0.5), 0.3, 1e-9);
    EXPECT_NEAR(belt.energy, 1.0, 1e-12);
}

void expectSameGains(const PhantomPanner& a, const PhantomPanner& b, const std::string& name) {
    test::Random random{3};
    for (int i = 0; i < 200; ++i) {
        CollisionEvent event;
        event.x = random.uniform(-0.1, 1.1) * a.fieldWidthMetres();
        event.y = random.uniform(-0.1, 1.1) * a.fieldHeightMetres();
        event.source.kind = i % 2 == 0 ? ContactKind::hit : ContactKind::roll;
        PhantomPanner::Gains one{}, other{};
        a.gainsAt(event, one);
        b.gainsAt(event, other);
        ASSERT_TRUE(one == other) << name;
    }
}

// Five with one in the middle, two at one place, and a triangle have no cells.
TEST(NeighbourCells, ElsewhereTheDefaultIsWhatItWasToTheBit) {
    std::vector<std::pair<std::string, EnchanterLayout>> layouts{
        {"two of three quarters", layoutAt({{0.1, 0.5}, {0.8, 0.5}})},
        {"a rectangle with a margin", layoutAt({{0.1, 0.1}, {0.8, 0.1}, {0.1, 0.9}, {0.8, 0.9}})},
        {"two at one place", layoutAt({{0.1, 0.5}, {0.1, 0.5}, {0.8, 0.5}})},
        {"all at one place", layoutAt({{0.1, 0.5}, {0.1, 0.5}, {0.1, 0.5}})},
        {"a middle", layoutAt({{0, 0}, {1, 0}, {0, 1}, {1, 1}, {0.5, 0.5}})}};
    for (const auto name : layoutPresetNames)
        if (name.starts_with("phone") || name.starts_with("ring"))
            layoutPreset(name, layouts.emplace_back(std::string{name}, EnchanterLayout{}).second);
    for (const auto& [name, layout] : layouts) {
        PhantomPanner before = pannerOn(layout, PanningLaw::linear);
        before.setGrains(grainSpread);
        const PhantomPanner now = pannerOn(layout);
        EXPECT_EQ(now.law(), PanningLaw::linear) << name;
        EXPECT_EQ(now.grains(), grainSpread) << name;
        EXPECT_EQ(now.travelSpread(), Spread::equal) << name;
        expectSameGains(now, before, name);
    }
}

TEST(NeighbourCells, AnExponentIsThatOfTheLinearLaw) {
    const EnchanterLayout row = test::gridLayout(4, 1);
    const PhantomPanner now{row, PanningLaw::automatic, 2.0, 1.0, 1.0},
        before{row, PanningLaw::linear, 2.0, 1.0, 1.0};
    EXPECT_EQ(now.grains(), Spread::layout);
    expectSameGains(now, before, "row");
}

TEST(NeighbourCells, ThePlacesOfAFileMayBeRounded) {
    Places belt = ellipse(16, 1.0, 1.0), grid = unevenGrid;
    for (auto& p : belt) p = {std::round(p.xMetres * 1000) / 1000, std::round(p.yMetres * 1000) / 1000};
    grid[4].xMetres += 0.0015;
    EXPECT_EQ(pannerOn(layoutAt(belt)).law(), PanningLaw::neighbours);
    EXPECT_EQ(pannerOn(layoutAt(grid)).law(), PanningLaw::neighbours);
    grid[4].yMetres -= 0.1;
    EXPECT_EQ(pannerOn(layoutAt(grid)).law(), PanningLaw::linear);
}

// The law can be named for any layout, and a message or an event can name it too.
TEST(NeighbourCells, TheLawIsEnergyWhereThereAreNoCells) {
    EnchanterLayout phone3;
    layoutPreset("phone3", phone3);
    expectSameGains(pannerOn(phone3, PanningLaw::neighbours), pannerOn(phone3, PanningLaw::energy), "phone3");
    const PhantomPanner row = pannerOn(test::gridLayout(4, 1), PanningLaw::linear);
    PhantomPanner::Gains named{}, chosen{}, law{};
    row.gainsAt(0.4, 0.5, spreadBy(PanningLaw::neighbours), named);
    row.gainsAt(0.4, 0.5, spreadBy(PanningLaw::automatic), chosen);
    pannerOn(row.layout()).gainsAt(0.4, 0.5, law);
    EXPECT_TRUE(named == law && chosen == law);
    EXPECT_EQ(std::count(law.begin(), law.begin() + 4, 0.0), 2);
}

} // namespace
} // namespace physvib
