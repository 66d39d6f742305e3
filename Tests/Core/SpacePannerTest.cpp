// SPDX-License-Identifier: MIT
// Layouts in space and parts of a body: gains of the laws `triangles` and `distance`, and of events that are
// bound to a part.
#include "Core/ActuatorCells.h"
#include "Core/EnchanterLayout.h"
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

EnchanterLayout preset(std::string_view name) {
    EnchanterLayout layout;
    EXPECT_TRUE(layoutPreset(name, layout)) << name;
    return layout;
}

PhantomPanner pannerOf(const EnchanterLayout& layout, PanningLaw law = PanningLaw::automatic) {
    return {layout, law, 1.0, layout.extentWidthMetres, layout.extentHeightMetres};
}

CollisionEvent eventAt(double x, double y, double z, std::string_view part = {}) {
    CollisionEvent event;
    event.x = x, event.y = y, event.z = z;
    event.source.part = partNamed(part);
    return event;
}

PhantomPanner::Gains gainsFor(const PhantomPanner& panner, const CollisionEvent& event) {
    PhantomPanner::Gains gains{};
    panner.gainsOf(event, Spread::layout, gains);
    return gains;
}

double energyOf(const PhantomPanner::Gains& gains) {
    double energy = 0.0;
    for (const double gain : gains) energy += gain * gain;
    return energy;
}

EnchanterLayout octahedron() {
    EnchanterLayout layout{1.0, 1.0, 6, {}};
    const EnchanterPlace places[]{{0.5, 0.5, 0.5}, {0.5, 0.5, -0.5}, {0.0, 0.5, 0.0},
                                  {1.0, 0.5, 0.0}, {0.5, 0.0, 0.0},  {0.5, 1.0, 0.0}};
    std::copy(std::begin(places), std::end(places), layout.places.begin());
    return layout;
}

TEST(SpacePanner, TheShapeChoosesTheLaw) {
    EXPECT_EQ(pannerOf(preset("sleeve8")).law(), PanningLaw::triangles);
    EXPECT_EQ(pannerOf(preset("vest16")).law(), PanningLaw::triangles);
    EXPECT_EQ(pannerOf(octahedron()).law(), PanningLaw::triangles);
    EXPECT_EQ(pannerOf(preset("glove5")).law(), PanningLaw::distance)
        << "a hand does not close around a place";
    EXPECT_EQ(pannerOf(preset("phone4")).law(), PanningLaw::linear);
    EXPECT_EQ(pannerOf(test::gridLayout(4, 1)).law(), PanningLaw::neighbours);
    EXPECT_EQ((PhantomPanner{preset("vest16"), PanningLaw::automatic, 2.0, 0.2, 0.36}.law()),
              PanningLaw::linear);
    EnchanterLayout open = octahedron(); // a shallow bowl: its rim and its bottom
    open.places[0] = open.places[4], open.count = 5;
    open.places[1].zMetres = -0.1, open.places[4] = {0.2, 0.2, 0.0};
    EXPECT_EQ(pannerOf(open).law(), PanningLaw::distance);
}

TEST(SpacePanner, AnActuatorsOwnPlaceIsThatOneAlone) {
    for (const char* name : {"glove5", "sleeve8", "vest16"})
        for (const PanningLaw law : {PanningLaw::distance, PanningLaw::triangles, PanningLaw::automatic}) {
            const auto layout = preset(name);
            const PhantomPanner panner = pannerOf(layout, law);
            for (std::size_t j = 0; j < static_cast<std::size_t>(layout.count); ++j) {
                const auto& at = layout.places[j];
                const auto gains = gainsFor(panner, eventAt(at.xMetres, at.yMetres, at.zMetres));
                for (std::size_t k = 0; k < static_cast<std::size_t>(layout.count); ++k)
                    EXPECT_NEAR(gains[k], j == k ? 1.0 : 0.0, 1e-7) << name << ' ' << j << ' ' << k;
            }
        }
}

