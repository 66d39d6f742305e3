// SPDX-License-Identifier: GPL-3.0-or-later
// Controls for the surface grains of a material: distance, strength, pattern, and share when rolling.
#pragma once
#include "Contacts/Grains.h"
#include "Mixer/Window/TabPanel.h"
#include <functional>

namespace physvib {

/// Message thread.
class TextureRow final : public juce::Component {
public:
    TextureRow();

    /// nullopt: no surface to edit.
    void show(const std::optional<Texture>& texture);
    /// Called with the new texture; `what` names the changed value, and `goesOn` is true during a drag (see
    /// onSlide).
    std::function<void(const Texture& texture, const juce::String& what, bool goesOn)> onChange;

    void resized() override;

private:
    void prepare(juce::Slider& bar, const juce::String& title, const juce::String& tooltip);
    void change(const juce::String& what, bool goesOn);

    juce::Slider grain_, roughness_, rolling_;
    juce::ComboBox pattern_;
};

} // namespace physvib
