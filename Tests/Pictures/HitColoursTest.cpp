// SPDX-License-Identifier: MIT
#include "Core/EnchanterLayout.h"
#include "Pictures/PictureParts.h"
#include <algorithm>
#include <gtest/gtest.h>

namespace physvib::picture {
namespace {

CollisionEvent sounding(double frequencyHz, double decayPerSecond = 20.0) {
    CollisionEvent event;
    event.frequencyHz = frequencyHz;
    event.decayPerSecond = decayPerSecond;
    event.amplitude = 0.5;
    return event;
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
    PictureInput input;
    input.scene = &scene;
    input.events = events;
    const HitColours colours(input);
    EXPECT_EQ(colours.of(events[0]), palette::material(1));
    EXPECT_EQ(colours.of(events[1]), palette::material(0));
    ASSERT_EQ(colours.classes().size(), 3u); // and the strongest
    EXPECT_EQ(colours.classes()[0].name, "steel 430 Hz");
    EXPECT_EQ(colours.classes()[1].name, "rubber 80 Hz");
    EXPECT_STREQ(colours.meaning(), "material");
}

TEST(HitColours, ASoundOfNoMaterialIsOther) {
    const auto scene = twoMaterials();
    const std::vector<CollisionEvent> events{sounding(430.0, 13.0)}; // another decay
    PictureInput input;
    input.scene = &scene;
    input.events = events;
    const HitColours colours(input);
    EXPECT_EQ(colours.of(events[0]), palette::other);
    EXPECT_EQ(colours.classes()[1].name, "other");
}

TEST(HitColours, MaterialsThatDoNotOccurAreNotExplained) {
    const auto scene = twoMaterials();
    PictureInput input;
    input.scene = &scene;
    ASSERT_EQ(HitColours(input).classes().size(), 1u); // the floor's
}

TEST(HitColours, OfAGloveTellTheFinger) {
    std::vector<CollisionEvent> events{sounding(205.0), sounding(205.0)};
    events[0].source.part = partNamed("middle"), events[1].source.part = partNamed("thumb");
    PictureInput input;
    input.layout.count = static_cast<int>(gloveTips.size());
    std::ranges::copy(gloveTips, input.layout.places.begin());
    input.events = events;
    const HitColours colours(input);
    EXPECT_EQ(colours.of(events[0]), palette::enchanter(2));
    EXPECT_EQ(colours.of(events[1]), palette::enchanter(0));
    EXPECT_EQ(colours.classes()[0].name, "thumb");
    EXPECT_EQ(colours.classes()[1].name, "middle");
    EXPECT_STREQ(colours.meaning(), "part of the body");
    EXPECT_EQ(laneLabelOf(input, 2), "C middle");
    events[1].source.part = 0; // felt on all
    EXPECT_STREQ(HitColours(input).meaning(), "frequency");
}

TEST(HitColours, WithoutASceneFewFrequenciesAreNamed) {
    const std::vector<CollisionEvent> events{sounding(205.0), sounding(80.0), sounding(205.0)};
    PictureInput input;
    input.events = events;
    const HitColours colours(input);
    ASSERT_EQ(colours.classes().size(), 3u);
    EXPECT_EQ(colours.classes()[0].name, "80 Hz");
    EXPECT_EQ(colours.classes()[1].name, "205 Hz");
    EXPECT_EQ(colours.of(events[0]), colours.classes()[1].colour);
    EXPECT_STREQ(colours.meaning(), "frequency");
}

TEST(HitColours, WithoutASceneManyFrequenciesAreOctaves) {
    std::vector<CollisionEvent> events;
    for (int i = 1; i < 100; ++i) events.push_back(sounding(10.0 * i));
    PictureInput input;
    input.events = events;
    const HitColours colours(input);
    EXPECT_EQ(colours.of(sounding(30.0)), palette::ramp(0));
    EXPECT_EQ(colours.of(sounding(205.0)), palette::ramp(3));
    EXPECT_EQ(colours.of(sounding(900.0)), palette::ramp(5));
    EXPECT_EQ(colours.classes().size(), 7u);
}

} // namespace
} // namespace physvib::picture
