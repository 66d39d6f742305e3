// SPDX-License-Identifier: GPL-3.0-or-later
// Answers without a place: labels, alternatives, scales, a level, a number.
#include "Files/Text/NumberText.h"
#include "Mixer/Studies/StudyAnswer.h"
#include "Mixer/Studies/StudyParts.h"
#include <cmath>

namespace physvib {
namespace {

constexpr int space = 16;

/// In the upper part of `area`, near what is felt.
juce::Rectangle<int> column(juce::Rectangle<int> area, int width, int height) {
    const int high = std::min(height, area.getHeight());
    return area.withTrimmedTop((area.getHeight() - high) / 4).withHeight(high).withSizeKeepingCentre(std::min(width, area.getWidth()), high);
}

/// A button for each label.
class LabelAnswer final : public ChosenAnswer {
public:
    explicit LabelAnswer(const ConditionPlan& condition) {
        setTitle("Stimuli");
        for (const StimulusItem& item : stimuliOf(condition)) {
            auto& button = buttons_.emplace_back(std::make_unique<BigButton>(utf8(item.label), utf8(item.label)));
            labels_.push_back(item.label);
            button->onClick = [this, label = item.label] { choose(label); };
            addAndMakeVisible(*button);
        }
    }
    juce::String keys() const override { return "Arrows and Enter: answer."; }
    bool takeKey(const juce::KeyPress& key) override { return moveFocus(*this, key); }
    void mark(const std::set<std::string>& felt) override {
        for (std::size_t i = 0; i < buttons_.size(); ++i) buttons_[i]->setMarked(felt.contains(labels_[i]));
    }
    void resized() override {
        const int count = static_cast<int>(buttons_.size());
        const int across = std::max(1, static_cast<int>(std::ceil(std::sqrt(0.6 * count)))), down = (count + across - 1) / across;
        auto area = column(getLocalBounds(), 260 * across, 84 * down);
        for (int i = 0; i < count; ++i)
            buttons_[static_cast<std::size_t>(i)]->setBounds(juce::Rectangle<int>{area.getX() + i % across * area.getWidth() / across, area.getY() + i / across * area.getHeight() / down,
                                                                                  area.getWidth() / across, area.getHeight() / down}
                                                                 .reduced(5));
    }

private:
    std::vector<std::unique_ptr<BigButton>> buttons_;
    std::vector<std::string> labels_;
};

/// One of the parts, by its number: what they are called stays unsaid.
class ChoiceAnswer final : public ChosenAnswer {
public:
    explicit ChoiceAnswer(const Trial& trial)
        : parts_{trial.parts} {
        setTitle("Choice");
        for (int i = 0; i < static_cast<int>(parts_.size()); ++i) {
            const auto words = "The " + ordinal(i);
            auto& button = buttons_.emplace_back(std::make_unique<BigButton>(words, "Answer: " + words.toLowerCase()));
            button->setWords(words, "key " + juce::String{i + 1});
            button->onClick = [this, i] { choosePart(i); };
            addAndMakeVisible(*button);
        }
    }
    static juce::String ordinal(int i) {
        static const juce::StringArray names{"first", "second", "third", "fourth", "fifth", "sixth"};
        return i < names.size() ? names[i] : juce::String{i + 1} + "th";
    }
    juce::String keys() const override { return "1, 2: answer."; }
    bool takeKey(const juce::KeyPress& key) override {
        const int i = static_cast<int>(key.getTextCharacter() - '1');
        if (isEnabled() && i >= 0 && i < static_cast<int>(parts_.size())) return choosePart(i), true;
        return moveFocus(*this, key);
    }
    void resized() override {
        const int count = static_cast<int>(buttons_.size());
        auto area = column(getLocalBounds(), 320 * count, 150);
        const int width = area.getWidth() / count;
        for (auto& button : buttons_) button->setBounds(area.removeFromLeft(width).reduced(space / 2));
    }

private:
    void choosePart(int i) { choose(parts_[static_cast<std::size_t>(i)]); }
    const std::vector<std::string> parts_;
    std::vector<std::unique_ptr<BigButton>> buttons_;
};

/// A slider for each scale; one that was not moved has not answered.
class RatingAnswer final : public StudyAnswer {
public:
    explicit RatingAnswer(const SessionPlan& session) {
        setTitle("Ratings");
        for (const std::string& name : session.scales) {
            auto& scale = scales_.emplace_back(std::make_unique<Scale>());
            const auto title = utf8(name).substring(0, 1).toUpperCase() + utf8(name).substring(1);
            scale->name.setText(title, juce::dontSendNotification);
            scale->name.setFont(juce::Font{text::large});
            scale->slider.setTitle(title);
            scale->slider.setSliderStyle(juce::Slider::LinearHorizontal);
            scale->slider.setTextBoxStyle(juce::Slider::NoTextBox, true, 0, 0);
            scale->slider.setRange(0.0, 100.0, 1.0);
            scale->slider.setValue(50.0, juce::dontSendNotification);
            scale->slider.setWantsKeyboardFocus(true);
            scale->slider.getProperties().set(tintProperty, static_cast<juce::int64>(palette::muted.getARGB()));
            scale->slider.onValueChange = [this, s = scale.get()] { moved(*s); };
            scale->slider.onDragEnd = [this, s = scale.get()] { moved(*s); };
            addAndMakeVisible(scale->name);
            addAndMakeVisible(scale->slider);
        }
    }
    Answer answer() const override {
        Answer answer;
        for (const auto& scale : scales_) answer.scores.push_back(scale->slider.getValue());
        return answer;
    }
    bool isComplete() const override {
        return std::ranges::all_of(scales_, [](const auto& scale) { return scale->isMoved; });
    }
    bool needsNext() const override { return true; }
    juce::String keys() const override { return "Tab: next scale.  Arrows: move.  Enter: next."; }
    void paint(juce::Graphics& g) override {
        g.setFont(juce::Font{text::medium});
        for (const auto& scale : scales_) {
            g.setColour(shade(*this, Shade::muted));
            const auto below = scale->slider.getBounds().translated(0, 26).withHeight(20);
            g.drawText("not at all", below, juce::Justification::centredLeft, true);
            g.drawText("fully", below, juce::Justification::centredRight, true);
            g.setColour(shade(*this, scale->isMoved ? Shade::text : Shade::muted));
            const auto value = scale->slider.getBounds().withX(scale->slider.getRight() + space).withWidth(70);
            g.drawText(scale->isMoved ? juce::String{juce::roundToInt(scale->slider.getValue())} : juce::String{"not set"}, value, juce::Justification::centredLeft, true);
        }
    }
    void resized() override {
        const int count = static_cast<int>(scales_.size()), each = std::min(96, getHeight() / count);
        auto area = column(getLocalBounds(), 860, each * count);
        for (auto& scale : scales_) {
            auto row = area.removeFromTop(each).withSizeKeepingCentre(area.getWidth(), 52);
            scale->name.setBounds(row.removeFromLeft(160).removeFromTop(30));
            row.removeFromRight(80);
            scale->slider.setBounds(row.removeFromTop(30));
        }
    }

private:
    struct Scale {
        juce::Label name;
        juce::Slider slider;
        bool isMoved = false;
    };
    void moved(Scale& scale) {
        scale.isMoved = true;
        scale.slider.getProperties().remove(tintProperty);
        repaint();
        if (onChange) onChange();
    }
    std::vector<std::unique_ptr<Scale>> scales_;
};

/// Method of adjustment: softer or stronger, a step at a time; the level itself is not told.
class AdjustAnswer final : public StudyAnswer {
public:
    AdjustAnswer(const Adjustment& adjustment, double startDb)
        : adjustment_{adjustment}
        , db_{startDb} {
        setTitle("Level");
        for (auto* button : {&softer_, &stronger_}) addAndMakeVisible(*button);
        softer_.setWords("Softer", "arrow down");
        stronger_.setWords("Stronger", "arrow up");
        softer_.onClick = [this] { step(-1.0); };
        stronger_.onClick = [this] { step(1.0); };
    }
    Answer answer() const override {
        Answer answer;
        answer.value = db_;
        return answer;
    }
    bool isComplete() const override { return true; }
    bool needsNext() const override { return true; }
    bool isOpen() const override { return true; }
    juce::String keys() const override { return "Up, down: level.  Enter: they are equal."; }
    bool takeKey(const juce::KeyPress& key) override {
        if (!isEnabled()) return false;
        if (key.isKeyCode(juce::KeyPress::upKey)) return step(1.0), true;
        if (key.isKeyCode(juce::KeyPress::downKey)) return step(-1.0), true;
        return false;
    }
    void beginAnew() override {}
    void paint(juce::Graphics& g) override {
        g.setColour(shade(*this, Shade::well));
        g.fillRoundedRectangle(bar_, 8.0f);
        const double share = (db_ - adjustment_.leastDb) / (adjustment_.mostDb - adjustment_.leastDb);
        g.setColour(shade(*this, Shade::accent).withMultipliedAlpha(isEnabled() ? 1.0f : 0.4f));
        g.fillRoundedRectangle(bar_.withWidth(std::max(16.0f, bar_.getWidth() * static_cast<float>(share))), 8.0f);
    }
    void resized() override {
        auto area = column(getLocalBounds(), 760, 170);
        bar_ = area.removeFromTop(16).toFloat();
        area.removeFromTop(space * 2);
        softer_.setBounds(area.removeFromLeft(area.getWidth() / 2 - space / 2));
        stronger_.setBounds(area.withTrimmedLeft(space));
    }
    void enablementChanged() override { repaint(); }

private:
    void step(double ways) {
        db_ = std::clamp(db_ + ways * adjustment_.stepDb, adjustment_.leastDb, adjustment_.mostDb);
        repaint();
        if (onChange) onChange();
    }
    const Adjustment adjustment_;
    double db_;
    BigButton softer_{"Softer", "Softer"}, stronger_{"Stronger", "Stronger"};
    juce::Rectangle<float> bar_;
};

/// Magnitude estimation.
class NumberAnswer final : public StudyAnswer {
public:
    NumberAnswer() {
        setTitle("Number");
        number_.setTitle("Number");
        number_.setInputRestrictions(9, "0123456789.,");
        number_.setJustification(juce::Justification::centred);
        number_.setFont(juce::Font{text::large});
        number_.onTextChange = [this] { if (onChange) onChange(); };
        number_.setEscapeAndReturnKeysConsumed(false); // they silence, and go on
        addAndMakeVisible(number_);
    }
    Answer answer() const override {
        Answer answer;
        answer.value = parseNumber<double>(number_.getText().replaceCharacter(',', '.').toStdString()).value_or(0.0);
        return answer;
    }
    bool isComplete() const override { return answer().value > 0.0; }
    bool needsNext() const override { return true; }
    juce::String keys() const override { return "Type a number, then Enter."; }
    bool takeKey(const juce::KeyPress& key) override { return isEnabled() && number_.keyPressed(key); } // typed while the focus was elsewhere
    void beginAnew() override { number_.grabKeyboardFocus(); }
    void resized() override { number_.setBounds(column(getLocalBounds(), 260, 64)); }
    void enablementChanged() override {
        if (isEnabled()) number_.applyColourToAllText(shade(*this, Shade::text));
    }

private:
    struct Editor final : juce::TextEditor {
        bool keyPressed(const juce::KeyPress& key) override { return !key.isKeyCode(juce::KeyPress::spaceKey) && juce::TextEditor::keyPressed(key); } // it feels again
    } number_;
};

} // namespace

std::unique_ptr<StudyAnswer> makeLabelAnswer(const ConditionPlan& condition) { return std::make_unique<LabelAnswer>(condition); }
std::unique_ptr<StudyAnswer> makeChoiceAnswer(const Trial& trial) { return std::make_unique<ChoiceAnswer>(trial); }
std::unique_ptr<StudyAnswer> makeRatingAnswer(const SessionPlan& session) { return std::make_unique<RatingAnswer>(session); }
std::unique_ptr<StudyAnswer> makeAdjustAnswer(const Adjustment& adjustment, double startDb) { return std::make_unique<AdjustAnswer>(adjustment, startDb); }
std::unique_ptr<StudyAnswer> makeNumberAnswer() { return std::make_unique<NumberAnswer>(); }

namespace {

std::unique_ptr<StudyAnswer> labelled(const ConditionPlan& condition, const LayoutDescription& layout) {
    if (std::holds_alternative<PatternSet>(condition.stimuli)) return makePatternAnswer(condition, layout);
    if (const auto* grid = std::get_if<GridSet>(&condition.stimuli)) return makeCellAnswer(*grid, layout);
    return makeLabelAnswer(condition);
}

} // namespace

std::unique_ptr<StudyAnswer> makeStudyAnswer(const Experiment& experiment, const LayoutDescription& layout) {
    const SessionPlan& session = experiment.session();
    switch (session.task) {
    case StudyTask::explore: return session.fewestTouches > 0 ? makePlaceAnswer(layout) : labelled(experiment.condition(), layout);
    case StudyTask::identify: return labelled(experiment.condition(), layout);
    case StudyTask::locate: return makePlaceAnswer(layout);
    case StudyTask::choose: return makeChoiceAnswer(experiment.trial());
    case StudyTask::rate: return makeRatingAnswer(session);
    case StudyTask::adjust: return makeAdjustAnswer(*session.adjustment, experiment.trial().levelDb);
    case StudyTask::estimate: return makeNumberAnswer();
    }
    return nullptr;
}

} // namespace physvib
