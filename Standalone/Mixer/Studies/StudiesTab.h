// SPDX-License-Identifier: GPL-3.0-or-later
// Mixer tab that selects a study, a participant and an output folder, then covers the window with the study's
// screen, or with the analysis of its trials: figures of `physvib analyse`, warnings and picture.
#pragma once
#include "Lab/Analysis/Analysis.h"
#include "Mixer/Studies/StudyScreen.h"
#include "Mixer/Widgets/Typefaces.h"
#include "Studies/StudyCheck.h"
#include <atomic>
#include <future>

namespace physvib {

class AnalysisScreen final : public FullScreen {
public:
    AnalysisScreen(MixerModel& model, const std::vector<juce::File>& files);
    /// Shows this report instead, under that title.
    AnalysisScreen(MixerModel& model, const juce::String& title, AnalysisReport report);

    /// Shows the first analysis that fits the trial files of one study, or any table that `physvib analyse`
    /// accepts.
    void analyse(const std::vector<juce::File>& files);
    const AnalysisReport& report() const noexcept { return report_; }
    const juce::Drawable* picture() const noexcept { return picture_.get(); }

    void refresh() override { showSilence("SILENT: press to feel", "SILENCE  Esc"); }

    bool keyPressed(const juce::KeyPress& key) override;
    void paint(juce::Graphics& g) override;
    void resized() override;
    void parentHierarchyChanged() override { showWords(); }

private:
    AnalysisScreen(MixerModel& model, const juce::String& title);
    void browse();
    void run(const std::string& name);
    void showWords();

    juce::String title_;
    std::vector<juce::File> files_;
    AnalysisReport report_;
    std::unique_ptr<juce::Drawable> picture_;
    juce::ComboBox kind_;
    juce::TextEditor words_;
    std::unique_ptr<juce::TextButton> choose_, close_;
    juce::Rectangle<int> titleArea_, pictureArea_;
};

/// Selections by the command line; empty or 0: unchanged.
struct StudyCall {
    juce::String protocol, participant;
    int number = 0;
    juce::String folder;
};

class StudiesTab final : public Tab {
public:
    explicit StudiesTab(MixerModel& model);
    ~StudiesTab() override;

    /// Selects a built-in protocol or a file; empty, or an error.
    std::string chooseProtocol(const std::string& nameOrPath);
    void setParticipant(const juce::String& code, int number);
    void setFolder(const juce::File& folder);
    /// Outputs for headphones without an actuator, in pairs and single, from 0.
    std::vector<std::vector<int>> noiseChoices() const;
    /// Pink noise during the study; no noise without outputs.
    void setNoise(const std::vector<int>& outputs, double db);

    /// Texts for the participant: a built-in translation, a file, or "" for the protocol's. Empty, or an
    /// error.
    std::string chooseWords(const std::string& nameOrPath);
    /// Shows answers in a separate window, on another display if there is one.
    void setAnswersElsewhere(bool areElsewhere);

    /// Starts or continues the study; its screen covers the window. Empty, or an error, which is also
    /// displayed.
    std::string begin();
    /// Analyses these files, or without any the participant's own, on a screen that covers the window.
    void analyse(std::vector<juce::File> files = {});
    AnalysisScreen* analysis() noexcept { return analysis_.get(); }
    StudyScreen* screen() noexcept { return screen_.get(); }
    std::function<void()> ending();
    void end();

    /// What remains to be done before a study starts, one line each, as many as fit.
    juce::StringArray advice() const;
    juce::Rectangle<int> adviceArea() const noexcept { return levelArea_; }

    const MasterStrip& master() const noexcept { return master_; } ///< beside Begin

    void mixChanged() override;
    int minHeight(int) const override { return controlsHeight; }
    /// Result of the check of the protocol; none while it runs. It runs while the tab is visible.
    const std::optional<StudyCheck>& check() const noexcept { return check_; }

    void refresh(const MixerMoment& moment) override {
        updateCheck();
        master_.refresh(moment);
        if (screen_) screen_->refresh();
        if (analysis_) analysis_->refresh();
    }
    void visibilityChanged() override { mixChanged(); }
    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    static constexpr int controlsHeight = 256; // with a line of advice
    void pickProtocol();                       ///< handles the list of protocols
    static bool isDone(const StudyRun& run, const std::vector<TrialRecord>& records);
    void offerLayout();
    void offerLevel(double db);
    void chooseNoise(const std::vector<int>& outputs);
    void look();      ///< shows the state of the trial file, and what Begin would do
    void listNoise(); ///< lists the free outputs
    void pickWords(); ///< handles the list of languages
    ListeningSettings listening() const;
    void say(const juce::String& words, Shade shade); ///< beside Begin
    void stopCheck();
    void updateCheck();
    void showFindings();  ///< opens the report of the check
    StudyRun run() const; ///< the selection; precondition: there is a protocol

    MixerModel& model_;
    std::optional<Protocol> protocol_;
    juce::String about_, words_, level_;
    juce::String outputs_, refused_; // what outputs lack, and the last refusal, until something changes
    Shade wordsShade_ = Shade::muted;
    std::string wordsPath_; // selected here; empty: the protocol's
    juce::ComboBox choice_, noise_, noiseLevel_, wordsChoice_, answersChoice_;
    Caption choiceName_{"Protocol"}, codeName_{"Participant's code"}, numberName_{"Number"},
        folderName_{"Folder of the trial files"}, noiseName_{"Pink noise on"}, noiseLevelName_{"At"},
        wordsName_{"Participants read"}, answersName_{"Answers"};
    std::vector<std::vector<int>> noiseOutputs_; // in the order of the list
    juce::TextEditor code_, number_, folder_;
    std::unique_ptr<juce::TextButton> browse_, analyse_, findings_;
    std::optional<StudyCheck> check_; // of protocol_
    bool isBeginWanted_ = false;      // as soon as the check is finished
    MasterStrip master_{model_, true};
    juce::TextButton begin_{"Begin"};
    juce::Rectangle<int> aboutArea_, levelArea_;
    std::unique_ptr<StudyFont> font_; // of the study screen
    std::unique_ptr<StudyScreen> screen_;
    std::unique_ptr<AnalysisScreen> analysis_;
    std::atomic<bool> isCheckWanted_{false};
    std::future<StudyCheck> checking_; // the last member: it is waited for first
};

} // namespace physvib
