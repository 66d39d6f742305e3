// SPDX-License-Identifier: GPL-3.0-or-later
// What the world view draws with: textures by which participants of a study recognise materials
// (thesis 5.2.1), small discs, and badges of actuators.
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

/// A material that has a texture.
enum class MaterialLook { rubber, concrete, wood, steel };

/// A texture with the words that describe it to participants.
struct MaterialLegend {
    MaterialLook look;
    bool isHollow;
    std::string_view stands; ///< occurs in the names of stimuli
    std::string_view words;  ///< in English, to be translated
};

/// The thesis' object pairs, in the order of its table.
inline constexpr std::array<MaterialLegend, 5> materialLegends{
    {{MaterialLook::rubber, true, "rubber", "Rubber: hollow ball"},
     {MaterialLook::concrete, false, "concrete", "Concrete: solid block"},
     {MaterialLook::wood, false, "wood", "Wood: solid"},
     {MaterialLook::steel, true, "steel", "Steel: hollow can"},
     {MaterialLook::steel, false, "steel", "Steel: solid plate"}}};

/// Looks for a material word in the name; none: no texture. Any thread.
std::optional<MaterialLook> materialLookOf(std::string_view name) noexcept;

/// Whether a body of that density is hollow: far below half the density of the solid material. Any thread.
bool looksHollow(MaterialLook look, double densityKgPerSquareMetre) noexcept;

/// A picture that replaces the texture of materials whose names contain `word`.
struct MaterialPicture {
    std::string word;
    juce::Image image;
};

/// The picture of a material; null: none. Any thread.
const MaterialPicture* pictureOf(const std::vector<MaterialPicture>& pictures,
                                 std::string_view material) noexcept;

/// Fills `path`, centred on 0,0 and transformed by `place`, with a picture scaled to cover it. M.
void fillWithPicture(juce::Graphics& g, const juce::Path& path, const juce::AffineTransform& place,
                     const juce::Image& picture, bool isHollow);

/// Fills `path`, centred on 0,0 and transformed by `place`, with a texture. M.
void fillWithMaterial(juce::Graphics& g, const juce::Path& path, const juce::AffineTransform& place,
                      MaterialLook look, bool isHollow);

/// Cached pictures of small discs, because copying thousands of them is faster than drawing them.
class BallPictures {
public:
    static constexpr float mostPixels = 16.0f; ///< radius, in pixels of the display
    /// Of every disc, copied or drawn: the lines in pixels of the component, the spoke as a share of the
    /// radius.
    static constexpr float rimWidth = 2.0f, spokeWidth = 1.5f, spokeShare = 0.9f;

    struct Ball {
        float radius = 0.0f; ///< in pixels of the component
        juce::Colour fill;
        juce::Colour spoke{}, rim{}; ///< transparent: none
        bool operator==(const Ball&) const = default;
    };

    /// Draws it with its spoke at an angle in radians, clockwise from the right; place and angle are rounded
    /// to those of a cached picture. False, and nothing is drawn, if the disc is too large. M.
    bool draw(juce::Graphics& g, const Ball& ball, juce::Point<float> centre, float angle);

private:
    static constexpr int turns = 64, phases = 4; // angles of the spoke; places between pixels, along each
                                                 // axis
    struct Kind {
        Ball ball;
        std::vector<juce::Image> pictures; // null until they are needed
    };
    Kind& kindOf(const Ball& ball);
    juce::Image pictureOf(const Ball& ball, int turn, juce::Point<int> phase) const;

    float scale_ = 1.0f; // of the pictures
    std::vector<Kind> kinds_;
};

/// Cached pictures of glows by colour and radius, because drawing a gradient each time is slower.
class GlowPictures {
public:
    /// Radius in pixels of the component; place and radius are rounded to whole pixels of the display. M.
    void draw(juce::Graphics& g, juce::Point<float> centre, float radius, juce::Colour colour);

private:
    struct Glow {
        juce::Colour opaque;
        int radius; // in pixels of the display
        juce::Image picture;
    };
    std::vector<Glow> glows_;
};

constexpr float highestBadge = 30.0f, lowestBadge = 16.0f, widestBadge = 96.0f, betweenBadges = 3.0f;

/// Rectangles of badges, in pixels: centred on their places, of one height, as wide as text and neighbours
/// allow. Badges that would overlap are moved apart within `room`. Any thread.
std::vector<juce::Rectangle<float>> badgesAround(std::span<const juce::Point<float>> places,
                                                 std::span<const float> textWidths,
                                                 juce::Rectangle<float> room);

} // namespace physvib
