// SPDX-License-Identifier: GPL-3.0-or-later
// Beside the world: the tools, the scene's materials, and what the chosen bodies are.
#pragma once
#include "Mixer/Window/Parts.h"
#include "Mixer/World/DrawPane.h"
#include <memory>
#include <vector>

namespace physvib {

/// The tools, one under the other. M only.
class DrawBar final : public juce::Component {
public:
    explicit DrawBar(DrawPane& pane);
    ~DrawBar() override;
    void show(); ///< the pane has changed
    void resized() override;
    static constexpr int wide = 34;

private:
    class ToolButton;
    DrawPane& pane_;
    std::vector<std::unique_ptr<ToolButton>> tools_;
    juce::TextButton snap_{"#"};
};

/// A name and a colour for each material: a click draws with it, a mouse over it plays it once. M only.
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

/// Static or moving, source or not, density and bounce of the chosen bodies. M only.
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
