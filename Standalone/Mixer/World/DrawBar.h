// SPDX-License-Identifier: GPL-3.0-or-later
// Controls beside the world: tools, materials of the scene, and properties of the selected bodies.
#pragma once
#include "Mixer/Widgets/Parts.h"
#include "Mixer/World/DrawPane.h"
#include <set>
#include <tuple>

namespace physvib {

/// Vertical list of tools. Message thread.
class DrawBar final : public juce::Component {
public:
    explicit DrawBar(DrawPane& pane);
    ~DrawBar() override;
    void show(); ///< updates after changes of the pane
    void resized() override;
    /// Width in pixels at that height: one column of buttons, or as many as are needed.
    static int widthFor(int height);

private:
    static constexpr int wide = 34, high = 30, lowHigh = 26, between = 3;
    /// Height of a button in pixels: buttons get lower before there is a second column.
    static int highFor(int height);
    static int perColumn(int height);
    class ToolButton;
    DrawPane& pane_;
    std::vector<std::unique_ptr<ToolButton>> tools_;
    juce::TextButton snap_{"#"};
};

/// A material's chip, which shows its decay.
class MaterialSwatch;

/// Opens the page of a material's figures, with a choice of a recording or not.
using MaterialPage = std::function<void(int material, bool isRecording)>;

/// A button per material: a click selects it for drawing, hovering plays it once. Another button creates a
/// material. With the rain tool, also lists for the number of balls and the pattern. Message thread.
class MaterialPalette final : public juce::Component {
public:
    MaterialPalette(MixerModel& model, DrawPane& pane, const MaterialPage& page);
    ~MaterialPalette() override;
    void show();
    void resized() override;

private:
    MixerModel& model_;
    DrawPane& pane_;
    std::vector<Material> shown_;
    std::set<std::tuple<bool, int, bool>> surfaces_; // surfaces for which the tooltips were made
    std::vector<std::unique_ptr<MaterialSwatch>> swatches_;
    const MaterialPage& page_;
    const std::function<void(int)> use_{[this](int material) {
        pane_.setMaterial(material);
        hintOnMaterial(model_, material);
    }};
    SignButton new_{Sign::plus, "New material"};
    juce::TextButton edit_;
    void placeName();
    Caption name_; // selected material, if the swatches have no room for names
    juce::ComboBox count_, way_;
};

/// Static or moving, haptic source or not, material, density and restitution of the selected bodies; of a
/// single one also speed and torque of its motor, and stiffness of its spring. Message thread.
class BodyPanel final : public juce::Component {
public:
    BodyPanel(MixerModel& model, DrawPane& pane, const MaterialPage& page);
    ~BodyPanel() override;
    void show();
    void paint(juce::Graphics& g) override {
        fillRound(g, *this, Shade::raised, getLocalBounds().toFloat(), 8.0f);
    }
    void resized() override { flow(getWidth(), true); }
    int heightFor(int width) { return flow(width, false); }
    static constexpr int wide = 216; ///< beside the field, px; above it, as wide as the field

private:
    static constexpr int edge = 4, rowHigh = 26;
    int flow(int width, bool places); ///< sets bounds if `places`; returns the height
    void edit(const char* name, const Result<std::vector<Action>>& actions, bool continuesEdit) {
        model_.reportFault(actions ? model_.world().edit(name, actions.value, continuesEdit) : actions.error);
    }

    MixerModel& model_;
    DrawPane& pane_;
    std::vector<Material> shown_;
    std::vector<std::unique_ptr<MaterialSwatch>> materials_;
    std::string drivenJoint_, springJoint_; // of the single selected body; empty: none
    const MaterialPage& page_;
    const std::function<void(int)> give_{
        [this](int material) { pane_.giveMaterial(material), show(); }}; ///< to the selected bodies
    SignButton new_{Sign::plus, "New material for what is chosen"};
    std::unique_ptr<juce::TextButton> material_;
    Caption name_{{}, Shade::text};
    Caption densityName_{"density"}, bounceName_{"bounce"}, speedName_{"motor"}, torqueName_{"torque"},
        springName_{"spring"}, beltName_{"belt"};
    juce::ToggleButton moves_{"moves"}, source_{"haptic source"};
    juce::Slider density_, bounce_, speed_, torque_, spring_, belt_;
};

} // namespace physvib
