// SPDX-License-Identifier: GPL-3.0-or-later
// What is seen is what is felt at that time: poses wait as long as the samples that were made of them.
#include "Host/Views/WorldPictures.h"
#include "MixerTesting.h"
#include "Stimuli/SeededRandom.h"
#include <cmath>
#include <gtest/gtest.h>

namespace physvib::world_view_test {

TEST(WorldView, ABodyIsSeenWhereItIsWhenThatIsFelt) {
    Scene scene;
    scene.fieldWidthMetres = 10.0;
    scene.fieldHeightMetres = 10.0;
    scene.bodies.emplace_back().name = "ball";
    WorldView view;
    view.setSize(600, 600);
    view.show(scene);
    constexpr std::int64_t ms = 1'000'000, stepNs = 10 * ms, aheadNs = 55 * ms;
    for (std::int64_t now = 0; now < 1'000 * ms; now += stepNs) { // it goes at 5 m/s
        view.update({{BodyPose{5e-9 * static_cast<double>(now), 5.0}}, now, aheadNs, {}, {}});
        // the last step before what is felt
        const std::int64_t felt = std::max<std::int64_t>(0, (now - aheadNs) / stepNs * stepNs);
        EXPECT_NEAR(view.pixelOfBody("ball").x,
                    view.pixelOfShare({0.5e-9 * static_cast<double>(felt), 0.5}).x, 1e-3)
            << "at " << now / ms << " ms";
    }
}

// At once its middle is white; the ring of one that is silenced is empty.
TEST(WorldView, AGlowIsOfWhatIsFelt) {
    Mix mix = MixerModel::defaultMix();
    Scene scene = *mix.scene;
    scene.bodies.clear();
    WorldView view;
    view.setSize(600, 400);
    view.show(scene);
    const CollisionEvent hit{.frequencyHz = 200.0,
                             .decayPerSecond = 50.0,
                             .amplitude = 1.0,
                             .x = 0.5 * scene.fieldWidthMetres,
                             .y = 0.5 * scene.fieldHeightMetres};
    double nowMs = 0.0;
    const auto glows = [&](bool isFelt, std::vector<bool> muted) {
        view.show(mix.layout, mix.panner(), std::move(muted));
        nowMs += 500.0; // longer than one is seen
        view.update({{}, 0, 0, std::span{&hit, 1}, {}, isFelt, nowMs});
        const auto at = view.pixelOfShare({0.5, 0.5}).toInt();
        return view.createComponentSnapshot(view.getLocalBounds()).getPixelAt(at.x, at.y).getBrightness() >
               0.9f;
    };
    EXPECT_TRUE(glows(true, {}));
    EXPECT_TRUE(glows(true, {true, true, true, false})) << "D plays it";
    EXPECT_FALSE(glows(true, {true, true, true, true}));
    EXPECT_FALSE(glows(false, {})) << "all is silent";
}

TEST(WorldView, AnActuatorWithoutAnOutputLooksOtherwiseThanAMutedOneAndThanOneThatPlays) {
    const Mix mix = MixerModel::defaultMix();
    WorldView view;
    view.setSize(600, 400);
    view.show(*mix.scene);
    const auto badge = [&](std::vector<bool> muted, std::vector<bool> without) {
        view.show(mix.layout, mix.panner(), std::move(muted), std::move(without));
        const auto picture = view.createComponentSnapshot(view.badgeAt(1).expanded(2.0f).toNearestInt());
        std::vector<float> light; // shape, not colour
        for (int y = 0; y < picture.getHeight(); ++y)
            for (int x = 0; x < picture.getWidth(); ++x)
                light.push_back(picture.getPixelAt(x, y).getBrightness());
        return light;
    };
    const auto differ = [](const std::vector<float>& a, const std::vector<float>& b) {
        int count = 0;
        for (std::size_t k = 0; k < a.size(); ++k) count += std::abs(a[k] - b[k]) > 0.1f ? 1 : 0;
        return count;
    };
    const auto plays = badge({}, {}), muted = badge({false, true}, {}),
               without = badge({false, true}, {false, true});
    EXPECT_GT(differ(muted, without), 10); // broken edge, no strokes
    EXPECT_GT(differ(plays, without), 30);
    EXPECT_GT(differ(plays, muted), 30);
}

// A small disc that is copied looks as one that is drawn, wherever it lies.

constexpr int sidePixels = 40;
const DiscPictures::Disc orangeBall{5.3f, juce::Colours::orange, juce::Colours::black.withAlpha(0.45f),
                                    juce::Colours::yellow};

template <class Draw>
juce::Image makeBall(float scale, Draw draw) {
    const int pixels = juce::roundToInt(scale * sidePixels);
    const juce::Image image{juce::Image::RGB, pixels, pixels, true, juce::SoftwareImageType{}};
    juce::Graphics g{image};
    g.addTransform(juce::AffineTransform::scale(scale));
    g.setImageResamplingQuality(juce::Graphics::lowResamplingQuality);
    draw(g);
    return image;
}

juce::Image ballByHand(float scale, juce::Point<float> at, float angle) {
    return makeBall(scale, [&](juce::Graphics& g) {
        const auto place = juce::AffineTransform::rotation(angle).translated(at);
        juce::Path disc, spoke;
        disc.addEllipse(-orangeBall.radius, -orangeBall.radius, 2.0f * orangeBall.radius,
                        2.0f * orangeBall.radius);
        spoke.startNewSubPath(0.0f, 0.0f);
        spoke.lineTo(0.9f * orangeBall.radius, 0.0f);
        g.setColour(orangeBall.fill);
        g.fillPath(disc, place);
        g.setColour(orangeBall.spoke);
        g.strokePath(spoke, juce::PathStrokeType{1.5f}, place);
        g.setColour(orangeBall.rim);
        g.strokePath(disc, juce::PathStrokeType{2.0f}, place);
    });
}

/// The mean over pixels and colours of how much they differ, 0 to 255.
double meanDifference(const juce::Image& a, const juce::Image& b) {
    double sum = 0.0;
    for (int y = 0; y < a.getHeight(); ++y)
        for (int x = 0; x < a.getWidth(); ++x) {
            const auto p = a.getPixelAt(x, y), q = b.getPixelAt(x, y);
            sum += std::abs(p.getRed() - q.getRed()) + std::abs(p.getGreen() - q.getGreen()) +
                   std::abs(p.getBlue() - q.getBlue());
        }
    return sum / (3.0 * a.getWidth() * a.getHeight());
}

TEST(BallPictures, LookAsDrawnAtAnyPlaceAngleAndScale) {
    DiscPictures pictures;
    juce::Random random{3};
    for (const float scale : {1.0f, 1.25f, 2.0f})
        for (int k = 0; k < 40; ++k) {
            const juce::Point<float> at{15.0f + 9.0f * random.nextFloat(), 15.0f + 9.0f * random.nextFloat()};
            const float angle = 40.0f * (random.nextFloat() - 0.5f);
            bool isDrawn = false;
            const auto image = makeBall(
                scale, [&](juce::Graphics& g) { isDrawn = pictures.draw(g, orangeBall, at, angle); });
            ASSERT_TRUE(isDrawn);
            const auto wanted = ballByHand(scale, at, angle);
            EXPECT_LT(meanDifference(image, wanted), 1.2)
                << at.toString() << ", " << angle << " at " << scale;
            EXPECT_GT(meanDifference(image, ballByHand(scale, at + juce::Point<float>{1.0f, 0.0f}, angle)),
                      1.5);
        }
}

TEST(BallPictures, ALargeOneIsLeftToBeDrawn) {
    DiscPictures pictures;
    auto large = orangeBall;
    large.radius = 9.0f;
    const auto image = makeBall(2.0f, [&](juce::Graphics& g) {
        EXPECT_FALSE(pictures.draw(g, large, {20.0f, 20.0f}, 0.0f));
    });
    EXPECT_EQ(meanDifference(image, makeBall(2.0f, [](juce::Graphics&) {})), 0.0);
}

TEST(GlowPictures, LookAsTheirGradient) {
    GlowPictures pictures;
    for (const float scale : {1.0f, 1.25f, 2.0f})
        for (const float radius : {8.0f, 13.0f, 16.0f}) {
            const juce::Point<float> at{20.3f, 19.6f}, edge{at.x + radius, at.y};
            const auto colour = juce::Colours::orange.withAlpha(0.6f);
            const auto drawn =
                makeBall(scale, [&](juce::Graphics& g) { pictures.draw(g, at, radius, colour); });
            const auto wanted = makeBall(scale, [&](juce::Graphics& g) {
                g.setGradientFill({colour, at, colour.withAlpha(0.0f), edge, true});
                g.fillAll();
            });
            const double light = meanDifference(wanted, makeBall(scale, [](juce::Graphics&) {}));
            EXPECT_LT(meanDifference(drawn, wanted), 0.2 * light) << radius << " at " << scale;
        }
}

// Badges of actuators can be read and pressed, however many there are and wherever they are.

using namespace test;
using Places = std::vector<juce::Point<float>>;

const juce::Rectangle<float> room{4.0f, 4.0f, 560.0f, 300.0f};

void expectApart(const std::vector<juce::Rectangle<float>>& badges, juce::Rectangle<float> in,
                 const std::string& what) {
    for (std::size_t i = 0; i < badges.size(); ++i) {
        EXPECT_TRUE(in.expanded(0.01f).contains(badges[i])) << what << ": " << i;
        EXPECT_GE(badges[i].getHeight(), minBadgeHeight) << what;
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
            expectApart(layOutBadges(grid(count, room.reduced(60.0f, 40.0f)), widths, room), room,
                        std::to_string(count) + " of " + std::to_string(words));
        }
}

TEST(Badges, OfOnePlaceLieBesideEachOther) {
    const Places places(64, room.getCentre());
    expectApart(layOutBadges(places, std::vector<float>(64, 25.0f), room), room, "in the middle");
    expectApart(layOutBadges(Places(16, room.getTopLeft()), std::vector<float>(16, 200.0f), room), room,
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
        expectApart(layOutBadges(any, widths, room), room, "random " + std::to_string(k));
    }
}

TEST(Badges, StayWhereTheirActuatorsAreWhereThereIsRoom) {
    const auto places = grid(16, room.reduced(40.0f));
    const auto badges = layOutBadges(places, std::vector<float>(16, 20.0f), room);
    for (std::size_t j = 0; j < 16; ++j) {
        EXPECT_NEAR(badges[j].getCentreX(), places[j].x, 0.5f);
        EXPECT_NEAR(badges[j].getCentreY(), places[j].y, 0.5f);
        EXPECT_EQ(badges[j].getHeight(), maxBadgeHeight);
    }
}

TEST(Badges, ALongNameGetsWhatItsNeighbourDoesNotNeed) {
    const Places two{{100.0f, 100.0f}, {170.0f, 100.0f}};
    const auto unlike = layOutBadges(two, std::vector{200.0f, 12.0f}, room),
               alike = layOutBadges(two, std::vector{200.0f, 200.0f}, room);
    EXPECT_EQ(unlike[0].getWidth(), maxBadgeWidth);
    EXPECT_EQ(unlike[1].getWidth(), maxBadgeHeight);
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
    for (const int j : {4, 5}) EXPECT_EQ(world.targetAt(world.badgeAt(j).getCentre()).actuator, j);
    const auto before = world.badgeAt(4);
    view.setSize(1920, 1080);
    EXPECT_NE(world.badgeAt(4), before) << "placed again";
    model.detach(5);
    model.dispatchPendingMessages();
    EXPECT_EQ(world.badgeAt(4).getCentre(), world.actuatorPixel(4));
}

} // namespace physvib::world_view_test
