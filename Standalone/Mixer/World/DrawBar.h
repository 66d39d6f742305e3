// SPDX-License-Identifier: GPL-3.0-or-later
// Controls beside the world: tools, materials of the scene, and properties of the selected bodies.
#pragma once
#include "Mixer/Widgets/MixerWidgets.h"
#include "Mixer/World/DrawPane.h"
#include <set>
#include <tuple>

namespace physvib {

/// Vertical list of tools. Message thread.
class DrawBar final : public juce::Component {
public:
    explicit DrawBar(DrawPane& pane);
    ~DrawBar() override;
    void refresh(); ///< updates after changes of the pane
    void resized() override;
    /// Width in pixels at that height: one column of buttons, or as many as are needed.
    static int widthFor(int height);

private:
    static constexpr int buttonWidth = 34, buttonHeight = 30, lowButtonHeight = 26, spacing = 3;
    /// Height of a button in pixels: buttons get lower before there is a second column.
    static int buttonHeightFor(int height);
    static int buttonsPerColumn(int height);
    class ToolButton;
    DrawPane& pane_;
    std::vector<std::unique_ptr<ToolButton>> tools_;
    juce::TextButton snapButton_{"#"};
};

/// A small button that draws the decay of a material.
class MaterialSwatch;

/// Opens the page of a material's figures; with `isRecording`, also asks for a recording to measure.
using OpenMaterialPage = std::function<void(int material, bool isRecording)>;

/// A button per material: a click selects it for drawing, hovering plays it once. Another button creates a
/// material. With the rain tool, also lists for the number of balls and the pattern. Message thread.
class MaterialPalette final : public juce::Component {
public:
    MaterialPalette(MixerModel& model, DrawPane& pane, const OpenMaterialPage& openPage);
    ~MaterialPalette() override;
    void refresh();
    void resized() override;

private:
    MixerModel& model_;
    DrawPane& pane_;
    std::vector<Material> shownMaterials_;
    std::set<std::tuple<bool, int, bool>> surfaces_; // surfaces for which the tooltips were made
    std::vector<std::unique_ptr<MaterialSwatch>> swatches_;
    const OpenMaterialPage& openPage_;
    const std::function<void(int)> selectMaterial_{[this](int material) {
        pane_.setMaterial(material);
        hintOnMaterial(model_, material);
    }};
    IconButton newButton_{Icon::plus, "New material"};
    juce::TextButton editButton_;
    void placeName();
    Caption nameLabel_; // selected material, if the swatches have no room for names
    juce::ComboBox ballCountChoice_, patternChoice_;
};

/// Edits the selected bodies: static or moving, haptic source, material, density and restitution; of a single
/// body also speed and torque of its motor, and stiffness of its spring. Message thread.
class BodyPanel final : public juce::Component {
public:
    BodyPanel(MixerModel& model, DrawPane& pane, const OpenMaterialPage& openPage);
    ~BodyPanel() override;
    void refresh();
    void paint(juce::Graphics& g) override {
        fillRound(g, *this, Shade::raised, getLocalBounds().toFloat(), 8.0f);
    }
    void resized() override { layOut(getWidth(), true); }
    int heightFor(int width) { return layOut(width, false); } ///< in pixels
    static constexpr int preferredWidth = 216; ///< px, beside the field; above it, it is as wide as the field

private:
    static constexpr int edge = 4, lineHeight = 26;
    int layOut(int width, bool setsBounds); ///< sets the bounds if `setsBounds`; returns the height in pixels
    void edit(const char* name, const Result<std::vector<Action>>& actions, bool continuesEdit) {
        model_.reportIfError(actions ? model_.world().edit(name, actions.value, continuesEdit)
                                     : actions.error);
    }

    MixerModel& model_;
    DrawPane& pane_;
    std::vector<Material> shownMaterials_;
    std::vector<std::unique_ptr<MaterialSwatch>> swatches_;
    std::string motorJoint_, springJoint_; // joints of the single selected body; empty: none
    const OpenMaterialPage& openPage_;
    const std::function<void(int)> assignMaterial_{
        [this](int material) { pane_.setSelectedMaterial(material), refresh(); }}; ///< to the selected bodies
    IconButton newButton_{Icon::plus, "New material for what is chosen"};
    std::unique_ptr<juce::TextButton> editLink_;
    Caption nameLabel_{{}, Shade::text};
    Caption densityLabel_{"density"}, bounceLabel_{"bounce"}, speedLabel_{"motor"}, torqueLabel_{"torque"},
        springLabel_{"spring"}, beltLabel_{"belt"};
    juce::ToggleButton moves_{"moves"}, source_{"haptic source"};
    juce::Slider density_, bounce_, speed_, torque_, spring_, belt_;
};

} // namespace physvib
