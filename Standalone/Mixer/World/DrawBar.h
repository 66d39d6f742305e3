// SPDX-License-Identifier: GPL-3.0-or-later
// Controls beside the world: tools, materials of the scene, and properties of the selected bodies.
#pragma once
#include "Mixer/Window/Parts.h"
#include "Mixer/World/DrawPane.h"
#include <memory>
#include <vector>

namespace physvib {

/// Vertical list of tools. Message thread only.
class DrawBar final : public juce::Component {
public:
    explicit DrawBar(DrawPane& pane);
    ~DrawBar() override;
    void show(); ///< updates after changes of the pane
    void resized() override;
    static constexpr int wide = 34;

private:
    class ToolButton;
    DrawPane& pane_;
    std::vector<std::unique_ptr<ToolButton>> tools_;
    juce::TextButton snap_{"#"};
};

/// Name and colour of each material: a click selects it for drawing, and hovering plays it once. Message
/// thread only.
class MaterialPalette final : public juce::Component {
public:
    MaterialPalette(Desk& desk, DrawPane& pane);
    ~MaterialPalette() override;
    void show();
    void resized() override;

private:
    class Swatch;
    Desk& desk_;
    DrawPane& pane_;
    std::vector<Material> shown_;
    std::vector<std::unique_ptr<Swatch>> swatches_;
};

/// Static or moving, haptic source or not, density and restitution of the selected bodies. Message thread
/// only.
class BodyPanel final : public juce::Component {
public:
    BodyPanel(Desk& desk, DrawPane& pane);
    void show();
    void paint(juce::Graphics& g) override;
    void resized() override;
    static constexpr int wide = 232, high = 124;

private:
    Desk& desk_;
    DrawPane& pane_;
    juce::Label name_, densityName_, bounceName_;
    juce::ToggleButton moves_{"moves"}, source_{"haptic source"};
    juce::Slider density_, bounce_;
};

} // namespace physvib
