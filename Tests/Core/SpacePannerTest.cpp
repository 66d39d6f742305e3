// SPDX-License-Identifier: MIT
// The laws of a layout's shape: `neighbours` on rows, grids and belts, `triangles` and `distance` in space;
// and events that are bound to a part of a body.
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

namespace physvib::space_panner_test {

ActuatorLayout preset(std::string_view name) {
    ActuatorLayout layout;
    EXPECT_TRUE(layoutPreset(name, layout)) << name;
    return layout;
}

using Places = std::vector<ActuatorPlace>;

ActuatorLayout layoutAt(const Places& places) {
    ActuatorLayout layout{1.0, 1.0, static_cast<int>(places.size()), {}};
    std::copy(places.begin(), places.end(), layout.places.begin());
    return layout;
}

PhantomPanner pannerOf(const ActuatorLayout& layout, PanningLaw law = PanningLaw::automatic) {
    return {layout, law, 1.0, layout.extentWidthMetres, layout.extentHeightMetres};
}

PhantomPanner pannerOn(const Places& places, PanningLaw law = PanningLaw::automatic) {
    return pannerOf(layoutAt(places), law);
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

PhantomPanner::Gains gainsAtPlace(const PhantomPanner& panner, const ActuatorPlace& at,
                                  std::string_view part = {}) {
    PhantomPanner::Gains gains{};
    panner.gainsAt(eventAt(at.xMetres, at.yMetres, at.zMetres, part), gains);
    return gains;
}

double energyOf(const PhantomPanner::Gains& gains) {
    double energy = 0.0;
    for (const double gain : gains) energy += gain * gain;
    return energy;
}

ActuatorPlace centroidOf(const ActuatorLayout& layout, const PhantomPanner::Gains& gains) {
    ActuatorPlace felt;
    for (std::size_t j = 0; j < static_cast<std::size_t>(layout.count); ++j)
        felt = addScaled(felt, layout.places[j], gains[j] * gains[j]);
    return felt;
}

double distance(const ActuatorPlace& a, const ActuatorPlace& b) {
    const ActuatorPlace d = vectorBetween(a, b);
    return std::sqrt(scalarProduct(d, d));
}

ActuatorLayout octahedron() {
    return layoutAt({{0.5, 0.5, 0.5},
                     {0.5, 0.5, -0.5},
                     {0.0, 0.5, 0.0},
                     {1.0, 0.5, 0.0},
                     {0.5, 0.0, 0.0},
                     {0.5, 1.0, 0.0}});
}

Places ellipse(int count, double width, double height) {
    Places places;
    for (int k = 0; k < count; ++k) {
        const double angle = 2 * std::numbers::pi * (k * 3 % count) / count; // not in order
        places.push_back({0.5 + 0.5 * width * std::cos(angle), 0.5 + 0.5 * height * std::sin(angle)});
    }
    return places;
}

const Places unevenRow{{0.3, 0.2}, {0.9, 0.2}, {0.1, 0.2}, {0.45, 0.2}};
const Places slantedRow{{0.1, 0.1}, {0.3, 0.3}, {0.5, 0.5}, {0.9, 0.9}};
const Places unevenGrid{{0.0, 0.0}, {0.2, 0.0}, {1.0, 0.0}, {0.0, 0.3}, {0.2, 0.3}, {1.0, 0.3}};

std::vector<ActuatorLayout> flatShapes() {
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
    ActuatorLayout open = octahedron(); // a shallow bowl: its rim and its bottom
    open.places[0] = open.places[4], open.count = 5;
    open.places[1].zMetres = -0.1, open.places[4] = {0.2, 0.2, 0.0};
    EXPECT_EQ(pannerOf(open).law(), PanningLaw::distance);
}

TEST(SpacePanner, AnActuatorsOwnPlaceIsThatOneAlone) {
    std::vector<PhantomPanner> panners;
    for (const auto& layout : flatShapes()) panners.push_back(pannerOf(layout));
    for (const char* name : {"glove5", "sleeve8", "vest16"})
        for (const PanningLaw law : {PanningLaw::distance, PanningLaw::triangles, PanningLaw::automatic})
            panners.push_back(pannerOf(preset(name), law));
    for (const PhantomPanner& panner : panners)
        for (std::size_t j = 0; j < static_cast<std::size_t>(panner.channels()); ++j) {
            const auto gains = gainsAtPlace(panner, panner.layout().places[j]);
            for (std::size_t k = 0; k < static_cast<std::size_t>(panner.channels()); ++k)
                ASSERT_NEAR(gains[k], j == k ? 1.0 : 0.0, 1e-7) << panner.channels() << ' ' << j << ' ' << k;
        }
}

TEST(SpacePanner, EnergyIsConstantAndTheCentroidIsThePlaceWithinTheShape) {
    test::Random random{7};
    const auto expectWithin = [&](const ActuatorLayout& layout, PanningLaw law, double tolerance) {
        const PhantomPanner panner = pannerOf(layout);
        ASSERT_EQ(panner.law(), law) << layout.count;
        for (int i = 0; i < 1000; ++i) { // between three of the actuators, so within
            ActuatorPlace place;
            double left = 1.0;
            for (int k = 0; k < 3; ++k) {
                const double share = k == 2 ? left : random.uniform(0, left);
                left -= share;
                place = addScaled(
                    place, layout.places[static_cast<std::size_t>(random.uniform(0, layout.count))], share);
            }
            const auto gains = gainsAtPlace(panner, place);
            ASSERT_LE(distance(centroidOf(layout, gains), place), std::sqrt(3.0) * tolerance) << layout.count;
            ASSERT_NEAR(energyOf(gains), 1.0, tolerance) << layout.count;
        }
    };
    for (const auto& layout : {octahedron(), preset("sleeve8"), preset("vest16")})
        expectWithin(layout, PanningLaw::triangles, 1e-12);
    for (const auto& layout : flatShapes()) expectWithin(layout, PanningLaw::neighbours, 1e-9);
}

TEST(SpacePanner, GainsAreContinuousInsideAndOutside) {
    test::Random random{11};
    constexpr int steps = 20'000;
    for (const auto& layout : {octahedron(), preset("sleeve8"), preset("vest16"), preset("glove5")})
        for (int line = 0; line < 5; ++line) {
            const auto end = [&] {
                return ActuatorPlace{layout.extentWidthMetres * random.uniform(-1, 2),
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

// Equation 4.2 on the part alone, which has four on its corners, or on the ends of a line: each fades to
// nothing over the width and the height of its part, whatever those of the layout and of the field are.
TEST(SpacePanner, APartOfAFlatLayoutFadesOverItsOwnWidthAndHeight) {
    const auto factor = [](double metres, double extent) {
        return extent > 0.0 ? 1.0 - std::abs(metres) / extent : 1.0;
    };
    for (const auto& [width, height] :
         {std::pair{0.3, 0.1}, {0.1, 0.4}, {0.3, 0.3}, {0.6, 0.0}, {0.0, 0.2}}) {
        ActuatorLayout layout = layoutAt({{0.2, 0.5},
                                          {0.2 + width, 0.5},
                                          {0.2, 0.5 + height},
                                          {0.2 + width, 0.5 + height},
                                          {0.0, 0.0},
                                          {1.0, 1.0}});
        for (std::size_t j = 0; j < 4; ++j) layout.places[j].part = partNamed("left");
        const PhantomPanner panner{layout, PanningLaw::linear, 1.0, 2.0, 3.0};
        for (const double across : {0.0, 0.25, 1.0})
            for (const double up : {0.0, 0.6, 1.0}) {
                const double x = 0.2 + across * width, y = 0.5 + up * height;
                const auto gains = gainsAtPlace(panner, {2.0 * x, 3.0 * y}, "left");
                for (std::size_t j = 0; j < 6; ++j) {
                    const ActuatorPlace& at = layout.places[j];
                    const double own = factor(x - at.xMetres, width) * factor(y - at.yMetres, height);
                    EXPECT_NEAR(gains[j], j < 4 ? own : 0.0, 1e-12) << width << ' ' << height << ' ' << j;
                }
            }
    }
}

TEST(SpacePanner, APartInSpaceHasTrianglesOfItsOwn) {
    // two octahedra side by side
    ActuatorLayout both = octahedron();
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
    ActuatorLayout raised = preset("phone4");
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

// Energies, since a root is steep at zero. Their slope is at most the reciprocal of the narrowest part of a
// cell, which is 1/63 in the longest row.
TEST(NeighbourCells, NoGainJumpsOnAnyWay) {
    for (const auto& layout : flatShapes()) {
        const PhantomPanner panner = pannerOf(layout);
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
    const auto moved = [](const Places& shape, const ActuatorPlace& from) {
        const auto gains = gainsAtPlace(pannerOn(shape), from);
        EXPECT_NEAR(energyOf(gains), 1.0, 1e-12);
        return centroidOf(layoutAt(shape), gains);
    };
    EXPECT_NEAR(moved(unevenRow, {-3.0, 5.0}).xMetres, 0.1, 1e-12);
    EXPECT_NEAR(distance(moved(unevenGrid, {7.0, 7.0}), {1.0, 0.3}), 0.0, 1e-12);
    const auto belt = moved(ellipse(8, 1.0, 1.0), {0.5 + 3.0 * std::cos(0.3), 0.5 + 3.0 * std::sin(0.3)});
    EXPECT_NEAR(std::atan2(belt.yMetres - 0.5, belt.xMetres - 0.5), 0.3, 1e-9);
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
    std::vector<std::pair<std::string, ActuatorLayout>> layouts{
        {"two of three quarters", layoutAt({{0.1, 0.5}, {0.8, 0.5}})},
        {"a rectangle with a margin", layoutAt({{0.1, 0.1}, {0.8, 0.1}, {0.1, 0.9}, {0.8, 0.9}})},
        {"two at one place", layoutAt({{0.1, 0.5}, {0.1, 0.5}, {0.8, 0.5}})},
        {"all at one place", layoutAt({{0.1, 0.5}, {0.1, 0.5}, {0.1, 0.5}})},
        {"a middle", layoutAt({{0, 0}, {1, 0}, {0, 1}, {1, 1}, {0.5, 0.5}})}};
    for (const auto name : layoutPresetNames)
        if (name.starts_with("phone") || name.starts_with("ring")) layouts.emplace_back(name, preset(name));
    for (const auto& [name, layout] : layouts) {
        PhantomPanner before = pannerOf(layout, PanningLaw::linear);
        before.setGrains(grainSpread);
        const PhantomPanner now = pannerOf(layout);
        EXPECT_EQ(now.law(), PanningLaw::linear) << name;
        EXPECT_EQ(now.grains(), grainSpread) << name;
        EXPECT_EQ(now.travelSpread(), Spread::equal) << name;
        expectSameGains(now, before, name);
    }
}

TEST(NeighbourCells, AnExponentIsThatOfTheLinearLaw) {
    const ActuatorLayout row = test::gridLayout(4, 1);
    const PhantomPanner now{row, PanningLaw::automatic, 2.0, 1.0, 1.0},
        before{row, PanningLaw::linear, 2.0, 1.0, 1.0};
    EXPECT_EQ(now.grains(), Spread::layout);
    expectSameGains(now, before, "row");
}

TEST(NeighbourCells, ThePlacesOfAFileMayBeRounded) {
    Places belt = ellipse(16, 1.0, 1.0), grid = unevenGrid;
    for (auto& p : belt) p = {std::round(p.xMetres * 1000) / 1000, std::round(p.yMetres * 1000) / 1000};
    grid[4].xMetres += 0.0015;
    EXPECT_EQ(pannerOn(belt).law(), PanningLaw::neighbours);
    EXPECT_EQ(pannerOn(grid).law(), PanningLaw::neighbours);
    grid[4].yMetres -= 0.1;
    EXPECT_EQ(pannerOn(grid).law(), PanningLaw::linear);
}

// The law can be named for any layout, and a message or an event can name it too.
TEST(NeighbourCells, TheLawIsEnergyWhereThereAreNoCells) {
    const ActuatorLayout phone3 = preset("phone3");
    expectSameGains(pannerOf(phone3, PanningLaw::neighbours), pannerOf(phone3, PanningLaw::energy), "phone3");
    const PhantomPanner row = pannerOf(test::gridLayout(4, 1), PanningLaw::linear);
    PhantomPanner::Gains named{}, chosen{}, law{};
    row.gainsAt(0.4, 0.5, spreadBy(PanningLaw::neighbours), named);
    row.gainsAt(0.4, 0.5, spreadBy(PanningLaw::automatic), chosen);
    pannerOf(row.layout()).gainsAt(0.4, 0.5, law);
    EXPECT_TRUE(named == law && chosen == law);
    EXPECT_EQ(std::count(law.begin(), law.begin() + 4, 0.0), 2);
}

// Rows, grids and belts in any plane or on any line of space, and parts of the body that have one.

/// A plane's origin and axes.
struct Frame {
    ActuatorPlace origin, right, up;

    ActuatorPlace at(const ActuatorPlace& flat, double off = 0.0) const {
        return addScaled(addScaled(addScaled(origin, right, flat.xMetres), up, flat.yMetres),
                         vectorProduct(right, up), off);
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
    const ActuatorPlace right = normalised(vector());
    return {vector(), right, normalised(vectorProduct(right, vector()))};
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
                const ActuatorPlace p = addScaled(addScaled({}, any(), share), any(), 1.0 - share);
                const auto gains = gainsAtPlace(panner, frame.at(p, random.uniform(-1, 1)));
                EXPECT_NEAR(distance(centroidOf(panner.layout(), gains), frame.at(p)), 0.0, 1e-9)
                    << flat.size();
                EXPECT_NEAR(energyOf(gains), 1.0, 1e-9);
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
    const ActuatorLayout tips = preset("glove5");
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
    const ActuatorPlace between = addScaled(addScaled({}, places[1], 0.7), places[5], 0.3);
    const auto gains = gainsAtPlace(panner, between, "index");
    EXPECT_NEAR(gains[1] * gains[1], 0.7, 1e-9);
    EXPECT_NEAR(gains[5] * gains[5], 0.3, 1e-9);
    for (const std::size_t other : {0U, 2U, 3U, 4U, 6U}) EXPECT_EQ(gains[other], 0.0);
    EXPECT_EQ(pannerOn(places, PanningLaw::distance).pannerOf(partNamed("index")).law(), PanningLaw::distance)
        << "a law that is named holds for parts too";
}

/// As if the actuators of the part were a layout of their own, with that law, that exponent and those grains.
TEST(TiltedCells, WhatIsChosenForALayoutHoldsForItsParts) {
    ActuatorLayout both = layoutAt({{0, 0}, {1, 0}, {0, 1}, {1, 1}, {3, 0}, {4, 0}, {3, 1}, {4, 1}});
    const ActuatorLayout left = layoutAt({{0, 0}, {1, 0}, {0, 1}, {1, 1}});
    for (std::size_t j = 0; j < 8; ++j) both.places[j].part = partNamed(j < 4 ? "left" : "right");
    for (const Spread spread : {Spread::layout, grainSpread, Spread::equal, Spread::nearest})
        for (const auto& law : panningLaws)
            for (const double exponent : {1.0, 2.0}) {
                PhantomPanner whole{both, law.law, exponent, 1.0, 1.0},
                    alone{left, law.law, exponent, 1.0, 1.0};
                if (law.law != PanningLaw::automatic) // which chooses for each part by itself
                    whole.setGrains(spread), alone.setGrains(spread);
                for (const ContactKind kind : {ContactKind::hit, ContactKind::roll, ContactKind::slide}) {
                    CollisionEvent event = eventAt(0.3, 0.6, 0.0, "left");
                    event.source.kind = kind;
                    PhantomPanner::Gains ofPart{}, expected{};
                    whole.gainsAt(event, ofPart);
                    alone.gainsAt(event, expected);
                    EXPECT_EQ(ofPart, expected)
                        << law.name << ' ' << exponent << ", grains " << nameOf(spread);
                }
            }
}

TEST(TiltedCells, KeptPannersOfPartsGiveTheSameGainsAndFollowTheLayout) {
    Places many;
    for (int j = 0; j < 60; ++j)
        many.push_back(
            {0.01 * j, 0.3 * std::sin(j), 0.2 * std::cos(3 * j), partNamed(std::to_string(j / 3))});
    test::Random random{8};
    PartPanners kept, few; // few: prepared for less than there is
    ASSERT_TRUE(kept.prepare(limits::maxActuators) && few.prepare(3));
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

} // namespace physvib::space_panner_test
