// SPDX-License-Identifier: GPL-3.0-or-later
// Draws textures, discs and glows from cached pictures, and places badges so that they do not overlap.
#include "Host/Views/WorldPictures.h"
#include "Host/Views/Look.h"
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace physvib {
namespace {

constexpr int tilePixels = 64;
constexpr float wallShare = 0.8f; // inside of a hollow body per size: the thesis' walls are 10 % of the size

struct LookProperties {
    std::string_view word;
    juce::uint32 colour;
    double maxHollowDensity; ///< kg/m^2; 0: never
};
constexpr std::array<LookProperties, 4> lookTable{{{"rubber", 0xff8c3f35, 600.0},
                                                   {"concrete", 0xff9b9a93, 0.0},
                                                   {"wood", 0xffb8894f, 0.0},
                                                   {"steel", 0xff9db0c2, 4000.0}}};

const LookProperties& findProperties(MaterialLook look) { return lookTable[static_cast<std::size_t>(look)]; }

/// Brightness offset of a pixel, -1 to 1.
float grainOf(MaterialLook look, int x, int y, juce::Random& random) {
    // whole periods, so that tiles join without a seam
    constexpr float turn = juce::MathConstants<float>::twoPi / tilePixels;
    const auto fx = static_cast<float>(x), fy = static_cast<float>(y);
    switch (look) {
    case MaterialLook::rubber: // knobs
        return (x % 16 - 8) * (x % 16 - 8) + (y % 16 - 8) * (y % 16 - 8) < 10 ? -0.8f : 0.05f;
    case MaterialLook::concrete: // specks
        return random.nextFloat() < 0.08f ? -0.9f : 0.5f * random.nextFloat() - 0.25f;
    case MaterialLook::wood:
        return 0.7f * std::sin(5.0f * turn * fy + 1.5f * std::sin(turn * fx)); // rings
    // a brushed highlight
    case MaterialLook::steel: return 0.6f * std::sin(turn * (fx + fy)) + ((x + y) % 4 == 0 ? 0.25f : 0.0f);
    }
    return 0.0f;
}

juce::Image makeTile(MaterialLook look) {
    juce::Image image{juce::Image::RGB, tilePixels, tilePixels, true};
    juce::Random random{1};
    const juce::Colour base{findProperties(look).colour};
    juce::Image::BitmapData pixels{image, juce::Image::BitmapData::writeOnly};
    for (int y = 0; y < tilePixels; ++y)
        for (int x = 0; x < tilePixels; ++x) {
            const float grain = grainOf(look, x, y, random);
            pixels.setPixelColour(x, y,
                                  grain < 0.0f ? base.darker(-0.7f * grain) : base.brighter(0.6f * grain));
        }
    return image;
}

const juce::Image& tile(MaterialLook look) {
    static const std::array tiles{makeTile(MaterialLook::rubber), makeTile(MaterialLook::concrete),
                                  makeTile(MaterialLook::wood), makeTile(MaterialLook::steel)};
    return tiles[static_cast<std::size_t>(look)];
}

/// Draws the edge of a filled body, and the wall of a hollow one.
void drawEdges(juce::Graphics& g, const juce::Path& path, const juce::AffineTransform& transform,
               juce::Colour edge, bool isHollow) {
    g.setColour(edge);
    g.strokePath(path, juce::PathStrokeType{1.5f}, transform);
    if (!isHollow) return;
    const auto inside = juce::AffineTransform::scale(wallShare).followedBy(transform);
    g.setColour(palette::well.withAlpha(0.85f));
    g.fillPath(path, inside);
    g.setColour(edge);
    g.strokePath(path, juce::PathStrokeType{1.0f}, inside);
}

} // namespace

const MaterialPicture* findPicture(const std::vector<MaterialPicture>& pictures,
                                   std::string_view material) noexcept {
    const auto found = std::ranges::find_if(pictures, [material](const MaterialPicture& picture) {
        return material.find(picture.word) != std::string_view::npos;
    });
    return found == pictures.end() ? nullptr : &*found;
}

void fillWithPicture(juce::Graphics& g, const juce::Path& path, const juce::AffineTransform& transform,
                     const juce::Image& picture, bool isHollow) {
    const auto bounds = path.getBounds();
    const float scale =
        std::max(bounds.getWidth() / static_cast<float>(picture.getWidth()),
                 bounds.getHeight() / static_cast<float>(picture.getHeight())); // covers without distortion
    const auto onBody = juce::AffineTransform::translation(-0.5f * static_cast<float>(picture.getWidth()),
                                                           -0.5f * static_cast<float>(picture.getHeight()))
                            .scaled(scale)
                            .translated(bounds.getCentre());
    g.setFillType(juce::FillType{picture, onBody.followedBy(transform)});
    g.fillPath(path, transform);
    drawEdges(g, path, transform, palette::well, isHollow);
}

std::optional<MaterialLook> findMaterialLook(std::string_view name) noexcept {
    for (std::size_t i = 0; i < lookTable.size(); ++i)
        if (name.find(lookTable[i].word) != std::string_view::npos) return static_cast<MaterialLook>(i);
    return std::nullopt;
}

bool isHollowDensity(MaterialLook look, double densityKgPerSquareMetre) noexcept {
    return densityKgPerSquareMetre < findProperties(look).maxHollowDensity;
}

void fillWithMaterial(juce::Graphics& g, const juce::Path& path, const juce::AffineTransform& transform,
                      MaterialLook look, bool isHollow) {
    g.setFillType(juce::FillType{tile(look), transform});
    g.fillPath(path, transform);
    drawEdges(g, path, transform, juce::Colour{findProperties(look).colour}.darker(0.9f), isHollow);
}

namespace {

constexpr std::size_t maxDiscCaches = 12; // at most some megabytes

/// Draws a picture centred at a pixel of the display; `scale`: display pixels per pixel of the component.
void drawAround(juce::Graphics& g, const juce::Image& picture, juce::Point<int> pixel, float scale,
                float opacity) {
    const auto corner = (pixel - juce::Point<int>{1, 1} * (picture.getWidth() / 2)).toFloat();
    g.setOpacity(opacity);
    g.drawImageTransformed(picture, juce::AffineTransform::translation(corner).scaled(1.0f / scale));
}

int sideOf(float radius, float scale) {
    return 2 * static_cast<int>(std::ceil((radius + 0.5f * DiscPictures::rimWidth) * scale)) + 3;
}

} // namespace

DiscPictures::DiscCache& DiscPictures::cacheOf(const Disc& disc) {
    const auto cached = std::ranges::find(discCaches_, disc, &DiscCache::disc);
    if (cached != discCaches_.end()) return *cached;
    if (discCaches_.size() >= maxDiscCaches) discCaches_.clear(); // sizes change while a window is dragged
    return discCaches_.emplace_back(
        disc, std::vector<juce::Image>(static_cast<std::size_t>(spokeAngles * subpixels * subpixels)));
}

juce::Image DiscPictures::renderDisc(const Disc& disc, int turn, juce::Point<int> phase) const {
    const int side = sideOf(disc.radius, scale_);
    juce::Image image{juce::Image::ARGB, side, side, true, juce::SoftwareImageType{}};
    juce::Graphics g{image};
    const auto middle = static_cast<float>(side / 2);
    const auto centre = juce::Point<float>{middle, middle} + phase.toFloat() / static_cast<float>(subpixels);
    g.addTransform(juce::AffineTransform::scale(scale_)); // strokes as well
    const auto transform = juce::AffineTransform::rotation(juce::MathConstants<float>::twoPi *
                                                           static_cast<float>(turn) / spokeAngles)
                               .translated(centre / scale_);
    juce::Path circle, spoke;
    circle.addEllipse(juce::Rectangle<float>{2.0f * disc.radius, 2.0f * disc.radius}.withCentre({}));
    spoke.addRectangle(0.0f, -0.5f * spokeWidth, spokeShare * disc.radius, spokeWidth);
    g.setColour(disc.fill);
    g.fillPath(circle, transform);
    g.setColour(disc.spoke);
    if (!disc.spoke.isTransparent()) g.fillPath(spoke, transform);
    g.setColour(disc.rim);
    if (!disc.rim.isTransparent()) g.strokePath(circle, juce::PathStrokeType{rimWidth}, transform);
    return image;
}

bool DiscPictures::draw(juce::Graphics& g, const Disc& disc, juce::Point<float> centre, float angle) {
    const float scale = g.getInternalContext().getPhysicalPixelScaleFactor();
    if (disc.radius * scale > maxRadiusPixels) return false;
    if (std::exchange(scale_, scale) != scale) discCaches_.clear();
    const float share = disc.spoke.isTransparent() ? 0.0f : angle / juce::MathConstants<float>::twoPi;
    const int turn = juce::roundToInt((share - std::floor(share)) * spokeAngles) % spokeAngles;
    // to the nearest quarter of a pixel
    const auto quarters = (centre * scale * static_cast<float>(subpixels)).roundToInt();
    const auto whole = [](int k) { return static_cast<int>(std::floor(static_cast<float>(k) / subpixels)); };
    const juce::Point<int> pixel{whole(quarters.x), whole(quarters.y)}, phase = quarters - pixel * subpixels;
    auto& picture =
        cacheOf(disc).pictures[static_cast<std::size_t>((turn * subpixels + phase.y) * subpixels + phase.x)];
    if (picture.isNull()) picture = renderDisc(disc, turn, phase);
    drawAround(g, picture, pixel, scale, 1.0f);
    return true;
}

void GlowPictures::draw(juce::Graphics& g, juce::Point<float> centre, float radius, juce::Colour colour) {
    constexpr std::size_t maxGlows = 128; // of some 10 kB each
    constexpr int step = 2;
    const float scale = g.getInternalContext().getPhysicalPixelScaleFactor();
    const int r = step * std::max(1, juce::roundToInt(radius * scale / step));
    const auto opaque = colour.withAlpha(1.0f);
    auto cached = std::ranges::find_if(
        glows_, [=](const Glow& glow) { return glow.radius == r && glow.opaque == opaque; });
    if (cached == glows_.end()) {
        if (glows_.size() >= maxGlows) glows_.clear();
        juce::Image image{juce::Image::ARGB, 2 * r, 2 * r, true, juce::SoftwareImageType{}};
        const auto middle = static_cast<float>(r);
        juce::Graphics light{image};
        light.setGradientFill({opaque, middle, middle, opaque.withAlpha(0.0f), 2.0f * middle, middle, true});
        light.fillAll();
        cached = glows_.insert(glows_.end(), {opaque, r, image});
    }
    drawAround(g, cached->picture, (centre * scale).roundToInt(), scale, colour.getFloatAlpha());
}

// Sizes badges by the nearest neighbour, then moves what still overlaps to a free place.

namespace {

using Badges = std::vector<juce::Rectangle<float>>;
constexpr float twoLettersWidth = 24.0f;

/// Minimum distance of two different places, along the axis where they are farther apart.
float minDistance(std::span<const juce::Point<float>> places) {
    float nearest = 2.0f * maxBadgeHeight;
    for (std::size_t i = 0; i < places.size(); ++i)
        for (std::size_t k = 0; k < i; ++k) {
            const auto offset = places[k] - places[i];
            const float distance = std::max(std::abs(offset.x), std::abs(offset.y));
            if (distance >= 1.0f) nearest = std::min(nearest, distance);
        }
    return nearest;
}

/// Width of a badge: half of the way to each neighbour in its row, or more if the neighbour needs less.
float badgeWidth(std::size_t i, std::span<const juce::Point<float>> places, std::span<const float> widths,
                 float minWidth, float height) {
    float width = std::min(maxBadgeWidth, widths[i]);
    for (std::size_t k = 0; k < places.size(); ++k) {
        const auto offset = places[k] - places[i];
        if (k == i || std::abs(offset.y) >= height) continue;
        const float space = std::abs(offset.x) - badgeSpacing;
        width = std::min(width, 2.0f * space - std::clamp(widths[k], minWidth, std::max(minWidth, space)));
    }
    return std::max(minWidth, width);
}

bool overlapsNone(const juce::Rectangle<float>& badge, const Badges& placed) {
    const auto around = badge.expanded(badgeSpacing - 0.1f); // rounded
    return std::ranges::none_of(placed, [&](const auto& other) { return around.intersects(other); });
}

/// The nearest free place, on rings around its own; its own if there is none.
juce::Rectangle<float> nearestFreePlace(const juce::Rectangle<float>& badge, const Badges& placed,
                                        juce::Rectangle<float> room) {
    constexpr float step = 4.0f;
    for (float radius = 0.0f; radius < room.getWidth() + room.getHeight(); radius += step)
        for (float turn = 0.0f; turn < juce::MathConstants<float>::twoPi;
             turn += step / std::max(step, radius)) {
            const auto candidate =
                badge.translated(radius * std::cos(turn), radius * std::sin(turn)).constrainedWithin(room);
            if (overlapsNone(candidate, placed)) return candidate;
        }
    return badge;
}

} // namespace

Badges layOutBadges(std::span<const juce::Point<float>> places, std::span<const float> textWidths,
                    juce::Rectangle<float> room) {
    const float height = juce::jlimit(minBadgeHeight, maxBadgeHeight, 0.75f * minDistance(places));
    Badges home;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const float minWidth = std::max(height, std::min(twoLettersWidth, textWidths[i]));
        home.push_back(juce::Rectangle<float>{badgeWidth(i, places, textWidths, minWidth, height), height}
                           .withCentre(places[i])
                           .constrainedWithin(room));
    }
    // badges that overlap no other come first, so that they need not move
    std::vector<std::size_t> order(home.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_partition(order, [&](std::size_t i) {
        return std::ranges::count_if(home, [&](const auto& other) { return home[i].intersects(other); }) == 1;
    });
    Badges placed, badges(home.size());
    for (const std::size_t i : order) placed.push_back(badges[i] = nearestFreePlace(home[i], placed, room));
    return badges;
}

} // namespace physvib
