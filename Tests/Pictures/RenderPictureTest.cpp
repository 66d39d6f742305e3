// SPDX-License-Identifier: MIT
#include "Pictures/RenderPicture.h"
#include "Core/EventShaping.h"
#include "Pictures/Palette.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <png.h>
#include <random>

namespace physvib::render_picture_test {

namespace palette = picture::palette;
using picture::Area;
using picture::Colour;
using picture::Image;

constexpr int rateHz = 8000;
constexpr double seconds = 1.0;

/// A render to be drawn, with everything it refers to.
struct Render {
    Scene scene;
    std::vector<CollisionEvent> events;
    WaveformEnvelope waveform;
    WaveformEnvelope zoom;
    PictureInput input;

    Render(int channels, int hits)
        : events(someHits(hits))
        , waveform(channels, 0, rateHz)
        , zoom(zoomOf(channels, events)) {
        scene.materials = {{"steel", 7800.0, 0.2, 0.5, 430.0, 11.97},
                           {"rubber", 1100.0, 0.6, 0.5, 80.0, 34.13}};
        scene.bodies = {
            {"floor", BodyType::staticBody, {{BoxShape{4.0, 0.1}, {}, 0.0, 0, true}}, {2.0, 0.05}},
            {"ball", BodyType::dynamicBody, {{CircleShape{0.3}, {}, 0.0, 1}}, {1.0, 1.0}}};
        fillLayout(channels);
        addSound(channels);
        input.title = "A render";
        input.fieldWidthMetres = 4.0;
        input.fieldHeightMetres = 2.0;
        input.scene = &scene;
        input.events = events;
        input.waveform = &waveform;
        input.zoom = &zoom;
        input.sampleRateHz = rateHz;
        input.durationSeconds = seconds;
    }
    Render(const Render&) = delete;

private:
    static std::vector<CollisionEvent> someHits(int count) {
        std::mt19937 random(1);
        const auto share = [&] { return static_cast<double>(random()) / 4294967296.0; };
        std::vector<CollisionEvent> hits;
        for (int i = 0; i < count; ++i) {
            CollisionEvent hit;
            hit.timeNs = static_cast<std::int64_t>(share() * 0.9e9);
            hit.frequencyHz = 430.0;
            hit.decayPerSecond = 11.97;
            hit.amplitude = 0.9 * share();
            hit.x = 4.0 * share();
            hit.y = 2.0 * share();
            hit.source.fixture = 0;
            hit.source.other = 1;
            hits.push_back(hit);
        }
        return hits;
    }
    static WaveformEnvelope zoomOf(int channels, const std::vector<CollisionEvent>& hits) {
        const auto window = zoomWindow(hits, rateHz);
        return {channels, window.firstFrame, window.frameCount};
    }
    void fillLayout(int channels) {
        input.layout.extentWidthMetres = 0.14;
        input.layout.extentHeightMetres = 0.07;
        input.layout.count = channels;
        for (int c = 0; c < channels; ++c)
            input.layout.places[static_cast<std::size_t>(c)] = {0.14 * (c % 8) / 8.0, 0.07 * (c / 8) / 8.0};
    }
    void addSound(int channels) {
        std::vector<float> sound;
        for (int n = 0; n < rateHz; ++n)
            sound.push_back(events.empty() ? 0.0f : 0.5f * std::sin(0.3f * static_cast<float>(n)));
        const std::vector<const float*> block(static_cast<std::size_t>(channels), sound.data());
        waveform.add(block.data(), rateHz);
        zoom.add(block.data(), rateHz);
    }
};

/// Pixels of exactly this colour, and their centre.
struct Found {
    int count = 0;
    double x = 0.0;
    double y = 0.0;
};

constexpr Area worldPanel{24, 120, 760, 500}, lanes{100, 520, 1300, 460};

template <class Is>
Found findIf(Area area, Is is) {
    Found found;
    for (int y = area.y; y < area.bottom(); ++y)
        for (int x = area.x; x < area.right(); ++x) {
            if (!is(x, y)) continue;
            ++found.count;
            found.x += x;
            found.y += y;
        }
    if (found.count > 0) found.x /= found.count, found.y /= found.count;
    return found;
}
Found find(const Image& image, Colour colour, Area area) {
    return findIf(area, [&](int x, int y) { return image.at(x, y) == colour; });
}
Found differing(const Image& a, const Image& b, Area area) {
    return findIf(area, [&](int x, int y) { return a.at(x, y) != b.at(x, y); });
}

TEST(RenderPicture, StrongestEventIsTheFirstOfEquals) {
    std::vector<CollisionEvent> events(4);
    events[1].amplitude = 0.2;
    events[2].amplitude = -0.5; // polarity is no strength
    events[3].amplitude = 0.5;
    EXPECT_EQ(strongestEvent(events), &events[2]);
    EXPECT_EQ(strongestEvent({}), nullptr);
}

TEST(RenderPicture, ZoomIsAroundTheStrongestOnset) {
    std::vector<CollisionEvent> events(2);
    events[1].timeNs = 500'000'000;
    events[1].amplitude = 0.5;
    EXPECT_EQ(zoomWindow(events, 48000).firstFrame, 24000 - 480);
    EXPECT_EQ(zoomWindow(events, 48000).frameCount, 4800);
    EXPECT_EQ(zoomWindow({}, 48000).frameCount, 0);
}

TEST(RenderPicture, SameInputSameBytes) {
    const Render one(4, 300), same(4, 300), different(4, 299);
    EXPECT_EQ(picturePng(one.input), picturePng(same.input));
    EXPECT_NE(picturePng(one.input), picturePng(different.input));
}

TEST(RenderPicture, IsAPngOfTheAgreedSize) {
    const auto bytes = picturePng(Render(4, 10).input);
    png_image head{};
    head.version = PNG_IMAGE_VERSION;
    ASSERT_TRUE(png_image_begin_read_from_memory(&head, bytes.data(), bytes.size())) << head.message;
    EXPECT_EQ(head.width, 1600u);
    EXPECT_EQ(head.height, 1000u);
    head.format = PNG_FORMAT_RGB;
    std::vector<std::uint8_t> rgb(PNG_IMAGE_SIZE(head));
    ASSERT_TRUE(png_image_finish_read(&head, nullptr, rgb.data(), 0, nullptr)) << head.message;
    const auto image = drawPicture(Render(4, 10).input);
    const std::size_t place = 3 * (600 * 1600 + 300);
    EXPECT_EQ(image.at(300, 600), (Colour{255, rgb[place], rgb[place + 1], rgb[place + 2]}));
    EXPECT_EQ(bytes.find("tIME"), std::string::npos); // no clock in it
}

// Whatever the input, the frame around the panels stays empty: nothing runs out of the picture.
TEST(RenderPicture, NothingLeavesThePage) {
    for (const int channels : {1, 4, 16, 64})
        for (const int hits : {0, 1, 20000}) {
            Render render(channels, hits);
            render.input.title = render.input.subtitle = render.input.provenance = std::string(500, 'W');
            render.input.labels.assign(static_cast<std::size_t>(channels), std::string(40, 'W'));
            render.scene.materials[0].name = render.scene.materials[1].name = render.scene.bodies[0].name =
                std::string(300, 'W');
            render.input.law = std::string(300, 'W');
            const auto image = drawPicture(render.input);
            const auto inside = image.bounds().reduced(22, 0);
            const int emptyLeft = find(image, palette::ground, image.bounds().withRight(inside.x)).count;
            const int emptyRight =
                find(image, palette::ground, image.bounds().withLeft(inside.right())).count;
            EXPECT_EQ(emptyLeft, 22 * 1000) << channels << " channels, " << hits << " hits";
            EXPECT_EQ(emptyRight, 22 * 1000) << channels << " channels, " << hits << " hits";
        }
}

TEST(RenderPicture, EveryChannelHasALaneInItsColour) {
    for (const int channels : {1, 4, 8, 16}) {
        const auto image = drawPicture(Render(channels, 10).input);
        double above = 0.0;
        for (int c = 0; c < channels; ++c) {
            const auto lane = find(image, palette::actuator(c), lanes);
            EXPECT_GT(lane.count, 600) << c;
            EXPECT_GT(lane.y, above) << c; // in channel order, top to bottom
            above = lane.y;
        }
    }
}

// The middle of the strongest hit is white; the field's y points up.
TEST(RenderPicture, StrongestHitIsMarkedWhereItStruck) {
    const auto markOf = [](double x, double y) {
        Render render(1, 1);
        render.input.scene = nullptr;
        render.events[0].x = x;
        render.events[0].y = y;
        render.input.events = render.events;
        return find(drawPicture(render.input), palette::white, worldPanel);
    };
    const auto low = markOf(1.0, 0.5), right = markOf(3.0, 0.5), high = markOf(1.0, 1.5);
    ASSERT_GT(low.count, 9);
    EXPECT_NEAR(right.y, low.y, 0.6);
    EXPECT_NEAR(high.x, low.x, 0.6);
    EXPECT_GT(right.x, low.x + 100.0);
    EXPECT_NEAR(low.y - high.y, 0.5 * (right.x - low.x), 1.5); // to scale: 1 m up, 2 m to the right
}

TEST(RenderPicture, WeakerHitsGlowAtTheirPlaces) {
    const auto glowOf = [](double x) {
        Render one(1, 2), without(1, 2);
        one.events[0].amplitude = without.events[0].amplitude = 1.0;
        one.events[1].amplitude = 0.3;
        one.events[1].x = x;
        one.events[1].y = 1.0;
        without.events.resize(1);
        without.input.events = without.events;
        return differing(drawPicture(one.input), drawPicture(without.input), {24, 130, 760, 370});
    };
    const auto left = glowOf(1.5), right = glowOf(3.0);
    EXPECT_GT(left.count, 100);
    EXPECT_GT(right.count, 100);
    EXPECT_GT(right.x, left.x + 100.0);
}

TEST(RenderPicture, WhatCompensatesTheMeanOfAHitIsNoHit) {
    Render render(1, 2);
    auto& hit = render.events[0];
    hit.frequencyHz = 80.0, hit.decayPerSecond = 34.0, hit.amplitude = 1.0;
    const auto png = drawPicture(render.input).png();
    render.events.push_back(meanCompensation(render.events[0]));
    ASSERT_TRUE(isMeanCompensation(render.events.back()));
    render.input.events = render.events;
    EXPECT_TRUE(drawPicture(render.input).png() == png) << "neither counted nor drawn";
}

TEST(RenderPicture, StemsStandAtTheirTimes) {
    const auto stemAt = [](std::int64_t timeNs) {
        Render render(1, 1);
        render.events[0].timeNs = timeNs;
        return find(drawPicture(render.input), palette::highlight, {90, 842, 1380, 80}).x;
    };
    const double laneWidth = stemAt(1'000'000'000) - stemAt(0);
    EXPECT_GT(laneWidth, 1200.0);
    EXPECT_NEAR(stemAt(250'000'000) - stemAt(0), 0.25 * laneWidth, 1.0);
}

TEST(RenderPicture, BodiesStandWhereTheMarksSay) {
    const auto ballAt = [](std::vector<BodyPose> bodies) {
        Render render(1, 0);
        render.input.poses.bodies = std::move(bodies);
        return find(drawPicture(render.input), palette::material(1).withMultipliedBrightness(0.9f),
                    worldPanel);
    };
    const auto start = ballAt({}), moved = ballAt({{2.0, 0.05, 0.0}, {3.0, 1.0, 0.0}});
    ASSERT_GT(start.count, 100);
    EXPECT_GT(moved.x, start.x + 100.0);
    EXPECT_NEAR(moved.y, start.y, 0.6);
}

TEST(RenderPicture, JointsAreDrawnWhereTheyAreNow) {
    const auto changedBy = [](const Joint& joint, bool hasPoses) {
        Render bare(1, 0), joined(1, 0);
        joined.scene.joints = {{"joint", "floor", "ball", joint}};
        if (hasPoses) {
            bare.input.poses.bodies = joined.input.poses.bodies = {{2.0, 0.05, 0.0}, {1.0, 1.0, 0.0}};
            joined.input.poses.joints = {{joint, {3.0, 1.5}, {3.5, 1.5}}};
        }
        const Image without = drawPicture(bare.input), with = drawPicture(joined.input);
        Area right = worldPanel;
        const Area left = right.removeFromLeft(380);
        return std::array{differing(with, without, left).count, differing(with, without, right).count};
    };
    const DistanceJoint rod{{0.5, 1.5}, {1.0, 1.0}}, spring{{0.5, 1.5}, {1.0, 1.0}, 2.0};
    const auto drawn = changedBy(rod, false), moved = changedBy(rod, true), coil = changedBy(spring, false);
    EXPECT_GT(drawn[0], 100);
    EXPECT_EQ(drawn[1], 0) << "as described";
    EXPECT_EQ(moved[0], 0);
    EXPECT_GT(moved[1], 100) << "where it is now";
    EXPECT_GT(coil[0], drawn[0]);
    const RevoluteJoint hinge{{1.0, 1.0}};
    RevoluteJoint motor = hinge;
    motor.maxTorqueNewtonMetres = 1.0;
    EXPECT_GT(changedBy(motor, false)[0], changedBy(hinge, false)[0]);
}

TEST(RenderPicture, BodiesThatAreNotThereAreNotDrawn) {
    const auto ballIn = [](Render& render) {
        return find(drawPicture(render.input), palette::material(1).withMultipliedBrightness(0.9f),
                    worldPanel)
            .count;
    };
    Render render(1, 0);
    EXPECT_GT(ballIn(render), 100);
    render.input.poses.bodies = {{2.0, 0.05, 0.0}, {1.0, 1.0, 0.0, false}};
    EXPECT_EQ(ballIn(render), 0);
    render.input.poses.bodies.clear();
    render.scene.script = {{1.0, 1, 0.0, SpawnAction{render.scene.bodies[1], {}}}};
    render.scene.bodies.pop_back();
    EXPECT_EQ(ballIn(render), 0);
}

TEST(RenderPicture, EveryFixtureOfABodyIsDrawnWhateverItsShape) {
    const auto pixelsOf = [](Shape shape, double offset, double angle = 0.0, double ownAngle = 0.0) {
        Render render(1, 0);
        auto& body = render.scene.bodies[1];
        body.type = BodyType::staticBody;
        body.angleRadians = angle;
        body.fixtures.push_back({std::move(shape), {offset, 0.0}, ownAngle, 0});
        render.scene.bodies.erase(render.scene.bodies.begin());
        return find(drawPicture(render.input), palette::material(0).withMultipliedBrightness(0.6f),
                    worldPanel);
    };
    const PolygonShape wedge{{{0.0, 0.0}, {1.0, 0.0}, {1.0, 0.5}}};
    const auto near = pixelsOf(wedge, 0.5), far = pixelsOf(wedge, 1.5);
    EXPECT_GT(near.count, 1000);
    EXPECT_NEAR(static_cast<double>(far.count), static_cast<double>(near.count), 0.05 * near.count);
    EXPECT_GT(far.x, near.x + 100.0);
    const auto chain = pixelsOf(ChainShape{{{2.0, 0.5}, {0.0, 0.5}}}, 0.5);
    EXPECT_GT(chain.count, 300);
    EXPECT_LT(chain.count, near.count);
    EXPECT_LT(chain.y, near.y); // 0.5 m up
    EXPECT_LT(pixelsOf(wedge, 0.0, 1.57).y, near.y - 50.0) << "turned to the left: up";
    EXPECT_LT(pixelsOf(wedge, 0.0, 0.0, 1.57).y, near.y - 50.0);
}

TEST(RenderPicture, EmptyInputIsAPictureToo) {
    EXPECT_EQ(drawPicture({}).width(), 1600);
    Render render(2, 5);
    render.input.scene = nullptr;
    EXPECT_EQ(drawPicture(render.input).width(), 1600);
    render.input.waveform = render.input.zoom = nullptr;
    EXPECT_EQ(drawPicture(render.input).width(), 1600);
    render.input.durationSeconds = render.input.fieldWidthMetres = 0.0;
    EXPECT_EQ(drawPicture(render.input).width(), 1600);
}

TEST(RenderPicture, WithoutFontsTheRestIsThere) {
    const picture::Letters none{{}}, some;
    ASSERT_TRUE(none.empty());
    ASSERT_FALSE(some.empty());
    const Render render(4, 30);
    const auto silent = drawPicture(render.input, none), worded = drawPicture(render.input, some);
    EXPECT_GT(find(silent, palette::actuator(3), lanes).count, 600);
    const Area title{24, 16, 300, 36};
    EXPECT_EQ(find(silent, palette::ground, title).count, 300 * 36);
    EXPECT_LT(find(worded, palette::ground, title).count, 300 * 36);
}

// A wave has thousands of corners, more than FreeType's rasteriser holds at once.
TEST(RenderPicture, ALoudWaveIsFilledFromItsTopToItsBottom) {
    const auto image = drawPicture(Render(1, 10).input);
    const auto lane = find(image, palette::actuator(0), lanes);
    EXPECT_GT(lane.count, 1300 * 15);
}

} // namespace physvib::render_picture_test
