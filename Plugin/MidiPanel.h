// SPDX-License-Identifier: GPL-3.0-or-later
// Editor panel with the rules for notes and controllers, which can be added, changed and removed.
#pragma once
#include "MixPanel.h"

namespace physvib {

/// What the rule says, for people: "C4 strikes wood at 50 %, 0 %". Any thread.
juce::String wordsOf(const NoteRule& rule, const Scene& scene);
juce::String wordsOf(const ControllerRule& rule);

/// M only.
class MidiPanel final : public juce::Component, private juce::ListBoxModel {
public:
    explicit MidiPanel(MixHands hands);
    void take(const PluginState& state);
    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    bool isNote(int row) const { return row < static_cast<int>(state_.notes.size()); }
    int getNumRows() override { return static_cast<int>(state_.notes.size() + state_.controllers.size()); }
    void paintListBoxItem(int row, juce::Graphics& g, int width, int height, bool isSelected) override;
    juce::String getNameForRow(int row) override;
    void selectedRowsChanged(int) override { showChoice(); }
    void listBoxItemDoubleClicked(int row, const juce::MouseEvent&) override { change(row); }
    void returnKeyPressed(int row) override { change(row); }
    void deleteKeyPressed(int row) override { remove(row); }
    void showChoice();
    void change(int row);
    void remove(int row);
    juce::AlertWindow& newForm(const juce::String& title);
    void ask(std::function<void(juce::AlertWindow&)> use); ///< `use` gets the form filled in
    void askNote(int row, NoteRule rule);
    void askController(int row, ControllerRule rule);
    void keep(int row, const NoteRule& rule);
    void keep(int row, const ControllerRule& rule);

    const MixHands hands_;
    PluginState state_;
    juce::Label title_, hint_;
    juce::ListBox list_{"What notes and controllers do", this};
    juce::TextButton addNote_{"Add a note"}, addController_{"Add a controller"}, change_{"Change"},
        remove_{"Remove"};
    std::unique_ptr<juce::AlertWindow> form_; // the last: it is drawn by our look
};

} // namespace physvib
