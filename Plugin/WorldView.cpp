// SPDX-License-Identifier: GPL-3.0-or-later
// Drawing the world within a frame of a software renderer: plain paths and gradients, nothing blurred.
#include "WorldView.h"
#include "Host/Palette.h"
#include "Host/ShapeOutline.h"
#include "Physics/SceneCast.h"
#include <algorithm>

namespace physvib {

namespace {

constexpr double hitMs = 350.0;          // how long the light of a hit is seen
constexpr std::size_t mostHits = 64;     // at once: more are a glare anyway
constexpr float wallPixels = 10.0f;      // what stands around the field shows as a frame of this width

} // namespace

void WorldView::show(const PluginState& state) {
    scene_ = state.scene;
    layout_ = state.layout;
    cast_ = sceneCast(scene_);
    ahead_.clear();
    hits_.clear();
    repaint();
}

void WorldView::update(std::vector<BodyPose> poses, std::int64_t sessionNs, std::int64_t aheadNs, const std::vector<TakeEvent>& hits, const PluginMeters& meters) {
    if (!ahead_.empty() && sessionNs < ahead_.back().timeNs) ahead_.clear(); // a new take
    if (!poses.empty()) ahead_.push_back({sessionNs, std::move(poses)});
    while (ahead_.size() > 1 && ahead_[1].timeNs + aheadNs <= sessionNs) ahead_.pop_front();
    const double now = juce::Time::getMillisecondCounterHiRes();
    for (const auto& hit : hits) {
        const auto& e = hit.played.event;
        hits_.push_back({e.x, e.y, std::abs(e.amplitude), colourOf(e), now});
    }
    while (!hits_.empty() && (hits_.size() > mostHits || now - hits_.front().shownAtMs > hitMs)) hits_.pop_front();
    meters_ = meters;
    repaint();
}

juce::Colour WorldView::colourOf(const CollisionEvent& event) const {
    for (std::size_t i = 0; i < scene_.materials.size(); ++i)
        if (scene_.materials[i].frequencyHz == event.frequencyHz && scene_.materials[i].decayPerSecond == event.decayPerSecond)
            return palette::material(static_cast<int>(i));
    return palette::other;
}

WorldView::Map WorldView::map() const {
    const auto room = getLocalBounds().reduced(24).toFloat();
    const auto width = static_cast<float>(std::max(scene_.fieldWidthMetres, 1e-6)), height = static_cast<float>(std::max(scene_.fieldHeightMetres, 1e-6));
    const float scale = std::min(room.getWidth() / width, room.getHeight() / height);
    return {room.withSizeKeepingCentre(width * scale, height * scale), scale};
}

void WorldView::paint(juce::Graphics& g) {
    g.fillAll(palette::panel);
    if (getWidth() < 60 || getHeight() < 60) return;
    const auto at = map();
    g.setColour(palette::well);
    g.fillRoundedRectangle(at.field.expanded(wallPixels), 4.0f);
    {
        const juce::Graphics::ScopedSaveState whole{g};
        g.reduceClipRegion(at.field.expanded(wallPixels).toNearestInt());
        drawBodies(g, at);
        drawHits(g, at);
    }
    drawEnchanters(g, at);
}

void WorldView::drawBodies(juce::Graphics& g, const Map& at) const {
    for (std::size_t i = 0; i < cast_.size(); ++i) {
        const auto& body = cast_[i];
        BodyPose pose{body.positionMetres.x, body.positionMetres.y, body.angleRadians, i < scene_.bodies.size()};
        if (!ahead_.empty() && i < ahead_.front().poses.size()) pose = ahead_.front().poses[i];
        if (!pose.isPresent) continue;
        const auto move = juce::AffineTransform::rotation(static_cast<float>(-pose.angleRadians)).translated(at.at(pose.xMetres, pose.yMetres));
        for (const auto& fixture : body.fixtures) {
            const auto place = juce::AffineTransform::rotation(static_cast<float>(-fixture.angleRadians))
                                   .translated(static_cast<float>(fixture.offsetMetres.x) * at.pixelsPerMetre, static_cast<float>(-fixture.offsetMetres.y) * at.pixelsPerMetre)
                                   .followedBy(move);
            const auto path = shapeOutline(fixture.shape, at.pixelsPerMetre);
            g.setColour(palette::material(fixture.material).withMultipliedBrightness(body.type == BodyType::dynamicBody ? 0.9f : 0.6f));
            if (std::holds_alternative<ChainShape>(fixture.shape)) g.strokePath(path, juce::PathStrokeType{3.0f}, place);
            else g.fillPath(path, place);
            if (!fixture.isCamera) continue;
            g.setColour(palette::camera.withAlpha(0.8f));
            g.strokePath(path, juce::PathStrokeType{1.2f}, place);
        }
    }
}

void WorldView::drawHits(juce::Graphics& g, const Map& at) const {
    const double now = juce::Time::getMillisecondCounterHiRes();
    for (const auto& hit : hits_) {
        const auto age = static_cast<float>(juce::jlimit(0.0, 1.0, (now - hit.shownAtMs) / hitMs));
        const float level = juce::jlimit(0.15f, 1.0f, 1.0f + static_cast<float>(juce::Decibels::gainToDecibels(hit.amplitude, -60.0)) / 60.0f);
        const float radius = 8.0f + (20.0f + 40.0f * level) * (0.4f + 0.6f * age), fade = (1.0f - age) * level;
        const auto centre = at.at(hit.x, hit.y);
        const auto disc = juce::Rectangle<float>{2.0f * radius, 2.0f * radius}.withCentre(centre);
        g.setGradientFill({hit.colour.brighter(0.6f).withAlpha(0.8f * fade), centre, hit.colour.withAlpha(0.0f), centre.translated(radius, 0.0f), true});
        g.fillEllipse(disc);
        g.setColour(palette::now.withAlpha(0.7f * fade));
        g.drawEllipse(disc.reduced(0.25f * radius), 1.5f);
    }
}

void WorldView::drawEnchanters(juce::Graphics& g, const Map& at) const {
    const auto& layout = layout_.geometry;
    for (int j = 0; j < layout.count; ++j) {
        const auto& place = layout.places[static_cast<std::size_t>(j)];
        const auto centre = at.at(place.xMetres / layout.extentWidthMetres * scene_.fieldWidthMetres, place.yMetres / layout.extentHeightMetres * scene_.fieldHeightMetres);
        const auto colour = palette::enchanter(j);
        const float share = std::sqrt(juce::jlimit(0.0f, 1.0f, meters_.peaks[static_cast<std::size_t>(j)])), radius = 16.0f + 44.0f * share;
        g.setGradientFill({colour.withAlpha(0.75f * share), centre, colour.withAlpha(0.0f), centre.translated(radius, 0.0f), true});
        g.fillEllipse(juce::Rectangle<float>{2.0f * radius, 2.0f * radius}.withCentre(centre));
        const auto badge = juce::Rectangle<float>{26.0f, 26.0f}.withCentre(centre).constrainedWithin(getLocalBounds().reduced(4).toFloat());
        g.setColour(palette::well);
        g.fillRoundedRectangle(badge, 6.0f);
        g.setColour(colour);
        g.drawRoundedRectangle(badge, 6.0f, 2.0f);
        g.setFont(juce::Font{13.0f, juce::Font::bold});
        g.drawText(juce::String::fromUTF8(layout_.enchanters[static_cast<std::size_t>(j)].label.c_str()), badge, juce::Justification::centred, false);
    }
}

} // namespace physvib
