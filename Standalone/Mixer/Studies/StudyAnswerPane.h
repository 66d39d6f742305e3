// SPDX-License-Identifier: GPL-3.0-or-later
// Pane for answering a trial and confirming the answer, below the stimuli or in a separate window.
#pragma once
#include "Mixer/Studies/StudyAnswer.h"
#include "Mixer/Studies/StudyParts.h"

namespace physvib {

/// Message thread only.
class StudyAnswerPane final : public juce::Component {
public:
    explicit StudyAnswerPane(const StudyWords& words);

    std::function<void()> onConfirm;
    /// Handles keys that no control here used.
    std::function<bool(const juce::KeyPress&)> onKey;

    void show(std::unique_ptr<StudyAnswer> answer); ///< null: no answer component
    StudyAnswer* operator->() const noexcept { return answer_.get(); }
    explicit operator bool() const noexcept { return answer_ != nullptr; }
    void setConfirm(bool isSeen, bool isEnabled, const juce::String& words);
    bool confirm();                                 ///< as a click on the button; false if it is disabled
    void focusConfirm();                            ///< then Enter confirms
    void setQuestion(const juce::String& question); ///< shown where no other component shows it
    void setStandsAlone(bool standsAlone) { standsAlone_ = standsAlone; }
    bool standsAlone() const noexcept { return standsAlone_; }

    bool keyPressed(const juce::KeyPress& key) override { return onKey && onKey(key); }
    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    const StudyWords& say_;
    std::unique_ptr<StudyAnswer> answer_;
    BigButton confirm_{"Next", "Next"};
    juce::String question_;
    juce::Rectangle<int> questionArea_, keysArea_;
    bool standsAlone_ = false;
};

/// A window for `pane`, full screen on another display if there is one. The pane outlives it. Message thread.
std::unique_ptr<juce::Component> makeAnswerWindow(StudyAnswerPane& pane, const juce::Component& beside);

} // namespace physvib