TEST(SpacePanner, EnergyIsConstantAndTheCentroidIsThePlaceWithinTheSurface) {
    test::Random random{7};
    for (const auto& layout : {octahedron(), preset("sleeve8"), preset("vest16")})
        for (int i = 0; i < 2000; ++i) {
            EnchanterPlace place; // the mean of four actuators' places: within, if the surface is convex
            for (int k = 0; k < 4; ++k) {
                const auto& p = layout.places[static_cast<std::size_t>(random.uniform(0, layout.count))];
                place.xMetres += 0.25 * p.xMetres, place.yMetres += 0.25 * p.yMetres;
                place.zMetres += 0.25 * p.zMetres;
            }
            const auto gains =
                gainsFor(pannerOf(layout), eventAt(place.xMetres, place.yMetres, place.zMetres));
            EnchanterPlace felt;
            for (std::size_t j = 0; j < static_cast<std::size_t>(layout.count); ++j) {
                felt.xMetres += gains[j] * gains[j] * layout.places[j].xMetres;
                felt.yMetres += gains[j] * gains[j] * layout.places[j].yMetres;
                felt.zMetres += gains[j] * gains[j] * layout.places[j].zMetres;
            }
            ASSERT_NEAR(energyOf(gains), 1.0, 1e-12);
            ASSERT_NEAR(felt.xMetres, place.xMetres, 1e-12);
            ASSERT_NEAR(felt.yMetres, place.yMetres, 1e-12);
            ASSERT_NEAR(felt.zMetres, place.zMetres, 1e-12);
        }
}

TEST(SpacePanner, GainsAreContinuousInsideAndOutside) {
    test::Random random{11};
    constexpr int steps = 20'000;
    for (const auto& layout : {octahedron(), preset("sleeve8"), preset("vest16"), preset("glove5")})
        for (int line = 0; line < 5; ++line) {
            const auto end = [&] {
                return EnchanterPlace{layout.extentWidthMetres * random.uniform(-1, 2),
                                      layout.extentHeightMetres * random.uniform(-1, 2),
                                      layout.extentWidthMetres * random.uniform(-1.5, 1.5)};
            };
            const auto from = end(), to = end();
            const PhantomPanner panner = pannerOf(layout);
            PhantomPanner::Gains before{};
            for (int i = 0; i <= steps; ++i) {
                const double t = static_cast<double>(i) / steps;
                const auto gains = gainsFor(panner, eventAt(std::lerp(from.xMetres, to.xMetres, t),
                                                            std::lerp(from.yMetres, to.yMetres, t),
                                                            std::lerp(from.zMetres, to.zMetres, t)));
                for (std::size_t j = 0; i > 0 && j < gains.size(); ++j)
                    ASSERT_NEAR(gains[j], before[j], 0.05) << "a share's root may begin steeply";
                before = gains;
            }
        }
}

TEST(SpacePanner, APartPlaysOnItsActuatorsAlone) {
    const PhantomPanner glove = pannerOf(preset("glove5"));
    for (std::size_t finger = 0; finger < 5; ++finger) {
        const auto gains = gainsFor(
            glove, eventAt(0.3, -0.1, 0.2, std::array{"thumb", "index", "middle", "ring", "little"}[finger]));
        for (std::size_t j = 0; j < 5; ++j) EXPECT_EQ(gains[j], j == finger ? 1.0 : 0.0);
    }
    // the chest alone is a grid in a plane: only the four around the place take part, whatever its depth
    const PhantomPanner vest = pannerOf(preset("vest16"));
    const auto gains = gainsFor(vest, eventAt(0.05, 0.33, 0.11, "chest"));
    EXPECT_NEAR(gains[0], std::sqrt(0.75 * 0.75), 1e-12);
    EXPECT_NEAR(gains[1], std::sqrt(0.25 * 0.75), 1e-12);
    EXPECT_NEAR(gains[2], std::sqrt(0.75 * 0.25), 1e-12);
    EXPECT_NEAR(gains[3], std::sqrt(0.25 * 0.25), 1e-12);
    EXPECT_NEAR(energyOf(gains), 1.0, 1e-12);
    for (std::size_t j = 4; j < 16; ++j) EXPECT_EQ(gains[j], 0.0);
}

TEST(SpacePanner, APartInSpaceHasTrianglesOfItsOwn) {
    // two octahedra side by side
    EnchanterLayout both = octahedron();
    both.count = 12;
    for (std::size_t j = 0; j < 6; ++j) {
        both.places[j + 6] = both.places[j];
        both.places[j].part = partNamed("left");
        both.places[j + 6].xMetres += 3.0;
        both.places[j + 6].part = partNamed("right");
    }
    const PhantomPanner alone = pannerOf(octahedron()), pair = pannerOf(both, PanningLaw::triangles);
    const auto expected = gainsFor(alone, eventAt(0.6, 0.7, 0.1)),
               gains = gainsFor(pair, eventAt(3.6, 0.7, 0.1, "right"));
    for (std::size_t j = 0; j < 6; ++j) {
        EXPECT_EQ(gains[j], 0.0);
        EXPECT_NEAR(gains[j + 6], expected[j], 1e-12) << j;
    }
}

