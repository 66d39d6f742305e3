// SPDX-License-Identifier: GPL-3.0-or-later
// Controls beside the world: tools, materials of the scene, and properties of the selected bodies.
#pragma once
#include "Mixer/Widgets/Parts.h"
#include "Mixer/World/DrawPane.h"
#include <memory>
#include <set>
#include <tuple>
#include <vector>

namespace physvib {

/// Vertical list of tools. Message thread.
class DrawBar final : public juce::Component {
public:
    explicit DrawBar(DrawPane& pane);
    ~DrawBar() override;
    void show(); ///< updates after changes of the pane
    void resized() override;
    /// One column, or as many as the height needs.
    static int widthFor(int height);

private:
    static constexpr int wide = 34, high = 30, lowHigh = 26, between = 3;
    /// Buttons are a little lower before there is another column.
    static int highFor(int height);
    static int perColumn(int height);
    class ToolButton;
    DrawPane& pane_;
    std::vector<std::unique_ptr<ToolButton>> tools_;
    juce::TextButton snap_{"#"};
};

/// A material's chip, which shows its decay.
class MaterialSwatch;

/// Name and colour of each material: a click selects it for drawing, and hovering plays it once; and one that
/// makes another. With the rain, also its number of balls. Message thread.
class MaterialPalette final : public juce::Component {
public:
    MaterialPalette(MixerModel& model, DrawPane& pane);
    ~MaterialPalette() override;
    void show();
    void resized() override;

private:
    MixerModel& model_;
    DrawPane& pane_;
    std::vector<Material> shown_;
    std::set<std::tuple<bool, int, bool>> surfaces_; // those that the remarks are about
    std::vector<std::unique_ptr<MaterialSwatch>> swatches_;
    SignButton new_{Sign::plus, "New material"};
    void placeName();
    Caption name_; // of the chosen one, where there is no room for all of them
    juce::ComboBox count_, way_;
};

/// Static or moving, haptic source or not, material, density and restitution of the selected bodies; of a
/// single one also speed and torque of its motor, and stiffness of its spring. Message thread.
class BodyPanel final : public juce::Component {
public:
    BodyPanel(MixerModel& model, DrawPane& pane);
    ~BodyPanel() override;
    void show();
    void paint(juce::Graphics& g) override;
    void resized() override;
    int wantedHeight() const {
        const int rows = static_cast<int>(materials_.size()) / perRow() + 1; // with the one that makes
                                                                             // another
        return 2 * edge + nameHigh() + (3 + rows) * rowHigh + (drivenJoint_.empty() ? 0 : 2 * rowHigh) +
               (springJoint_.empty() ? 0 : rowHigh) + (belt_.isVisible() ? rowHigh : 0);
    }
    static constexpr int wide = 224;

private:
    static constexpr int edge = 5, rowHigh = 24;
    int perRow() const { return materials_.size() == 7 ? 8 : 7; } ///< the one that makes another is not alone
    int nameHigh() const;                                         ///< in as many lines as it needs
    void edit(const char* name, const Result<std::vector<Action>>& actions, bool continuesEdit);

    MixerModel& model_;
    DrawPane& pane_;
    std::vector<Material> shown_;
    std::vector<std::unique_ptr<MaterialSwatch>> materials_;
    std::string drivenJoint_, springJoint_; // of the single selected body; empty: none
    SignButton new_{Sign::plus, "New material for what is chosen"};
    juce::Label name_;
    Caption densityName_{"density"}, bounceName_{"bounce"}, speedName_{"motor"}, torqueName_{"torque"},
        springName_{"spring"}, beltName_{"belt"};
    juce::ToggleButton moves_{"moves"}, source_{"haptic source"};
    juce::Slider density_, bounce_, speed_, torque_, spring_, belt_;
};

} // namespace physvib
