// SPDX-License-Identifier: GPL-3.0-or-later
// A small disc that is copied looks as one that is drawn, wherever it lies.
#include "Host/Views/WorldPictures.h"
#include <cmath>
#include <gtest/gtest.h>

namespace physvib {
namespace {

constexpr int sidePixels = 40;
const BallPictures::Ball orangeBall{5.3f, juce::Colours::orange, juce::Colours::black.withAlpha(0.45f),
                                    juce::Colours::yellow};

template <class Draw>
juce::Image drawnBall(float scale, Draw draw) {
    const int pixels = juce::roundToInt(scale * sidePixels);
    const juce::Image image{juce::Image::RGB, pixels, pixels, true, juce::SoftwareImageType{}};
    juce::Graphics g{image};
    g.addTransform(juce::AffineTransform::scale(scale));
    g.setImageResamplingQuality(juce::Graphics::lowResamplingQuality);
    draw(g);
    return image;
}

juce::Image ballByHand(float scale, juce::Point<float> at, float angle) {
    return drawnBall(scale, [&](juce::Graphics& g) {
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
    BallPictures pictures;
    juce::Random random{3};
    for (const float scale : {1.0f, 1.25f, 2.0f})
        for (int k = 0; k < 40; ++k) {
            const juce::Point<float> at{15.0f + 9.0f * random.nextFloat(), 15.0f + 9.0f * random.nextFloat()};
            const float angle = 40.0f * (random.nextFloat() - 0.5f);
            bool isDrawn = false;
            const auto image = drawnBall(
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
    BallPictures pictures;
    auto large = orangeBall;
    large.radius = 9.0f;
    const auto image = drawnBall(2.0f, [&](juce::Graphics& g) {
        EXPECT_FALSE(pictures.draw(g, large, {20.0f, 20.0f}, 0.0f));
    });
    EXPECT_EQ(meanDifference(image, drawnBall(2.0f, [](juce::Graphics&) {})), 0.0);
}

TEST(GlowPictures, LookAsTheirGradient) {
    GlowPictures pictures;
    for (const float scale : {1.0f, 1.25f, 2.0f})
        for (const float radius : {8.0f, 13.0f, 16.0f}) {
            const juce::Point<float> at{20.3f, 19.6f}, edge{at.x + radius, at.y};
            const auto colour = juce::Colours::orange.withAlpha(0.6f);
            const auto drawn =
                drawnBall(scale, [&](juce::Graphics& g) { pictures.draw(g, at, radius, colour); });
            const auto wanted = drawnBall(scale, [&](juce::Graphics& g) {
                g.setGradientFill({colour, at, colour.withAlpha(0.0f), edge, true});
                g.fillAll();
            });
            const double light = meanDifference(wanted, drawnBall(scale, [](juce::Graphics&) {}));
            EXPECT_LT(meanDifference(drawn, wanted), 0.2 * light) << radius << " at " << scale;
        }
}

} // namespace
} // namespace physvib
