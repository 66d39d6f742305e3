// SPDX-License-Identifier: GPL-3.0-or-later
// Components with which participants answer, one for each kind of task.
#pragma once
#include "Lab/Study/Experiment.h"
#include "Mixer/Studies/StudyParts.h"
#include "Scene/LayoutFile.h"
#include <functional>
#include <juce_gui_basics/juce_gui_basics.h>
#include <memory>
#include <set>
#include <string>

namespace physvib {

class StudyAnswer : public juce::Component, private juce::FocusChangeListener {
public:
    StudyAnswer() {
        setFocusContainerType(FocusContainerType::keyboardFocusContainer);
        juce::Desktop::getInstance().addFocusChangeListener(this);
    }
    ~StudyAnswer() override { juce::Desktop::getInstance().removeFocusChangeListener(this); }

    std::function<void()> onAnswer; ///< an answer was chosen
    std::function<void()> onChange; ///< isComplete() may have changed

    /// The current answer; unused fields keep their defaults.
    virtual Answer answer() const = 0;
    virtual bool isComplete() const = 0;
    virtual bool isOpen() const { return false; } ///< can be used before all parts were felt
    virtual bool handleKey(const juce::KeyPress&) { return false; } ///< keys that no child component used
    virtual void mark(const std::set<std::string>&) {}              ///< labels that were already felt
    virtual std::string keys() const = 0;                           ///< keyboard help in English

    /// Sets the focus when answering becomes possible: to the component that had it before, e.g. before
    /// another window, or else to the first.
    void begin() {
        if (left_ != nullptr && left_->isEnabled())
            left_->grabKeyboardFocus();
        else
            beginAnew();
    }

protected:
    virtual void beginAnew() {
        for (auto* child : getChildren())
            if (child->getWantsKeyboardFocus() && child->isEnabled()) return child->grabKeyboardFocus();
    }

private:
    void globalFocusChanged(juce::Component* focused) override {
        if (isParentOf(focused)) left_ = focused;
    }

    juce::Component::SafePointer<juce::Component> left_;
};

/// Choice among several buttons. A click marks one, and while exploring also plays it. The choice can change
/// until it is confirmed.
class ChosenAnswer : public StudyAnswer {
public:
    Answer answer() const override {
        Answer answer;
        answer.response = response_;
        return answer;
    }
    bool isComplete() const override { return !response_.empty(); }

protected:
    void choose(std::string response) {
        response_ = std::move(response);
        showChosen(response_);
        if (onChange) onChange();
        if (onAnswer) onAnswer();
    }
    virtual void showChosen(const std::string& response) = 0;

private:
    std::string response_;
};

/// Creates the answer component of the current trial. All arguments outlive it. Message thread.
std::unique_ptr<StudyAnswer> makeStudyAnswer(const Experiment& experiment, const LayoutDescription& layout,
                                             const StudyWords& words);

/// A, B, C ...: what is rated side by side has no other name. Any thread.
inline juce::String partLetter(std::size_t part) {
    return juce::String::charToString(static_cast<juce::juce_wchar>('A' + part));
}

// Implemented in files of their own:
std::unique_ptr<StudyAnswer> makePatternAnswer(const ConditionPlan& condition,
                                               const LayoutDescription& layout, const StudyWords& words);
std::unique_ptr<StudyAnswer> makeCellAnswer(const GridSet& grid, const LayoutDescription& layout);
std::unique_ptr<StudyAnswer> makePlaceAnswer(const LayoutDescription& layout);

/// Pane for answering a trial and confirming the answer, below the stimuli or in a separate window.
/// Message thread.
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
