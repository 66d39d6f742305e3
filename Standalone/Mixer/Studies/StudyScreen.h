// SPDX-License-Identifier: GPL-3.0-or-later
// Screen of a study for the participant: breaks, stimuli, answers, end. It is only the user interface;
// StudyInProgress selects trials and stores answers.
#pragma once
#include "Host/Views/WorldPictures.h"
#include "Lab/Study/StudyRun.h"
#include "Mixer/Studies/StudyAnswers.h"
#include "Mixer/Studies/StudyPlayback.h"

namespace physvib {

/// Fills its parent. Keys: Space plays, Esc silences; the answer component has its own.
class StudyScreen final : public juce::Component {
public:
    /// With `answersElsewhere`, answers are given in a separate window, on another display if there is one.
    StudyScreen(MixerModel& model, std::unique_ptr<StudyInProgress> study, Words words = {},
                bool answersElsewhere = false, std::vector<MaterialPicture> pictures = {});
    ~StudyScreen() override;

    /// Called when the participant has finished or leaves; all answers are in the file.
    std::function<void()> onClose;

    const StudyInProgress& study() const noexcept { return *study_; }
    const StudyWords& words() const noexcept { return say_; }
    enum class Page { pause, trial, comment, done, exposed, fault, paused };
    Page page() const noexcept { return page_; }
    int plays() const noexcept { return progress_ ? progress_->plays() : 0; } ///< of the current trial
    bool isFeeling() const { return sound_.isPlaying() || pane_.isPlaying(); }
    StudyWorldPane& world() noexcept { return pane_; }
    StudyAnswerPane& answers() noexcept { return answers_; }

    /// The window is to be closed: a running study pauses and says so; then, and at its end, it closes.
    void closeRequested();

    /// Updates breaks, playback and the answer. To be called about 30 times a second.
    void refresh();

    bool keyPressed(const juce::KeyPress& key) override;
    void paint(juce::Graphics& g) override;
    void resized() override;
    void parentSizeChanged() override;

private:
    void showNext();
    void showPage(Page page);
    void showTrial();
    void showParts();
    void previewWorld();
    void fail(const std::string& reason);
    void note(std::string_view event); ///< into the file of times
    void goOn();
    void leave();
    void play(std::size_t part);
    std::string begin(std::size_t part);
    void playWanted();
    void playSequence();
    void pause();
    void asked();
    void confirm();
    void submit(Answer answer);
    void submitComment();
    void noteFelt();
    void settle(Course course);
    void markFelt();
    std::string markerWords(const char* what) const;
    double exposure() const;
    bool isExposed() const { return exposure() >= study_->protocol().exposureLimit; }
    bool isExploring() const;
    bool canAnswer() const;
    bool isTimeOver();
    const WorldSet* worldSet() const {
        return page_ == Page::trial && !experiment().session().isOnce
                   ? std::get_if<WorldSet>(&experiment().condition().stimuli)
                   : nullptr;
    }
    bool hasHands() const { return worldSet() != nullptr && worldSet()->hasHands; }
    bool isAnswerSeen() const;
    Course course() const { return worldSet() != nullptr ? pane_.world().course() : sound_.course(); }
    /// Nothing is posted while no samples run: it would wait, and be felt at once later.
    bool isWaiting() const { return !model_.output().isPlaying(); }
    /// Duration felt of the current or last part.
    double feltSeconds() const {
        return worldSet() != nullptr ? pane_.world().feltSeconds() : sound_.feltSeconds();
    }
    double restLeft() const;
    std::size_t nextPart() const;
    void updateTrial();
    void updateParts();
    void updatePause();
    void placeTrial(juce::Rectangle<int> area);
    void drawMaterials(juce::Graphics& g) const;
    /// Materials of the session's worlds, by the names of stimuli and objects.
    std::vector<MaterialLegend> materialsSeen() const;
    juce::String headline() const, body() const, wrong() const, progressWords() const, feedback() const;
    const Experiment& experiment() const noexcept { return study_->experiment(); }

    MixerModel& model_;
    std::unique_ptr<StudyInProgress> study_;
    const StudyWords say_;
    const std::vector<MaterialPicture> pictures_;
    StudySound sound_;
    StudyWorldPane pane_;
    const double squaresBefore_; // exposure of the participant's day in g^2 s, before what the mixer measures
                                 // from now on
    StudyAnswerPane answers_;
    StudyMarkers markers_;
    const juce::String troubleBefore_;           // told to the experimenter, not to the participant
    bool isToBeMarked_ = false;                  ///< a part was started, and its marker is not sent yet
    std::unique_ptr<juce::Component> elsewhere_; // the separate window for answers
    Page page_ = Page::pause;
    std::string fault_;

    // current trial:
    LayoutDescription layout_;
    std::optional<TrialProgress> progress_;
    std::optional<Answer> exploring_; // being played, to be recorded afterwards
    std::vector<std::unique_ptr<BigButton>> parts_;
    std::optional<std::size_t> wanted_; // a world that starts when the previous one has faded out
    std::vector<std::string> sessions_; // sessions felt in this trial
    std::vector<FeltLevel> felt_;       // by part
    std::size_t part_ = 0;
    double endedMs_ = 0.0;              // when that part ended
    std::optional<bool> wasRight_;      // the answer before, if the session gives feedback
    bool ranOut_ = false;               // the trial before
    std::optional<double> openSeconds_; // since an answer is accepted
    double updatedMs_ = 0.0;
    std::vector<int> unlike_; // by part: plays at another level than planned
    bool isLost_ = false;     // the last play did not leave, and is to be felt again
    double limiterDb_ = 0.0;  // maximum gain reduction observed in this trial
    double counted_ = 0.0, firstFeltMs_ = 0.0, restEndsMs_ = 0.0;

    BigButton next_{"Next", "Next"}, pause_{"Pause", "Pause"};
    juce::TextEditor comment_;
    juce::TextButton silence_;
    std::unique_ptr<juce::TextButton> leave_;
    juce::String shown_;
    juce::Rectangle<int> headArea_, questionArea_, bodyArea_, keysArea_;
};

/// Settings of the apparatus now. Message thread.
Apparatus apparatusOf(MixerModel& model);

/// Empty, or why the study cannot be played in this mixer, checked with the first stimulus of each condition.
/// Message thread.
std::string feltFault(const Protocol& protocol, MixerModel& model);

/// Empty, or why the study's layouts cannot be felt on the outputs that there are now. Fast. Message thread.
std::string outputsFault(const Protocol& protocol, const MixerModel& model);

} // namespace physvib
