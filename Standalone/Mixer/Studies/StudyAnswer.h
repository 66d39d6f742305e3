// SPDX-License-Identifier: GPL-3.0-or-later
// What a participant answers with: one component for each kind of task.
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

    std::function<void()> onAnswer; ///< one was chosen
    std::function<void()> onChange; ///< isComplete() may have changed

    /// As it stands; what it does not ask for keeps its default.
    virtual Answer answer() const = 0;
    virtual bool isComplete() const = 0;
    virtual bool isOpen() const { return false; }                 ///< may be used before everything was felt
    virtual bool takeKey(const juce::KeyPress&) { return false; } ///< keys that no part has wanted
    virtual void mark(const std::set<std::string>&) {}            ///< the labels that were felt already
    virtual std::string keys() const = 0;                         ///< how the keyboard answers, in English

    /// It may be used: the focus goes to where it was left, as when another window took it for a moment, and
    /// to the first place in the first moment.
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

/// One of several: a click marks it, and asks for it while exploring; until it is confirmed another one may
/// be marked.
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

/// For the trial at hand; all outlive it. M.
std::unique_ptr<StudyAnswer> makeStudyAnswer(const Experiment& experiment, const LayoutDescription& layout,
                                             const StudyWords& words);

// Those of files of their own.
std::unique_ptr<StudyAnswer> makePatternAnswer(const ConditionPlan& condition,
                                               const LayoutDescription& layout, const StudyWords& words);
std::unique_ptr<StudyAnswer> makeCellAnswer(const GridSet& grid, const LayoutDescription& layout);
std::unique_ptr<StudyAnswer> makePlaceAnswer(const LayoutDescription& layout);

} // namespace physvib
