// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of participants' screens: large buttons, a field with its actuators, arrow keys, texts; and
// components with which participants answer, one for each kind of task.
#pragma once
#include "Lab/Files/Words.h"
#include "Lab/Study/Experiment.h"
#include "Lab/Study/Identification.h"
#include "Lab/Study/Protocol.h"
#include "Mixer/Widgets/Parts.h"
#include <set>

namespace physvib {

/// Left and right margin of the screens that fill the window, in pixels.
constexpr int pageInset = 40;

/// Covers its parent, with a silence button, because the session behind it keeps running. Message thread.
class FullScreen : public juce::Component {
public:
    std::function<void()> onClose; ///< the screen is finished or left
    void parentSizeChanged() override {
        if (auto* parent = getParentComponent()) setBounds(parent->getLocalBounds());
    }

protected:
    FullScreen(MixerModel& model, const juce::String& title);
    virtual void refresh() = 0;
    void showSilence(const juce::String& on, const juce::String& off); ///< texts of the button
    void close() const; ///< later, because it deletes this component

    MixerModel& model_;
    juce::TextButton silence_;
};

/// A large button with text, a smaller remark below, and a bar at its lower edge.
class BigButton final : public juce::Button {
public:
    /// `name` is for screen readers.
    BigButton(const juce::String& words, const juce::String& name);
    void setWords(const juce::String& words, const juce::String& remark = {});
    void setShare(double share); ///< of the bar, 0 to 1; negative: no bar
    /// The button that continues.
    void setMain(bool isMain) { setShown(*this, isMain_, isMain); }
    /// Shows a dot.
    void setMarked(bool isMarked) { setShown(*this, isMarked_, isMarked); }
    void paintButton(juce::Graphics& g, bool isOver, bool isDown) override;

private:
    juce::String words_, remark_;
    double share_ = -1.0;
    bool isMain_ = false, isMarked_ = false;
};

/// Draws the background of a button in its state.
void drawTarget(juce::Graphics& g, const juce::Button& button, bool isOver, bool isDown, float corner = 8.0f);

/// Largest centred rectangle in `area` with the layout's aspect ratio.
juce::Rectangle<float> fieldIn(juce::Rectangle<float> area, const EnchanterLayout& layout);
/// Place of an actuator on the field: x to the right, y downwards, 0 to 1.
FieldPlace placeOf(const EnchanterLayout& layout, int enchanter);
juce::Point<float> pointOn(const juce::Rectangle<float>& field, const FieldPlace& place);
/// Direction of an arrow key, x to the right and y down; (0, 0): another key.
juce::Point<int> wayOf(const juce::KeyPress& key);
/// Moves the focus to the nearest child of `parent` in the direction of an arrow key; false for other keys.
bool moveFocus(juce::Component& parent, const juce::KeyPress& key);

/// The texts of the screens and of a protocol in the participant's language. Message thread.
class StudyWords {
public:
    explicit StudyWords(Words words = {})
        : words_{std::move(words)} {}

    /// "trial {n}" with the value of {n}. Without a translation: English, and recorded in missed().
    juce::String operator()(const std::string& english,
                            std::initializer_list<std::pair<const char*, juce::String>> values = {}) const;
    const std::set<std::string>& missed() const noexcept { return missed_; }

    /// Question of a trial: the protocol's, or the task's default.
    juce::String question(const SessionPlan& session, const ConditionPlan& condition) const;
    /// What the participant does in a session, in a few lines.
    juce::String instruction(const SessionPlan& session, const ConditionPlan& condition) const;
    /// "the first", for the parts to choose from.
    juce::String ordinal(int part) const;

private:
    juce::String lines(const TaskText& text, const ConditionPlan& condition) const;
    juce::String feel(const SessionPlan& session) const;
    Words words_;
    mutable std::set<std::string> missed_;
};

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
    Answer answer() const override { return {.response = response_, .place = {}, .scores = {}}; }
    bool isComplete() const override { return !response_.empty(); }

protected:
    /// A click on it chooses that response.
    void offer(juce::Button& button, const std::string& response) {
        offered_.emplace_back(&button, response);
        button.onClick = [this, response] { choose(response); };
    }
    void choose(const std::string& response) {
        response_ = response;
        for (const auto& [button, of] : offered_)
            button->setToggleState(of == response, juce::dontSendNotification);
        onChange();
        onAnswer();
    }

private:
    std::string response_;
    std::vector<std::pair<juce::Button*, std::string>> offered_;
};

/// Creates the answer component of the current trial. All arguments outlive it. Message thread.
std::unique_ptr<StudyAnswer> makeStudyAnswer(const Experiment& experiment, const LayoutDescription& layout,
                                             const StudyWords& words);

/// The letter (A, B, C ...) that names a part rated side by side. Any thread.
inline juce::String partLetter(std::size_t part) {
    return juce::String::charToString(static_cast<juce::juce_wchar>('A' + part));
}

// Answers on the field, in StudyFieldAnswers.cpp:
std::unique_ptr<StudyAnswer> makePatternAnswer(const ConditionPlan& condition,
                                               const LayoutDescription& layout, const StudyWords& words);
std::unique_ptr<StudyAnswer> makeCellAnswer(const GridSet& grid, const LayoutDescription& layout);
std::unique_ptr<StudyAnswer> makePlaceAnswer(const LayoutDescription& layout);

/// Pane for answering a trial and confirming the answer, below the stimuli or in a separate window.
/// Message thread.
class StudyAnswerPane final : public juce::Component {
public:
    explicit StudyAnswerPane(const StudyWords& words);

    std::function<void()> onConfirm = [] {};
    /// Handles keys that no control here used.
    std::function<bool(const juce::KeyPress&)> onKey;

    void show(std::unique_ptr<StudyAnswer> answer); ///< null: no answer component
    StudyAnswer* operator->() const noexcept { return answer_.get(); }
    explicit operator bool() const noexcept { return answer_ != nullptr; }
    void setConfirm(bool isSeen, bool isEnabled, const juce::String& words);
    bool confirm();      ///< as a click on the button; false if it is disabled
    void focusConfirm(); ///< then Enter confirms
    /// Displayed only in a separate window.
    void setQuestion(const juce::String& question) { setShown(*this, question_, question); }
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
