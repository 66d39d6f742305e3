// SPDX-License-Identifier: GPL-3.0-or-later
// Screen with the analysis of a study's trials over the whole window: figures of `physvib analyse`, warnings
// and picture.
#pragma once
#include "Lab/Analysis/Analysis.h"
#include "Mixer/Widgets/Parts.h"

namespace physvib {

/// Fills its parent. Message thread.
class AnalysisScreen final : public juce::Component {
public:
    AnalysisScreen(MixerModel& model, const std::vector<juce::File>& files);
    /// Shows this report instead, under that title.
    AnalysisScreen(MixerModel& model, const juce::String& title, AnalysisReport report);
    ~AnalysisScreen() override;

    std::function<void()> onClose;

    /// Shows the first analysis that fits the trial files of one study, or any table that `physvib analyse`
    /// accepts.
    void analyse(const std::vector<juce::File>& files);
    const AnalysisReport& report() const noexcept { return report_; }
    const juce::Drawable* picture() const noexcept { return picture_.get(); }

    void refresh(); ///< updates the silence button

    bool keyPressed(const juce::KeyPress& key) override;
    void paint(juce::Graphics& g) override;
    void resized() override;
    void parentSizeChanged() override;
    void parentHierarchyChanged() override;

private:
    AnalysisScreen(MixerModel& model, const juce::String& title);
    void browse();
    void run(const std::string& name);
    void showWords();

    MixerModel& model_;
    juce::String title_;
    std::vector<juce::File> files_;
    AnalysisReport report_;
    std::unique_ptr<juce::Drawable> picture_;
    juce::ComboBox kind_;
    juce::TextEditor words_;
    std::unique_ptr<juce::TextButton> choose_, close_;
    juce::TextButton silence_; // the world continues behind this screen
    juce::Rectangle<int> titleArea_, pictureArea_;
};

} // namespace physvib
