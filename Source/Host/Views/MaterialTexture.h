// SPDX-License-Identifier: GPL-3.0-or-later
// What a material looks like where participants have to know it by sight (thesis 5.2.1): a texture of its
// own, hollow and solid bodies told apart.
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

/// A look with what it says of a body, as it is shown to participants.
struct MaterialLegend {
    MaterialLook look;
    bool isHollow;
    std::string_view stands; ///< for a word in the names of stimuli
    std::string_view words;  ///< in English, to be translated
};

/// Of the thesis' object pairs, in the order of its table.
inline constexpr std::array<MaterialLegend, 5> materialLegends{
    {{MaterialLook::rubber, true, "rubber", "Rubber: hollow ball"},
     {MaterialLook::concrete, false, "concrete", "Concrete: solid block"},
     {MaterialLook::wood, false, "wood", "Wood: solid"},
     {MaterialLook::steel, true, "steel", "Steel: hollow can"},
     {MaterialLook::steel, false, "steel", "Steel: solid plate"}}};

/// By a word in a material's name; none: it has no texture. Any thread.
std::optional<MaterialLook> materialLookOf(std::string_view name) noexcept;

/// Whether a body of that density is hollow: far less than half of the solid material. Any thread.
bool looksHollow(MaterialLook look, double densityKgPerSquareMetre) noexcept;

/// A picture that is shown instead of the texture of materials with that word in their names.
struct MaterialPicture {
    std::string word;
    juce::Image image;
};

/// The picture of a material; null: it has none. Any thread.
const MaterialPicture* pictureOf(const std::vector<MaterialPicture>& pictures,
                                 std::string_view material) noexcept;

/// Fills `path`, which lies around 0,0, at `place` with a picture that covers it. M.
void fillWithPicture(juce::Graphics& g, const juce::Path& path, const juce::AffineTransform& place,
                     const juce::Image& picture, bool isHollow);

/// Fills `path`, which lies around 0,0, at `place`. M.
void fillWithMaterial(juce::Graphics& g, const juce::Path& path, const juce::AffineTransform& place,
                      MaterialLook look, bool isHollow);

} // namespace physvib
