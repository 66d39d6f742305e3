// SPDX-License-Identifier: GPL-3.0-or-later
// Where a trial is answered and the answer confirmed: below what is felt, or in a window of its own.
#pragma once
#include "Mixer/Studies/StudyAnswer.h"
#include "Mixer/Studies/StudyParts.h"

namespace physvib {

/// M only.
class StudyAnswerPane final : public juce::Component {
public:
    explicit StudyAnswerPane(const StudyWords& words);

    std::function<void()> onConfirm;
    /// A key that no control here has wanted; the screen knows what to do with it.
    std::function<bool(const juce::KeyPress&)> onKey;

    void show(std::unique_ptr<StudyAnswer> answer); ///< null: nothing is asked
    StudyAnswer* operator->() const noexcept { return answer_.get(); }
    explicit operator bool() const noexcept { return answer_ != nullptr; }
    void setConfirm(bool isSeen, bool isEnabled, const juce::String& words);
    bool confirm();                                 ///< as its button; false if that may not be pressed
    void focusConfirm();                            ///< Enter goes on from here
    void setQuestion(const juce::String& question); ///< where nothing else says it
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

/// A window for `pane`, over the whole of another display if there is one; the pane outlives it. M.
std::unique_ptr<juce::Component> makeAnswerWindow(StudyAnswerPane& pane, const juce::Component& beside);

} // namespace physvib
