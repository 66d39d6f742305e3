// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of participants' screens: large buttons, a field with its actuators, arrow keys, texts; and
// components with which participants answer, one for each kind of task.
#pragma once
#include "Lab/Files/Translation.h"
#include "Lab/Study/Experiment.h"
#include "Lab/Study/Identification.h"
#include "Lab/Study/Protocol.h"
#include "Mixer/Widgets/MixerWidgets.h"
#include <set>

namespace physvib {

/// In pixels: left and right margin of the screens that fill the window, and width of their silence button.
constexpr int pageInset = 40, silenceButtonWidth = 160;

/// A screen over its parent, with a silence button because the session below keeps running. Message thread.
class FullScreen : public juce::Component {
public:
    std::function<void()> onClose; ///< called when the screen is finished or left
    void parentSizeChanged() override {
        if (auto* parent = getParentComponent()) setBounds(parent->getLocalBounds());
    }

protected:
    FullScreen(MixerModel& model, const juce::String& title);
    virtual void refresh() = 0;
    /// Sets the text of the silence button by whether the mixer is silent.
    void updateSilenceButton(const juce::String& silentText, const juce::String& playingText);
    void close() const; ///< asynchronous, because onClose deletes this component

    MixerModel& model_;
    juce::TextButton silenceButton_;
};

/// A large button with text, a smaller remark below, and a bar at its lower edge.
class BigButton final : public juce::Button {
public:
    /// `name` is for screen readers.
    BigButton(const juce::String& label, const juce::String& name);
    void setText(const juce::String& label, const juce::String& remark = {});
    void setProgress(double share); ///< of the bar, 0 to 1; negative: no bar
    /// Highlights it as the button that continues.
    void setPrimary(bool isPrimary) { setAndRepaint(*this, isPrimary_, isPrimary); }
    /// Shows a dot in its corner.
    void setMarked(bool isMarked) { setAndRepaint(*this, isMarked_, isMarked); }
    void paintButton(juce::Graphics& g, bool isOver, bool isDown) override;

private:
    juce::String label_, remark_;
    double progress_ = -1.0;
    bool isPrimary_ = false, isMarked_ = false;
};

/// Draws the background of a button in its state.
void drawButtonShape(juce::Graphics& g, const juce::Button& button, bool isOver, bool isDown,
                     float corner = 8.0f);

/// Largest centred rectangle in `area` with the layout's aspect ratio.
juce::Rectangle<float> fitField(juce::Rectangle<float> area, const ActuatorLayout& layout);
/// Place of an actuator on the field: x to the right, y downwards, 0 to 1; toPixel(): its pixel in `field`.
FieldPlace actuatorPlace(const ActuatorLayout& layout, int actuator);
juce::Point<float> toPixel(const juce::Rectangle<float>& field, const FieldPlace& place);
/// Direction of an arrow key, x to the right and y down; (0, 0): another key.
juce::Point<int> arrowDirection(const juce::KeyPress& key);
/// Moves the focus to the nearest child of `parent` in the direction of an arrow key; false for other keys.
bool moveFocus(juce::Component& parent, const juce::KeyPress& key);

/// The texts of the screens and of a protocol in the participant's language. Message thread.
class StudyTexts {
public:
    explicit StudyTexts(Translation translation = {})
        : translation_{std::move(translation)} {}

    /// Translates a text such as "trial {n}" and inserts the value of {n}; English without a translation.
    juce::String operator()(const std::string& english,
                            std::initializer_list<std::pair<const char*, juce::String>> values = {}) const;
    const std::set<std::string>& untranslated() const noexcept { return untranslated_; } ///< so far

    /// Question of a trial: the protocol's, or the task's default.
    juce::String question(const SessionPlan& session, const ConditionPlan& condition) const;
    /// What the participant does in a session, in a few lines.
    juce::String instruction(const SessionPlan& session, const ConditionPlan& condition) const;
    /// "The first" for part 0, and so on.
    juce::String ordinal(int part) const;

private:
    juce::String taskText(const TaskText& text, const ConditionPlan& condition) const;
    juce::String playText(const SessionPlan& session) const;
    Translation translation_;
    mutable std::set<std::string> untranslated_;
};

/// A component with which a participant answers one kind of task. Message thread.
class StudyAnswer : public juce::Component, private juce::FocusChangeListener {
public:
    StudyAnswer() {
        setFocusContainerType(FocusContainerType::keyboardFocusContainer);
        juce::Desktop::getInstance().addFocusChangeListener(this);
    }
    ~StudyAnswer() override { juce::Desktop::getInstance().removeFocusChangeListener(this); }

    std::function<void()> onAnswer = [] {}; ///< an answer was chosen
    std::function<void()> onChange = [] {}; ///< isComplete() may have changed

