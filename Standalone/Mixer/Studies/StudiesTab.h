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

/// Shows the results of an analysis, or a given report, over the whole window. Message thread.
class AnalysisScreen final : public FullScreen {
public:
    AnalysisScreen(MixerModel& model, const std::vector<juce::File>& files);
    /// Shows `report` under `title`, without an analysis.
    AnalysisScreen(MixerModel& model, const juce::String& title, AnalysisReport report);

    /// Shows the first analysis that fits the trial files of one study, or any table that `physvib analyse`
    /// accepts.
    void analyse(const std::vector<juce::File>& files);
    const AnalysisReport& report() const noexcept { return report_; }
    const juce::Drawable* picture() const noexcept { return picture_.get(); }

    void refresh() override { updateSilenceButton("SILENT: press to feel", "SILENCE  Esc"); }

    bool keyPressed(const juce::KeyPress& key) override;
    void paint(juce::Graphics& g) override;
    void resized() override;
    void parentHierarchyChanged() override { showReport(); }

private:
    AnalysisScreen(MixerModel& model, const juce::String& title);
    void browse();
    void show(const std::string& name);
    void showReport();

    juce::String title_;
    std::vector<juce::File> files_;
    AnalysisReport report_;
    std::unique_ptr<juce::Drawable> picture_;
    juce::ComboBox analysisChoice_;
    juce::TextEditor resultText_;
    std::unique_ptr<juce::TextButton> chooseButton_, closeButton_;
    juce::Rectangle<int> titleArea_, pictureArea_;
};

/// What the command line selects in the tab; empty or 0: unchanged.
struct StudySelection {
    juce::String protocol, participant;
    int number = 0;
    juce::String folder;
};

/// The tab that selects, checks and starts studies, and opens analyses. Message thread.
class StudiesTab final : public Tab {
public:
    explicit StudiesTab(MixerModel& model);
    ~StudiesTab() override;

    /// Selects a built-in protocol or a file; empty, or an error.
    std::string chooseProtocol(const std::string& nameOrPath);
    void setParticipant(const juce::String& code, int number);
    void setFolder(const juce::File& folder);
    /// Outputs without an actuator, for headphones: first in pairs, then single; numbered from 0.
    std::vector<std::vector<int>> noiseChoices() const;
    /// Plays pink noise during the study, `db` of full scale (root mean square); no outputs: no noise.
    void setNoise(const std::vector<int>& outputs, double db);

    /// Selects the participant's language: a built-in translation, a file, or "" for the protocol's. Returns
    /// an error line, or an empty string.
    std::string chooseLanguage(const std::string& nameOrPath);
    /// Shows answers in a separate window, on another display if there is one.
    void setAnswerWindow(bool hasWindow);

    /// Starts or continues the study on a screen that covers the window. Returns an error, also shown, or "".
    std::string begin();
    /// Analyses the files on a screen that covers the window; no files: the participant's trials.
    void analyse(std::vector<juce::File> files = {});
    AnalysisScreen* analysis() noexcept { return analysis_.get(); }
    StudyScreen* screen() noexcept { return screen_.get(); }
    std::function<void()> makeCloseCallback(); ///< calls end(), if the tab still exists
    void end();                                ///< closes the open screen

    /// What remains to be done before a study starts, one line each, as many as fit.
    juce::StringArray advice() const;
    juce::Rectangle<int> adviceArea() const noexcept { return adviceArea_; }

    const MasterStrip& master() const noexcept { return master_; } ///< beside Begin

    void mixChanged() override;
    int minHeight(int) const override { return controlsHeight; }
    /// Result of the check of the protocol; none while it runs. It runs while the tab is visible.
    const std::optional<StudyCheck>& check() const noexcept { return check_; }

    void refresh(const MixerSnapshot& snapshot) override {
        updateCheck();
        master_.refresh(snapshot);
        if (screen_) screen_->refresh();
        if (analysis_) analysis_->refresh();
    }
    void visibilityChanged() override { mixChanged(); }
    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    static constexpr int controlsHeight = 256; // pixels, with a line of advice
    void handleProtocolChoice();               ///< the user chose in the list of protocols
    static bool isDone(const StudyRun& run, const std::vector<TrialRecord>& records);
    void offerLayout();
    void offerLevel(double db);
    void chooseNoise(const std::vector<int>& outputs);
    void refreshStatus();        ///< shows the state of the trial file, and what Begin would do
    void refreshNoiseChoices();  ///< lists the free outputs
    void handleLanguageChoice(); ///< the user chose in the list of languages
    ListeningSettings listening() const;
    void setStatus(const juce::String& message, Shade shade); ///< text beside Begin
    void stopCheck();
    void updateCheck();
    void showFindings();          ///< opens the report of the check
    StudyRun selectedRun() const; ///< the selection; precondition: there is a protocol

    MixerModel& model_;
    std::optional<Protocol> protocol_;
    juce::String description_, status_, levelAdvice_;
    juce::String outputsError_, lastBeginError_; // error of the outputs; error of the last begin()
    Shade statusShade_ = Shade::muted;
    std::string languagePath_; // selected here; empty: the protocol's
    juce::ComboBox protocolChoice_, noiseChoice_, noiseLevel_, languageChoice_, answersChoice_;
    Caption protocolLabel_{"Protocol"}, codeLabel_{"Participant's code"}, numberLabel_{"Number"},
        folderLabel_{"Folder of the trial files"}, noiseLabel_{"Pink noise on"}, noiseLevelLabel_{"At"},
        languageLabel_{"Participants read"}, answersLabel_{"Answers"};
    std::vector<std::vector<int>> noiseOutputs_; // in the order of the list
    juce::TextEditor code_, number_, folder_;
    std::unique_ptr<juce::TextButton> browse_, analyse_, findings_;
    std::optional<StudyCheck> check_; // of protocol_
    bool beginsAfterCheck_ = false;   // Begin was pressed during the check
    MasterStrip master_{model_, true};
    juce::TextButton begin_{"Begin"};
    juce::Rectangle<int> descriptionArea_, adviceArea_;
    std::unique_ptr<TypefaceOverride> typeface_; // of the study screen
    std::unique_ptr<StudyScreen> screen_;
    std::unique_ptr<AnalysisScreen> analysis_;
    std::atomic<bool> keepsChecking_{false};
    std::future<StudyCheck> checkFuture_; // the last member, as its destructor awaits the check
};

} // namespace physvib
