// SPDX-License-Identifier: GPL-3.0-or-later
// The grains of a material's surface in one row: how far apart, how strong, in which pattern, how much of it
// when it rolls.
#pragma once
#include "Contacts/Texture.h"
#include "Mixer/Window/TabPanel.h"
#include <functional>

namespace physvib {

/// M.
class TextureRow final : public juce::Component {
public:
    TextureRow();

    /// Nothing: there is no surface to set.
    void show(const std::optional<Texture>& texture);
    /// What a hand has set; `what` it was, and whether the hand goes on (see onSlide).
    std::function<void(const Texture& texture, const juce::String& what, bool goesOn)> onChange;

    void resized() override;

private:
    void prepare(juce::Slider& bar, const juce::String& title, const juce::String& tooltip);
    void change(const juce::String& what, bool goesOn);

    juce::Slider grain_, roughness_, rolling_;
    juce::ComboBox pattern_;
};

} // namespace physvib