    /// The current answer; unused fields keep their defaults.
    virtual Answer answer() const = 0;
    virtual bool isComplete() const = 0;
    virtual bool canAnswerEarly() const { return false; } ///< may be answered before all parts were played
    virtual bool handleKey(const juce::KeyPress&) { return false; } ///< keys that no child used; true: used
    virtual void markPlayed(const std::set<std::string>&) {}        ///< marks labels that were already played
    virtual std::string keyHelp() const = 0;                        ///< keyboard help in English

    /// Sets the focus when answering becomes possible: to the component that had it before, e.g. before
    /// another window, or else to the first.
    void focusLast() {
        if (lastFocused_ != nullptr && lastFocused_->isEnabled())
            lastFocused_->grabKeyboardFocus();
        else
            focusFirst();
    }

protected:
    virtual void focusFirst() {
        for (auto* child : getChildren())
            if (child->getWantsKeyboardFocus() && child->isEnabled()) return child->grabKeyboardFocus();
    }

private:
    void globalFocusChanged(juce::Component* focused) override {
        if (isParentOf(focused)) lastFocused_ = focused;
    }

    juce::Component::SafePointer<juce::Component> lastFocused_;
};

/// Choice among several buttons. A click marks one, and while exploring also plays it. The choice can change
/// until it is confirmed.
class ButtonAnswer : public StudyAnswer {
public:
    Answer answer() const override { return {.response = response_, .place = {}, .scores = {}}; }
    bool isComplete() const override { return !response_.empty(); }

protected:
    /// Lets a click on `button` choose `response`.
    void addChoice(juce::Button& button, const std::string& response) {
        choices_.emplace_back(&button, response);
        button.onClick = [this, response] { choose(response); };
    }
    void choose(const std::string& response) {
        response_ = response;
        for (const auto& [button, choice] : choices_)
            button->setToggleState(choice == response, juce::dontSendNotification);
        onChange();
        onAnswer();
    }

private:
    std::string response_;
    std::vector<std::pair<juce::Button*, std::string>> choices_;
};

/// Creates the answer component of the current trial. All arguments outlive it. Message thread.
std::unique_ptr<StudyAnswer> makeStudyAnswer(const Experiment& experiment, const LayoutDescription& layout,
                                             const StudyTexts& texts);

/// The letter (A, B, C ...) that names a part rated side by side. Any thread.
inline juce::String partLetter(std::size_t part) {
    return juce::String::charToString(static_cast<juce::juce_wchar>('A' + part));
}

// Answers on the field, in StudyFieldAnswers.cpp:
std::unique_ptr<StudyAnswer> makePatternAnswer(const ConditionPlan& condition,
                                               const LayoutDescription& layout, const StudyTexts& texts);
std::unique_ptr<StudyAnswer> makeCellAnswer(const GridSet& grid, const LayoutDescription& layout);
std::unique_ptr<StudyAnswer> makePlaceAnswer(const LayoutDescription& layout);

/// Pane for answering a trial and confirming the answer, below the stimuli or in a separate window.
/// Message thread.
class StudyAnswerPane final : public juce::Component {
public:
    explicit StudyAnswerPane(const StudyTexts& texts);

    std::function<void()> onConfirm = [] {};
    /// Handles keys that no control here used.
    std::function<bool(const juce::KeyPress&)> onKey;

    void show(std::unique_ptr<StudyAnswer> answer); ///< null: no answer component
    StudyAnswer* operator->() const noexcept { return answer_.get(); }
    explicit operator bool() const noexcept { return answer_ != nullptr; }
    void setConfirm(bool isShown, bool isEnabled, const juce::String& label);
    bool confirm();      ///< as a click on the button; false if it is disabled
    void focusConfirm(); ///< focuses the button, so that Enter confirms
    /// Displayed only in a separate window.
    void setQuestion(const juce::String& question) { setAndRepaint(*this, question_, question); }
    void setSeparateWindow(bool isSeparateWindow) { isSeparateWindow_ = isSeparateWindow; }
    bool isSeparateWindow() const noexcept { return isSeparateWindow_; }

    bool keyPressed(const juce::KeyPress& key) override { return onKey && onKey(key); }
    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    const StudyTexts& translate_;
    std::unique_ptr<StudyAnswer> answer_;
    BigButton confirm_{"Next", "Next"};
    juce::String question_;
    juce::Rectangle<int> questionArea_, keyHelpArea_;
    bool isSeparateWindow_ = false;
};

/// A window for `pane`, full screen on another display if there is one. The pane outlives it. Message thread.
std::unique_ptr<juce::Component> makeAnswerWindow(StudyAnswerPane& pane, const juce::Component& studyScreen);

} // namespace physvib
