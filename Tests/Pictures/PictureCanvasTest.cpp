// SPDX-License-Identifier: MIT
#include "Pictures/PictureCanvas.h"
#include "Core/EnchanterLayout.h"
#include "Pictures/PictureParts.h"
#include <algorithm>
#include <gtest/gtest.h>

namespace physvib::picture {
namespace {

const std::string minus = "\xe2\x88\x92";

TEST(PictureCanvas, NumbersAreGroupedAndSigned) {
    EXPECT_EQ(number(1234567.0, 0), "1,234,567");
    EXPECT_EQ(number(-48000.25, 1), minus + "48,000.2");
    EXPECT_EQ(number(999.0, 2), "999.00");
    EXPECT_EQ(number(-0.001, 1), "0.0"); // no minus zero
}

TEST(PictureCanvas, ShortNumbersDropWhatSaysNothing) {
    EXPECT_EQ(shortNumber(349.2), "349");
    EXPECT_EQ(shortNumber(11.97), "12");
    EXPECT_EQ(shortNumber(6.4), "6.4");
    EXPECT_EQ(shortNumber(0.07), "0.07");
    EXPECT_EQ(shortNumber(80.0), "80");
    EXPECT_EQ(shortNumber(0.0), "0");
    EXPECT_EQ(shortNumber(1000.0), "1,000");
}

TEST(PictureCanvas, WhatHasFallenBy140dBIsSilent) {
    EXPECT_EQ(decibelText(0.5), minus + "6.0 dBFS");
    EXPECT_EQ(decibelText(-1.0), "0.0 dBFS");
    EXPECT_EQ(decibelText(0.99e-7), "silent");
    EXPECT_EQ(decibelText(0.0), "silent");
}

TEST(PictureCanvas, TicksAreRoundAndFew) {
    EXPECT_EQ(ticks(0.0, 10.0, 12), (std::vector<double>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10}));
    EXPECT_EQ(ticks(-10.0, 90.0, 5), (std::vector<double>{0, 20, 40, 60, 80}));
    EXPECT_EQ(ticks(-9.999, 90.001, 10).front(), -10.0); // an edge between two frames keeps its tick
    for (const double to : {0.03, 0.9, 7.0, 61.0, 3600.0, 1e6})
        EXPECT_LE(ticks(0.0, to, 12).size(), 13u) << to;
    EXPECT_EQ(ticks(0.0, 0.0, 12).size(), 1u);
}

TEST(PictureCanvas, WordsThatAreTooLongEndWithDotsAndStayInTheirArea) {
    const Letters letters;
    Image image{400, 40};
    Painter painter{image};
    const Canvas canvas{painter, letters};
    canvas.text(std::string(300, 'W'), {50, 0, 200, 40}, Align::left, palette::white);
    int inside = 0, outside = 0;
    for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 400; ++x)
            if (image.at(x, y) != Colour{255, 0, 0, 0}) ++(x >= 49 && x <= 250 ? inside : outside);
    EXPECT_GT(inside, 300);
    EXPECT_EQ(outside, 0);
    EXPECT_GT(canvas.textWidth("Wide", smallText), canvas.textWidth("ill", smallText));
    EXPECT_EQ(canvas.textWidth("", smallText), 1);
}

TEST(Painter, LinesThatGoNowhereDrawNothing) {
    Image image{20, 20};
    const auto empty = image.at(10, 10);
    Painter painter{image};
    painter.drawLine({10, 10}, {10, 10}, 3.0f);
    Path curve;
    curve.startNewSubPath(10, 10);
    curve.cubicTo({10, 10}, {10, 10}, {10, 10});
    curve.closeSubPath();
    painter.strokePath(curve, 3.0f);
    EXPECT_EQ(image.at(10, 10), empty);
}

TEST(Painter, EdgesAreSmoothAndClipped) {
    Image image{20, 20};
    Painter painter{image};
    painter.setColour(palette::white);
    painter.fillRect({2.5f, 2.0f, 5.0f, 3.0f});
    EXPECT_NEAR(image.at(2, 3).red, 128, 1); // half of it
    EXPECT_EQ(image.at(4, 3).red, 255);
    EXPECT_EQ(image.at(4, 6).red, 0);
    {
        const Painter::ClipScope whole{painter};
        painter.reduceClip({0, 10, 20, 2});
        painter.fillEllipse({-1e9f, -1e9f, 2e9f, 2e9f}); // however large
        EXPECT_EQ(image.at(10, 11).red, 255);
        EXPECT_EQ(image.at(10, 12).red, 0);
    }
    painter.drawLine({1.0f, 15.0f}, {19.0f, 15.0f}, 2.0f);
    EXPECT_EQ(image.at(10, 14).red, 255);
    EXPECT_EQ(image.at(10, 15).red, 255);
    EXPECT_EQ(image.at(10, 13).red, 0);
    EXPECT_EQ(image.at(0, 15).red, 0); // flat ends
}

