// SPDX-License-Identifier: GPL-3.0-or-later
// Components with which participants answer, one for each kind of task.
#pragma once
#include "Lab/Study/Experiment.h"
#include "Mixer/Studies/StudyWords.h"
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
    virtual bool isOpen() const { return false; }                 ///< can be used before all parts were felt
    virtual bool takeKey(const juce::KeyPress&) { return false; } ///< keys that no child component used
    virtual void mark(const std::set<std::string>&) {}            ///< labels that were already felt
    virtual std::string keys() const = 0;                         ///< keyboard help in English

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

// Implemented in files of their own:
std::unique_ptr<StudyAnswer> makePatternAnswer(const ConditionPlan& condition,
                                               const LayoutDescription& layout, const StudyWords& words);
std::unique_ptr<StudyAnswer> makeCellAnswer(const GridSet& grid, const LayoutDescription& layout);
std::unique_ptr<StudyAnswer> makePlaceAnswer(const LayoutDescription& layout);

} // namespace physvib
