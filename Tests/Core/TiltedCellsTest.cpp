// SPDX-License-Identifier: MIT
// Rows, grids and belts in any plane or on any line of space, and parts of the body that have one.
#include "Core/ActuatorCells.h"
#include "Core/PhantomPanner.h"
#include "Support/ClosedForm.h"
#include "Support/Rendering.h"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <string>
#include <vector>

namespace physvib {
namespace {

using Places = std::vector<ActuatorPlace>;

ActuatorLayout layoutAt(const Places& places) {
    ActuatorLayout layout{1.0, 1.0, static_cast<int>(places.size()), {}};
    std::copy(places.begin(), places.end(), layout.places.begin());
    return layout;
}

PhantomPanner pannerOn(const Places& places, PanningLaw law = PanningLaw::automatic) {
    return {layoutAt(places), law, 1.0, 1.0, 1.0};
}

PhantomPanner::Gains gainsFor(const PhantomPanner& panner, const ActuatorPlace& at, PartNumber part = 0) {
    CollisionEvent event;
    event.x = at.xMetres, event.y = at.yMetres, event.z = at.zMetres;
    event.source.part = part;
    PhantomPanner::Gains gains{};
    panner.gainsAt(event, gains);
    return gains;
}

/// A plane's origin and axes.
struct Frame {
    ActuatorPlace origin, right, up;