CollisionEvent sounding(double frequencyHz, double decayPerSecond = 20.0) {
    CollisionEvent event;
    event.frequencyHz = frequencyHz;
    event.decayPerSecond = decayPerSecond;
    event.amplitude = 0.5;
    return event;
}

PictureInput inputOf(std::span<const CollisionEvent> events, const Scene* scene = nullptr) {
    PictureInput input;
    input.events = events;
    input.scene = scene;
    return input;
}

Scene twoMaterials() {
    Scene scene;
    scene.materials = {{"steel", 1.0, 0.0, 0.0, 430.0, 12.0}, {"rubber", 1.0, 0.0, 0.0, 80.0, 34.0}};
    scene.bodies = {{"floor", BodyType::staticBody, {{BoxShape{1.0, 1.0}}}}};
    return scene;
}

TEST(HitColours, TellTheMaterialByItsSound) {
    const auto scene = twoMaterials();
    const std::vector<CollisionEvent> events{sounding(80.0, 34.0), sounding(430.0, 12.0)};
    const HitColours colours(inputOf(events, &scene));
    EXPECT_EQ(colours.colourOf(events[0]), palette::material(1));
    EXPECT_EQ(colours.colourOf(events[1]), palette::material(0));
    ASSERT_EQ(colours.classes().size(), 3u); // and the strongest
    EXPECT_EQ(colours.classes()[0].name, "steel 430 Hz");
    EXPECT_EQ(colours.classes()[1].name, "rubber 80 Hz");
    EXPECT_STREQ(colours.meaning(), "material");
}

TEST(HitColours, ASoundOfNoMaterialIsOther) {
    const auto scene = twoMaterials();
    const std::vector<CollisionEvent> events{sounding(430.0, 13.0)}; // another decay
    const HitColours colours(inputOf(events, &scene));
    EXPECT_EQ(colours.colourOf(events[0]), palette::grey);
    EXPECT_EQ(colours.classes()[1].name, "other");
}

TEST(HitColours, MaterialsThatDoNotOccurAreNotExplained) {
    const auto scene = twoMaterials();
    ASSERT_EQ(HitColours(inputOf({}, &scene)).classes().size(), 1u); // the floor's
}

TEST(HitColours, OfAGloveTellTheFinger) {
    std::vector<CollisionEvent> events{sounding(205.0), sounding(205.0)};
    events[0].source.part = partNamed("middle"), events[1].source.part = partNamed("thumb");
    PictureInput input = inputOf(events);
    input.layout.count = static_cast<int>(gloveTips.size());
    std::ranges::copy(gloveTips, input.layout.places.begin());
    const HitColours colours(input);
    EXPECT_EQ(colours.colourOf(events[0]), palette::actuator(2));
    EXPECT_EQ(colours.colourOf(events[1]), palette::actuator(0));
    EXPECT_EQ(colours.classes()[0].name, "thumb");
    EXPECT_EQ(colours.classes()[1].name, "middle");
    EXPECT_STREQ(colours.meaning(), "part of the body");
    EXPECT_EQ(laneLabel(input, 2), "C middle");
    events[1].source.part = 0; // felt on all
    EXPECT_STREQ(HitColours(input).meaning(), "frequency");
}

TEST(HitColours, WithoutASceneFewFrequenciesAreNamed) {
    const std::vector<CollisionEvent> events{sounding(205.0), sounding(80.0), sounding(205.0)};
    const HitColours colours(inputOf(events));
    ASSERT_EQ(colours.classes().size(), 3u);
    EXPECT_EQ(colours.classes()[0].name, "80 Hz");
    EXPECT_EQ(colours.classes()[1].name, "205 Hz");
    EXPECT_EQ(colours.colourOf(events[0]), colours.classes()[1].colour);
    EXPECT_STREQ(colours.meaning(), "frequency");
}

TEST(HitColours, WithoutASceneManyFrequenciesAreOctaves) {
    std::vector<CollisionEvent> events;
    for (int i = 1; i < 100; ++i) events.push_back(sounding(10.0 * i));
    const HitColours colours(inputOf(events));
    EXPECT_EQ(colours.colourOf(sounding(30.0)), palette::ramp(0));
    EXPECT_EQ(colours.colourOf(sounding(205.0)), palette::ramp(3));
    EXPECT_EQ(colours.colourOf(sounding(900.0)), palette::ramp(5));
    EXPECT_EQ(colours.classes().size(), 7u);
}

} // namespace
} // namespace physvib::picture
