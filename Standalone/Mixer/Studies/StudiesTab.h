// SPDX-License-Identifier: GPL-3.0-or-later
// Which study, who takes part, where the rows go; then the window is the participant's.
#pragma once
#include "Mixer/Studies/AnalysisScreen.h"
#include "Mixer/Studies/StudyFont.h"
#include "Mixer/Studies/StudyScreen.h"
#include "Mixer/Window/TabPanel.h"

namespace physvib {

class MixerView;

/// What a call of the program chooses in the tab; empty, 0: as it is.
struct StudyCall {
    juce::String protocol, participant;
    int number = 0;
    juce::String folder;
};

class StudiesTab final : public Tab {
public:
    explicit StudiesTab(Desk& desk);
    ~StudiesTab() override;

    /// A built-in protocol's name, or a file; empty, or what is wrong with it.
    std::string chooseProtocol(const std::string& nameOrPath);
    void setParticipant(const juce::String& code, int number);
    void setFolder(const juce::File& folder);
    /// Outputs for headphones that are no enchanter's, by twos and one by one, from 0.
    std::vector<std::vector<int>> noiseChoices() const;
    /// Pink noise while the study goes on; no outputs: none.
    void setNoise(const std::vector<int>& outputs, double db);

    /// What the participant reads: built-in words, a file, or "" for the protocol's. Empty, or what is wrong
    /// with them.
    std::string chooseWords(const std::string& nameOrPath);
    /// Answers in a window of their own, on another display if there is one.
    void setAnswersElsewhere(bool areElsewhere);

    /// Begins or goes on: the screen covers the window. Empty, or why not, which is shown as well.
    std::string begin();
    /// What these files say covers the window; without any, the participant's own.
    void analyse(std::vector<juce::File> files = {});
    AnalysisScreen* analysis() noexcept { return analysis_.get(); }
    StudyScreen* screen() noexcept { return screen_.get(); }
    void end();

    /// What there is to do before a study begins, a line each, as many as there is room for.
    juce::StringArray advice() const;
    juce::Rectangle<int> adviceArea() const noexcept { return levelArea_; }

    void takeMix() override;
    void refresh(const DeskMoment&) override {
        if (screen_) screen_->refresh();
        if (analysis_) analysis_->refresh();
    }
    void visibilityChanged() override { takeMix(); }
    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    void pickProtocol();
    void browseProtocol();
    void browseFolder();
    void cover(MixerView& view, juce::Component& screen);
    void look();
    void listNoise();
    void pickWords();
    void browseWords();
    ListeningSettings listening() const;
    void say(const juce::String& words, Shade shade);
    StudyRun run() const; ///< what is chosen; there is a protocol

    Desk& desk_;
    std::optional<Protocol> protocol_;
    juce::String about_, words_, level_;
    Shade wordsShade_ = Shade::muted;
    std::string wordsPath_; // chosen here; empty: the protocol's
    juce::ComboBox choice_, noise_, noiseLevel_, wordsChoice_, answersChoice_;
    juce::Label choiceName_, codeName_, numberName_, folderName_, noiseName_, noiseLevelName_, wordsName_,
        answersName_;
    std::vector<std::vector<int>> noiseOutputs_; // as the box lists them
    juce::TextEditor code_, number_, folder_;
    std::unique_ptr<juce::TextButton> browse_, analyse_;
    juce::TextButton begin_{"Begin"};
    juce::Rectangle<int> aboutArea_, levelArea_, wordsArea_;
    std::unique_ptr<juce::FileChooser> chooser_;
    std::unique_ptr<StudyFont> font_; // of the screen
    std::unique_ptr<StudyScreen> screen_;
    std::unique_ptr<AnalysisScreen> analysis_;
    std::vector<juce::Component::SafePointer<juce::Component>> hidden_; // while the screen covers them
};

/// Shows the tab with what was chosen; what is wrong with the protocol stands there. M.
void chooseStudy(MixerView& view, const StudyCall& call);

} // namespace physvib
