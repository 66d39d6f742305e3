// SPDX-License-Identifier: GPL-3.0-or-later
// Tab for actuators and panning: layout presets, panning law, exponent, and gain maps.
#pragma once
#include "Host/Views/WorldView.h"
#include "Mixer/Widgets/Parts.h"
#include <array>

namespace physvib {

class EnchantersTab final : public Tab {
public:
    /// `world` shows the gain map of the actuator selected here.
    EnchantersTab(MixerModel& model, WorldView& world);
    void mixChanged() override;
    void editRow(int enchanter); ///< asks for name, profile and full scale
    void resized() override;
    int minHeight(int) const override { return 224; } // two rows of the list
    void visibilityChanged() override {
        world_.showGainsOf(isVisible() && maps_.getToggleState() ? chosen_ : -1);
    }

private:
    /// Actuator symbol that is dragged onto the field.
    struct Module final : AttachButton {
        using AttachButton::AttachButton;
        void paintButton(juce::Graphics& g, bool isOver, bool isDown) override;
    };
    /// One row per actuator.
    class Rows final : public juce::ListBoxModel {
    public:
        explicit Rows(EnchantersTab& tab)
            : tab_{tab} {}
        int getNumRows() override { return tab_.model_.mix().count(); }
        void paintListBoxItem(int row, juce::Graphics& g, int width, int height, bool isSelected) override;
        void selectedRowsChanged(int row) override { tab_.choose(row); }
        void deleteKeyPressed(int row) override { tab_.model_.detach(row); }
        void listBoxItemDoubleClicked(int row, const juce::MouseEvent&) override { tab_.editRow(row); }
        void returnKeyPressed(int row) override { tab_.editRow(row); }
        juce::String getNameForRow(int row) override;

    private:
        EnchantersTab& tab_;
    };
    void choose(int enchanter);
    void usePreset();
    void applyRow(std::size_t i, const std::string& label, const std::string& profile, double fullScaleG);

    MixerModel& model_;
    WorldView& world_;
    int chosen_ = -1;
    std::array<int, 3> widest_{}; // name, place and profile
    Module module_{model_, "New actuator",
                   "Drag it onto the field to attach it there; pressed, it is attached in the middle"};
    juce::ComboBox preset_, law_;
    juce::Slider exponent_;
    Caption presetName_{"Preset"}, lawName_{"Law"}, exponentName_{"Exponent"},
        hint_{"Drag a badge to move it; out of the field: detached."};
    juce::ToggleButton maps_{"Show on the field what it plays of a hit at each place"};
    Rows rows_{*this};
    juce::ListBox list_{"Actuators", &rows_};
    std::unique_ptr<juce::TextButton> detach_, edit_;
};

} // namespace physvib