TEST(SpacePanner, APartThatNoActuatorHasIsFeltByPlaceAndCounted) {
    const PhantomPanner vest = pannerOf(preset("vest16"));
    const CollisionEvent lost = eventAt(0.05, 0.2, 0.05, "thumb");
    EXPECT_TRUE(vest.lacksPartOf(lost));
    EXPECT_FALSE(vest.lacksPartOf(eventAt(0.05, 0.2, 0.05, "back")));
    EXPECT_FALSE(vest.lacksPartOf(eventAt(0.05, 0.2, 0.05)));
    EXPECT_EQ(gainsFor(vest, lost), gainsFor(vest, eventAt(0.05, 0.2, 0.05)));

    auto events = test::randomEvents(3, 0.001, 1);
    events[1].source.part = partNamed("thumb");
    events[2].source.part = partNamed("chest");
    const auto rendered = test::renderEvents(events, {.channels = 16, .panner = vest}, 480);
    EXPECT_EQ(rendered.status.played, 3U);
    EXPECT_EQ(rendered.status.withoutPart, 1U);
}

TEST(SpacePanner, PlanesIgnoreDepthAndDistanceIsAvailableThere) {
    EnchanterLayout raised = preset("phone4");
    for (auto& place : raised.places) place.zMetres = 0.3;
    const PhantomPanner flat = pannerOf(preset("phone4")), up = pannerOf(raised);
    const auto gains = gainsFor(flat, eventAt(0.03, 0.02, 0.0));
    EXPECT_EQ(gainsFor(flat, eventAt(0.03, 0.02, 0.7)), gains);
    EXPECT_EQ(gainsFor(up, eventAt(0.03, 0.02, -0.7)), gains);
    const auto near = gainsFor(pannerOf(preset("phone4"), PanningLaw::distance), eventAt(0.06, 0.03, 0.0));
    for (std::size_t j = 0; j < 4; ++j) EXPECT_NEAR(near[j], 0.5, 1e-12);
}

TEST(SpacePanner, DepthIsScaledAsWidthIs) {
    const auto layout = preset("sleeve8");
    const PhantomPanner panner{layout, PanningLaw::automatic, 1.0, 10.0 * layout.extentWidthMetres,
                               3.0 * layout.extentHeightMetres};
    const auto& at = layout.places[6];
    const auto gains = gainsFor(panner, eventAt(10.0 * at.xMetres, 3.0 * at.yMetres, 10.0 * at.zMetres));
    EXPECT_NEAR(gains[6], 1.0, 1e-7);
}

// Rows, grids and belts in any plane or on any line of space, and parts of the body that have one.

using Places = std::vector<ActuatorPlace>;

ActuatorLayout layoutAt(const Places& places) {
    ActuatorLayout layout{1.0, 1.0, static_cast<int>(places.size()), {}};
    std::copy(places.begin(), places.end(), layout.places.begin());
    return layout;
}

PhantomPanner pannerOn(const Places& places, PanningLaw law = PanningLaw::automatic) {
    return {layoutAt(places), law, 1.0, 1.0, 1.0};
}

PhantomPanner::Gains gainsAtPlace(const PhantomPanner& panner, const ActuatorPlace& at, PartNumber part = 0) {
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
                const auto gains = gainsAtPlace(panner, frame.at(p, random.uniform(-1, 1)));
                EXPECT_NEAR(distance(centroidOf(places, gains), frame.at(p)), 0.0, 1e-9) << flat.size();
                double energy = 0.0;
                for (const double gain : gains) energy += gain * gain;
                EXPECT_NEAR(energy, 1.0, 1e-9);
            }
            for (std::size_t j = 0; j < places.size(); ++j)
                EXPECT_NEAR(gainsAtPlace(panner, places[j])[j], 1.0, 1e-6) << flat.size() << ' ' << j;
        }
}

TEST(TiltedCells, PlanesOfTwoAxesPanAsThatOfXAndY) {
    const Frame ahead{{}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}}, aside{{}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    for (const Places& flat : {row(8), grid(4, 2), belt(4), belt(8)})
        for (const Frame& frame : {ahead, aside}) {
            const PhantomPanner there = pannerOn(frame.of(flat)), here = pannerOn(flat);
            for (const ActuatorPlace p : {ActuatorPlace{0.21, 0.13}, {0.8, 0.4}, {-0.3, 0.9}}) {
                const auto expected = gainsAtPlace(here, p), gains = gainsAtPlace(there, frame.at(p));
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
    const auto gains = gainsAtPlace(pannerOn(upright, PanningLaw::triangles), upright[1]);
    EXPECT_NEAR(gains[1], 1.0, 1e-6);
    EXPECT_EQ(gainsAtPlace(pannerOn(upright), {0.3, 0.2, 0.03}),
              gainsAtPlace(pannerOn(upright, PanningLaw::neighbours), {0.3, 0.2, 0.03}));
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
    const auto gains = gainsAtPlace(panner, between, partNamed("index"));
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
