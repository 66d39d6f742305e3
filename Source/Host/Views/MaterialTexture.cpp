// SPDX-License-Identifier: GPL-3.0-or-later
// Small texture tiles, made once, so that a textured fill costs as much as a plain one.
#include "Host/Views/MaterialTexture.h"
#include "Host/Views/Palette.h"
#include <algorithm>
#include <cmath>

namespace physvib {
namespace {

constexpr int tilePixels = 64;
constexpr float wallShare = 0.8f; // of a hollow body's size: the thesis' walls are 10 % of the size

struct LookFacts {
    std::string_view word;
    juce::uint32 colour;
    double hollowBelow; ///< kg/m^2; 0: never
};
constexpr std::array<LookFacts, 4> looks{{{"rubber", 0xff8c3f35, 600.0},
                                          {"concrete", 0xff9b9a93, 0.0},
                                          {"wood", 0xffb8894f, 0.0},
                                          {"steel", 0xff9db0c2, 4000.0}}};

const LookFacts& factsOf(MaterialLook look) { return looks[static_cast<std::size_t>(look)]; }

/// Brightness offset of a pixel, -1 to 1.
float grainOf(MaterialLook look, int x, int y, juce::Random& random) {
    // whole periods, so that tiles join without a seam
    constexpr float turn = juce::MathConstants<float>::twoPi / tilePixels;
    const auto fx = static_cast<float>(x), fy = static_cast<float>(y);
    switch (look) {
    // knobs
    case MaterialLook::rubber:
        return (x % 16 - 8) * (x % 16 - 8) + (y % 16 - 8) * (y % 16 - 8) < 10 ? -0.8f : 0.05f;
    // specks
    case MaterialLook::concrete:
        return random.nextFloat() < 0.08f ? -0.9f : 0.5f * random.nextFloat() - 0.25f;
    case MaterialLook::wood:
        return 0.7f * std::sin(5.0f * turn * fy + 1.5f * std::sin(turn * fx)); // rings
    // a brushed highlight
    case MaterialLook::steel: return 0.6f * std::sin(turn * (fx + fy)) + ((x + y) % 4 == 0 ? 0.25f : 0.0f);
    }
    return 0.0f;
}

juce::Image tileOf(MaterialLook look) {
    juce::Image image{juce::Image::RGB, tilePixels, tilePixels, true};
    juce::Random random{1};
    const juce::Colour base{factsOf(look).colour};
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
    static const std::array tiles{tileOf(MaterialLook::rubber), tileOf(MaterialLook::concrete),
                                  tileOf(MaterialLook::wood), tileOf(MaterialLook::steel)};
    return tiles[static_cast<std::size_t>(look)];
}

/// Draws the edge of a filled body, and the wall of a hollow one.
void drawEdges(juce::Graphics& g, const juce::Path& path, const juce::AffineTransform& place,
               juce::Colour edge, bool isHollow) {
    g.setColour(edge);
    g.strokePath(path, juce::PathStrokeType{1.5f}, place);
    if (!isHollow) return;
    const auto inside = juce::AffineTransform::scale(wallShare).followedBy(place);
    g.setColour(palette::well.withAlpha(0.85f));
    g.fillPath(path, inside);
    g.setColour(edge);
    g.strokePath(path, juce::PathStrokeType{1.0f}, inside);
}

} // namespace

const MaterialPicture* pictureOf(const std::vector<MaterialPicture>& pictures,
                                 std::string_view material) noexcept {
    const auto found = std::ranges::find_if(pictures, [material](const MaterialPicture& picture) {
        return material.find(picture.word) != std::string_view::npos;
    });
    return found == pictures.end() ? nullptr : &*found;
}

void fillWithPicture(juce::Graphics& g, const juce::Path& path, const juce::AffineTransform& place,
                     const juce::Image& picture, bool isHollow) {
    const auto bounds = path.getBounds();
    const float scale =
        std::max(bounds.getWidth() / static_cast<float>(picture.getWidth()),
                 bounds.getHeight() / static_cast<float>(picture.getHeight())); // covers without distortion
    const auto onBody = juce::AffineTransform::translation(-0.5f * static_cast<float>(picture.getWidth()),
                                                           -0.5f * static_cast<float>(picture.getHeight()))
                            .scaled(scale)
                            .translated(bounds.getCentre());
    g.setFillType(juce::FillType{picture, onBody.followedBy(place)});
    g.fillPath(path, place);
    drawEdges(g, path, place, palette::well, isHollow);
}

std::optional<MaterialLook> materialLookOf(std::string_view name) noexcept {
    for (std::size_t i = 0; i < looks.size(); ++i)
        if (name.find(looks[i].word) != std::string_view::npos) return static_cast<MaterialLook>(i);
    return std::nullopt;
}

bool looksHollow(MaterialLook look, double densityKgPerSquareMetre) noexcept {
    return densityKgPerSquareMetre < factsOf(look).hollowBelow;
}

void fillWithMaterial(juce::Graphics& g, const juce::Path& path, const juce::AffineTransform& place,
                      MaterialLook look, bool isHollow) {
    g.setFillType(juce::FillType{tile(look), place});
    g.fillPath(path, place);
    drawEdges(g, path, place, juce::Colour{factsOf(look).colour}.darker(0.9f), isHollow);
}

} // namespace physvib
