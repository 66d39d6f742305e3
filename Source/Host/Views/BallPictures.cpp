// SPDX-License-Identifier: GPL-3.0-or-later
// Keeps a picture per kind of disc, angle and place between pixels.
#include "Host/Views/BallPictures.h"
#include <algorithm>
#include <cmath>
#include <utility>

namespace physvib {
namespace {

constexpr std::size_t mostKinds = 12; // at most some megabytes

int sideOf(float radius, float scale) {
    return 2 * static_cast<int>(std::ceil((radius + 0.5f * BallPictures::rimWidth) * scale)) + 3;
}

} // namespace

BallPictures::Kind& BallPictures::kindOf(const Ball& ball) {
    const auto known = std::ranges::find(kinds_, ball, &Kind::ball);
    if (known != kinds_.end()) return *known;
    if (kinds_.size() >= mostKinds) kinds_.clear(); // sizes change while a window is dragged
    return kinds_.emplace_back(ball,
                               std::vector<juce::Image>(static_cast<std::size_t>(turns * phases * phases)));
}

juce::Image BallPictures::pictureOf(const Ball& ball, int turn, juce::Point<int> phase) const {
    const int side = sideOf(ball.radius, scale_);
    juce::Image image{juce::Image::ARGB, side, side, true, juce::SoftwareImageType{}};
    juce::Graphics g{image};
    const auto middle = static_cast<float>(side / 2);
    const auto centre = juce::Point<float>{middle, middle} + phase.toFloat() / static_cast<float>(phases);
    g.addTransform(juce::AffineTransform::scale(scale_)); // strokes as well
    const auto place =
        juce::AffineTransform::rotation(juce::MathConstants<float>::twoPi * static_cast<float>(turn) / turns)
            .translated(centre / scale_);
    juce::Path disc, spoke;
    disc.addEllipse(juce::Rectangle<float>{2.0f * ball.radius, 2.0f * ball.radius}.withCentre({}));
    spoke.addRectangle(0.0f, -0.5f * spokeWidth, spokeShare * ball.radius, spokeWidth);
    g.setColour(ball.fill);
    g.fillPath(disc, place);
    g.setColour(ball.spoke);
    if (!ball.spoke.isTransparent()) g.fillPath(spoke, place);
    g.setColour(ball.rim);
    if (!ball.rim.isTransparent()) g.strokePath(disc, juce::PathStrokeType{rimWidth}, place);
    return image;
}

bool BallPictures::draw(juce::Graphics& g, const Ball& ball, juce::Point<float> centre, float angle) {
    const float scale = g.getInternalContext().getPhysicalPixelScaleFactor();
    if (ball.radius * scale > mostPixels) return false;
    if (std::exchange(scale_, scale) != scale) kinds_.clear();
    const float share = ball.spoke.isTransparent() ? 0.0f : angle / juce::MathConstants<float>::twoPi;
    const int turn = juce::roundToInt((share - std::floor(share)) * turns) % turns;
    // to the nearest quarter of a pixel
    const auto quarters = (centre * scale * static_cast<float>(phases)).roundToInt();
    const auto whole = [](int k) { return static_cast<int>(std::floor(static_cast<float>(k) / phases)); };
    const juce::Point<int> pixel{whole(quarters.x), whole(quarters.y)}, phase = quarters - pixel * phases;
    auto& picture =
        kindOf(ball).pictures[static_cast<std::size_t>((turn * phases + phase.y) * phases + phase.x)];
    if (picture.isNull()) picture = pictureOf(ball, turn, phase);
    const auto corner = (pixel - juce::Point<int>{1, 1} * (picture.getWidth() / 2)).toFloat();
    g.setOpacity(1.0f);
    g.drawImageTransformed(picture, juce::AffineTransform::translation(corner).scaled(1.0f / scale));
    return true;
}

} // namespace physvib
