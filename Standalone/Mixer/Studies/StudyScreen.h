// SPDX-License-Identifier: GPL-3.0-or-later
// The window as a participant sees it: breaks, stimuli to be felt, the answer, the end. What is asked and what is kept is
// StudyRun's business: this is only somebody who answers.
#pragma once
#include "CommandLine/Study/StudyRun.h"
#include "Mixer/Studies/StudySound.h"
#include "Mixer/Studies/StudyAnswer.h"
#include "Mixer/Studies/StudyParts.h"

namespace physvib {

/// Fills its parent. Keys: Space feels, Esc silences, the answer has its own.
class StudyScreen final : public juce::Component {
public:
    StudyScreen(Desk& desk, std::unique_ptr<StudyRun> study);
    ~StudyScreen() override;

    std::function<void()> onClose; ///< the participant has finished, or leaves: everything answered is in the file

    const StudyRun& study() const noexcept { return *study_; }
    enum class Page { pause, trial, done, exposed, fault };
    Page page() const noexcept { return page_; }
    int plays() const noexcept { return progress_ ? progress_->plays() : 0; } ///< of the trial at hand
    bool isFeeling() const { return sound_.isPlaying(); }

    /// Time goes on: breaks, what is felt, what unlocks. About 30 times a second.
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
    void fail(const std::string& reason);
    void goOn();
    void leave();
    void play(std::size_t part);
    void answered();
    void take(Answer answer);
    void noteFelt();
    double exposure() const;
    bool isExposed() const { return exposure() >= study_->protocol().exposureLimit; }
    bool isExploring() const;
    bool canAnswer() const;
    double restLeft() const;
    std::size_t nextPart() const;
    void updateTrial();
    void updateParts();
    juce::String headline() const, body() const, progressWords() const;
    const Experiment& experiment() const noexcept { return study_->experiment(); }

    Desk& desk_;
    std::unique_ptr<StudyRun> study_;
    StudySound sound_;
    Page page_ = Page::pause;
    std::string fault_;
    const double squaresBefore_; // of the participant's day, in g^2 s, without what the desk sums up from now on

    // the trial at hand
    LayoutDescription layout_;
    std::optional<TrialProgress> progress_;
    std::optional<Answer> exploring_; // felt now, answered afterwards
    std::unique_ptr<StudyAnswer> answer_;
    std::vector<std::unique_ptr<BigButton>> parts_;
    std::vector<FeltLevel> felt_; // per part
    std::size_t part_ = 0;
    double counted_ = 0.0, firstFeltMs_ = 0.0, restEndsMs_ = 0.0;

    BigButton next_{"Next", "Next"};
    juce::TextButton silence_;
    std::unique_ptr<juce::TextButton> leave_;
    juce::String shown_;
    juce::Rectangle<int> headArea_, questionArea_, bodyArea_, keysArea_;
};

/// Why the study cannot be felt in this mixer, with what each condition begins with; empty if it can. M.
std::string feltFault(const Protocol& protocol, Desk& desk);

} // namespace physvib