    ActuatorPlace at(const ActuatorPlace& flat, double off = 0.0) const {
        return sumOf(sumOf(sumOf(origin, right, flat.xMetres), up, flat.yMetres), vectorProduct(right, up),
                     off);
    }
    Places of(const Places& flat) const {
        Places places;
        for (const auto& place : flat) places.push_back(at(place));
        return places;
    }
};

Frame randomFrame(test::Random& random) {
    const auto vector = [&] {
        return ActuatorPlace{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    };
    const ActuatorPlace right = directionOf(vector());
    return {vector(), right, directionOf(vectorProduct(right, vector()))};
}

Places row(int count) {
    Places places;
    for (int j = 0; j < count; ++j) places.push_back({0.07 * j * (1.0 + 0.1 * j), 0.0});
    return places;
}

Places grid(int columns, int rows) {
    Places places;
    for (int j = 0; j < columns * rows; ++j) places.push_back({0.1 * (j % columns), 0.25 * (j / columns)});
    return places;
}

Places belt(int count) {
    Places places;
    for (int j = 0; j < count; ++j) {
        const double angle = 2.0 * std::numbers::pi * j / count + 0.1;
        places.push_back({0.5 + 0.5 * std::cos(angle), 0.3 + 0.3 * std::sin(angle)});
    }
    return places;
}

std::vector<Places> shapes() {
    return {row(2), row(3), row(8), row(16), grid(2, 2), grid(4, 2), grid(3, 3), belt(4), belt(8)};
}

ActuatorPlace centroidOf(const Places& places, const PhantomPanner::Gains& gains) {
    ActuatorPlace felt;
    for (std::size_t j = 0; j < places.size(); ++j) felt = sumOf(felt, places[j], gains[j] * gains[j]);
    return felt;
}

double distance(const ActuatorPlace& a, const ActuatorPlace& b) {
    const ActuatorPlace d = vectorFrom(a, b);
    return std::sqrt(scalarProduct(d, d));
}

TEST(TiltedCells, ThePlaceIsTheCentroidInAnyPlaneAndWhatIsBesideIsMovedOntoIt) {
    test::Random random{3};
    for (int turn = 0; turn < 30; ++turn)
        for (const Places& flat : shapes()) {
            const Frame frame = randomFrame(random);
            const Places places = frame.of(flat);
            const PhantomPanner panner = pannerOn(places);
            ASSERT_EQ(panner.law(), PanningLaw::neighbours) << flat.size() << " turn " << turn;
            for (int i = 0; i < 20; ++i) { // between two of the actuators, so within
                const auto any = [&] {
                    return flat[static_cast<std::size_t>(
                        random.uniform(0, static_cast<double>(flat.size())))];
                };
                const double share = random.uniform(0, 1);
                const ActuatorPlace p = sumOf(sumOf({}, any(), share), any(), 1.0 - share);
                const auto gains = gainsFor(panner, frame.at(p, random.uniform(-1, 1)));
                EXPECT_NEAR(distance(centroidOf(places, gains), frame.at(p)), 0.0, 1e-9) << flat.size();
                double energy = 0.0;
                for (const double gain : gains) energy += gain * gain;
                EXPECT_NEAR(energy, 1.0, 1e-9);
            }
            for (std::size_t j = 0; j < places.size(); ++j)
                EXPECT_NEAR(gainsFor(panner, places[j])[j], 1.0, 1e-6) << flat.size() << ' ' << j;
        }
}

TEST(TiltedCells, PlanesOfTwoAxesPanAsThatOfXAndY) {
    const Frame ahead{{}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}}, aside{{}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    for (const Places& flat : {row(8), grid(4, 2), belt(4), belt(8)})
        for (const Frame& frame : {ahead, aside}) {
            const PhantomPanner there = pannerOn(frame.of(flat)), here = pannerOn(flat);
            for (const ActuatorPlace p : {ActuatorPlace{0.21, 0.13}, {0.8, 0.4}, {-0.3, 0.9}}) {
                const auto expected = gainsFor(here, p), gains = gainsFor(there, frame.at(p));
                for (std::size_t j = 0; j < flat.size(); ++j)
                    EXPECT_NEAR(gains[j], expected[j], 1e-9) << flat.size() << ' ' << j;
            }
        }
}

TEST(TiltedCells, WhatIsInNoPlaneGoesByDistanceAndNamesCanAskForCells) {
    Places bent = Frame{{}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}}.of(row(5));
    bent[2].yMetres += 1e-5; // as files round
    EXPECT_EQ(pannerOn(bent).law(), PanningLaw::neighbours);
    bent[2].yMetres += 0.05, bent[3].zMetres += 0.05;
    EXPECT_EQ(pannerOn(bent).law(), PanningLaw::distance);
    const Places upright = Frame{{}, {0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}}.of(row(4));
    const auto gains = gainsFor(pannerOn(upright, PanningLaw::triangles), upright[1]);
    EXPECT_NEAR(gains[1], 1.0, 1e-6);
    EXPECT_EQ(gainsFor(pannerOn(upright), {0.3, 0.2, 0.03}),
              gainsFor(pannerOn(upright, PanningLaw::neighbours), {0.3, 0.2, 0.03}));
}

/// Tips of a hand, which are in no plane, and two more on the index, in a row with its tip.
Places hand() {
    ActuatorLayout tips;
    EXPECT_TRUE(layoutPreset("glove5", tips));
    Places places{tips.places.begin(), tips.places.begin() + tips.count};
    for (int j = 1; j < 3; ++j)
        places.push_back({0.06 - 0.01 * j, 0.085 - 0.03 * j, -0.01 - 0.005 * j, partNamed("index")});
    return places;
}

TEST(TiltedCells, APartChoosesTheLawOfItsOwnShape) {
    const Places places = hand();
    const PhantomPanner panner = pannerOn(places);
    ASSERT_EQ(panner.law(), PanningLaw::distance);
    EXPECT_EQ(panner.requestedLaw(), PanningLaw::automatic);
    EXPECT_EQ(panner.pannerOf(partNamed("index")).law(), PanningLaw::neighbours);
    const ActuatorPlace between = sumOf(sumOf({}, places[1], 0.7), places[5], 0.3);
    const auto gains = gainsFor(panner, between, partNamed("index"));
    EXPECT_NEAR(gains[1] * gains[1], 0.7, 1e-9);
    EXPECT_NEAR(gains[5] * gains[5], 0.3, 1e-9);
    for (const std::size_t other : {0U, 2U, 3U, 4U, 6U}) EXPECT_EQ(gains[other], 0.0);
    EXPECT_EQ(pannerOn(places, PanningLaw::distance).pannerOf(partNamed("index")).law(), PanningLaw::distance)
        << "a law that is named holds for parts too";
}

TEST(TiltedCells, KeptPannersOfPartsGiveTheSameGainsAndFollowTheLayout) {
    Places many;
    for (int j = 0; j < 60; ++j)
        many.push_back(
            {0.01 * j, 0.3 * std::sin(j), 0.2 * std::cos(3 * j), partNamed(std::to_string(j / 3))});
    test::Random random{8};
    PartPanners kept, few; // few: prepared for less than there is
    ASSERT_TRUE(kept.prepare(limits::maxEnchanters) && few.prepare(3));
    const std::vector<PhantomPanner> panners{pannerOn(hand()), pannerOn(many),
                                             pannerOn(hand(), PanningLaw::linear)};
    for (int turn = 0; turn < 200; ++turn) {
        const PhantomPanner& panner = panners[static_cast<std::size_t>(turn / 20) % panners.size()];
        if (turn % 20 == 0) kept = panner, few = panner;
        const auto& any =
            panner.layout().places[static_cast<std::size_t>(random.uniform(0, panner.channels()))];
        CollisionEvent event;
        event.x = random.uniform(0, 1), event.y = random.uniform(0, 1), event.z = random.uniform(-1, 1);
        event.source.part = turn % 7 == 0 ? 0 : any.part;
        event.source.kind = turn % 3 == 0 ? ContactKind::roll : ContactKind::hit;
        PhantomPanner::Gains gains{}, expected{};
        kept.gainsAt(event, gains);
        panner.gainsAt(event, expected);
        ASSERT_EQ(gains, expected) << turn;
        few.gainsAt(event, gains);
        ASSERT_EQ(gains, expected) << turn;
    }
}

} // namespace
} // namespace physvib
