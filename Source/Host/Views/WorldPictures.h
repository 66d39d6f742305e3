// SPDX-License-Identifier: GPL-3.0-or-later
// Drawing for WorldView: textures and pictures by which participants of a study recognise materials (thesis
// 5.2.1), cached pictures of small discs and of glows, and the layout of actuators' badges.
#pragma once
#include <array>
#include <juce_graphics/juce_graphics.h>
#include <juce_gui_basics/juce_gui_basics.h>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// Materials that have a texture.
enum class MaterialLook { rubber, concrete, wood, steel };

/// A texture with the text that describes it to participants.
struct MaterialLegend {
    MaterialLook look;
    bool isHollow;
    std::string_view stimulusWord; ///< occurs in the names of stimuli
    std::string_view words;        ///< in English, to be translated
};

/// The thesis' object pairs, in the order of its table.
inline constexpr std::array<MaterialLegend, 5> materialLegends{
    {{MaterialLook::rubber, true, "rubber", "Rubber: hollow ball"},
     {MaterialLook::concrete, false, "concrete", "Concrete: solid block"},
     {MaterialLook::wood, false, "wood", "Wood: solid"},
     {MaterialLook::steel, true, "steel", "Steel: hollow can"},
     {MaterialLook::steel, false, "steel", "Steel: solid plate"}}};

/// The texture whose word occurs in `name`, if there is one. Any thread.
std::optional<MaterialLook> findMaterialLook(std::string_view name) noexcept;

/// True if a body of that density is hollow: well below half of the solid material's. Any thread.
bool isHollowDensity(MaterialLook look, double densityKgPerSquareMetre) noexcept;

/// A picture that replaces the texture of materials whose names contain `word`.
struct MaterialPicture {
    std::string word;
    juce::Image image;
};

/// The picture of a material; null: none. Any thread.
const MaterialPicture* findPicture(const std::vector<MaterialPicture>& pictures,
                                   std::string_view material) noexcept;

/// Fills `path`, centred on 0,0 and transformed by `transform`, with a picture scaled to cover it. M.
void fillWithPicture(juce::Graphics& g, const juce::Path& path, const juce::AffineTransform& transform,
                     const juce::Image& picture, bool isHollow);

/// Fills `path`, centred on 0,0 and transformed by `transform`, with a texture. M.
void fillWithMaterial(juce::Graphics& g, const juce::Path& path, const juce::AffineTransform& transform,
                      MaterialLook look, bool isHollow);

/// Cached pictures of small discs, because copying thousands of them is faster than drawing them.
class DiscPictures {
public:
    static constexpr float maxRadiusPixels = 16.0f; ///< in pixels of the display
    /// Widths of the lines of all discs, in pixels of the component; length of the spoke per radius.
    static constexpr float rimWidth = 2.0f, spokeWidth = 1.5f, spokeShare = 0.9f;

    struct Disc {
        float radius = 0.0f; ///< in pixels of the component
        juce::Colour fill;
        juce::Colour spoke{}, rim{}; ///< transparent: no spoke, no rim
        bool operator==(const Disc&) const = default;
    };

    /// Draws a disc with its spoke at `angle` in radians, clockwise from the right; centre and angle are
    /// rounded to those of a cached picture. False, drawing nothing, if the disc is too large. M.
    bool draw(juce::Graphics& g, const Disc& disc, juce::Point<float> centre, float angle);

private:
    static constexpr int spokeAngles = 64, subpixels = 4; // spoke angles; subpixel positions along each axis
    struct DiscCache {
        Disc disc;
        std::vector<juce::Image> pictures; // null until they are needed
    };
    DiscCache& cacheOf(const Disc& disc);
    juce::Image renderDisc(const Disc& disc, int turn, juce::Point<int> phase) const;

    float scale_ = 1.0f; // of the pictures
    std::vector<DiscCache> discCaches_;
};

/// Cached pictures of glows by colour and radius, because drawing a gradient each time is slower.
class GlowPictures {
public:
    /// `radius` in pixels of the component; centre and radius are rounded to pixels of the display. M.
    void draw(juce::Graphics& g, juce::Point<float> centre, float radius, juce::Colour colour);

private:
    struct Glow {
        juce::Colour opaque;
        int radius; // in pixels of the display
        juce::Image picture;
    };
    std::vector<Glow> glows_;
};

constexpr float maxBadgeHeight = 30.0f, minBadgeHeight = 16.0f, maxBadgeWidth = 96.0f, badgeSpacing = 3.0f;

/// Rectangles of badges, in pixels: centred on their places, of one height, as wide as text and neighbours
/// allow. Badges that would overlap are moved apart within `room`. Any thread.
std::vector<juce::Rectangle<float>> layOutBadges(std::span<const juce::Point<float>> places,
                                                 std::span<const float> textWidths,
                                                 juce::Rectangle<float> room);

} // namespace physvib
