// SPDX-License-Identifier: GPL-3.0-or-later
// Card over the window that asks for a file to open or to save.
#pragma once
#include "Mixer/Window/Parts.h"

namespace physvib {

/// Lists a folder. A typed name stays while another folder is entered; a file that exists is replaced only
/// after a second press. Message thread only.
class FileCard final : public juce::Component, private juce::ListBoxModel {
public:
    struct Choice {
        juce::String title, ending; ///< with its dot; a name without an ending gets it. Empty: a folder
        juce::File folder;
        bool isSaving = false;
        juce::String name{};         ///< suggested, without its ending
        juce::StringArray endings{}; ///< others that are taken as well
        bool areSeveral = false;     ///< several files can be selected, with Shift and Ctrl
    };

    explicit FileCard(const Choice& choice);

    std::function<void(const juce::File&)> onFile;
    std::function<void(const juce::Array<juce::File>&)> onFiles; ///< two or more
    std::function<void()> onCancel;

    void enter(const juce::File& folder);
    const juce::File& folder() const noexcept { return folder_; }
    juce::String name() const { return name_.getText().trim(); }
    void setName(const juce::String& name) { name_.setText(name, true); }
    juce::String words() const { return words_.getText(); }
    /// Same as Return: enters a folder, or takes the file.
    void take();

    bool keyPressed(const juce::KeyPress& key) override;
    void paint(juce::Graphics& g) override;
    void resized() override;
    void parentHierarchyChanged() override { takeColours(); }
    void lookAndFeelChanged() override { takeColours(); }

private:
    static constexpr int wide = 640, high = 470;
    int getNumRows() override { return entries_.size(); }
    void paintListBoxItem(int row, juce::Graphics& g, int width, int height, bool isSelected) override;
    void selectedRowsChanged(int row) override;
    void listBoxItemDoubleClicked(int, const juce::MouseEvent&) override { take(); }
    void returnKeyPressed(int) override { take(); }
    juce::String getNameForRow(int row) override { return entries_[row].getFileName(); }
    void tell(const juce::String& words, Shade which);
    void takeColours(); // of the look, which comes with the parent
    bool isFolder() const { return choice_.ending.isEmpty(); }
    juce::String takeWords() const;
    bool hasEnding(const juce::File& file) const;

    const Choice choice_;
    juce::File folder_;
    juce::Array<juce::File> entries_; // folders first
    juce::File replaced_;             // asked for; the next press takes it
    juce::Label title_, place_, words_;
    Shade wordsShade_ = Shade::text;
    juce::ListBox list_{"Files", this};
    juce::TextEditor name_;
    juce::TextButton up_{"Up"}, take_, cancel_{"Cancel"};
};

} // namespace physvib
