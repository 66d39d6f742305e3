// SPDX-License-Identifier: GPL-3.0-or-later
// Textures by which participants of a study recognise materials (thesis 5.2.1), different for hollow and
// solid bodies.
#pragma once
#include <array>
#include <juce_gui_basics/juce_gui_basics.h>
#include <optional>
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

} // namespace physvib
