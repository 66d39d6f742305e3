// SPDX-License-Identifier: GPL-3.0-or-later
// The answer pane and its window, and answers by label, choice, rating, level, number and words.
#include "Host/Views/WorldView.h"
#include "Io/Text/NumberText.h"
#include "Mixer/Studies/StudyParts.h"

namespace physvib {
namespace {

constexpr int footHeight = 84;

class AnswerWindow final : public juce::DocumentWindow {
public:
    AnswerWindow(StudyAnswerPane& pane, const juce::Component& beside)
        : juce::DocumentWindow{"PhysVib: answers", palette::ground, 0, false} {
        setUsingNativeTitleBar(true);
        setLookAndFeel(&beside.getLookAndFeel());
        setContentNonOwned(&pane, false);
        juce::Rectangle<int> room{100, 100, 900, 640};
        for (const auto& display : juce::Desktop::getInstance().getDisplays().displays)
            if (wholeOf(display) != displayOf(beside)) room = usableOf(display);
        setBounds(room);
        setResizable(true, false);
        addToDesktop();
        setVisible(true);
    }
    ~AnswerWindow() override {
        clearContentComponent();
        setLookAndFeel(nullptr);
    }
};

} // namespace

std::unique_ptr<juce::Component> makeAnswerWindow(StudyAnswerPane& pane, const juce::Component& beside) {
    return std::make_unique<AnswerWindow>(pane, beside);
}

StudyAnswerPane::StudyAnswerPane(const StudyWords& words)
    : say_{words} {
    setTitle("Answers");
    setWantsKeyboardFocus(true);
    setFocusContainerType(FocusContainerType::keyboardFocusContainer);
    confirm_.setMain(true);
    confirm_.onClick = [this] { onConfirm(); };
    addChildComponent(confirm_);
}

void StudyAnswerPane::show(std::unique_ptr<StudyAnswer> answer) {
    answer_ = std::move(answer);
    if (answer_) addAndMakeVisible(*answer_);
    prepareControls(*this);
    resized();
    repaint();
}

void StudyAnswerPane::setConfirm(bool isSeen, bool isEnabled, const juce::String& words) {
    const bool wasEnabled = confirm_.isEnabled() && confirm_.isVisible();
    confirm_.setVisible(isSeen);
    confirm_.setEnabled(isEnabled);
    confirm_.setWords(words, say_("Enter"));
    if (wasEnabled != (isSeen && isEnabled)) repaint();
}

bool StudyAnswerPane::confirm() {
    if (!confirm_.isShowing() || !confirm_.isEnabled()) return false;
    confirm_.onClick();
    return true;
}

void StudyAnswerPane::focusConfirm() {
    if (confirm_.isShowing() && confirm_.isEnabled()) confirm_.grabKeyboardFocus();
}

void StudyAnswerPane::paint(juce::Graphics& g) {
    if (standsAlone_) {
        g.fillAll(shade(*this, Shade::ground));
        ink(g, *this, Shade::text, text::large, juce::Font::bold);
        g.drawFittedText(question_, questionArea_, juce::Justification::centred, 2, 1.0f);
    }
    if (!answer_ || !answer_->isVisible()) return;
    ink(g, *this, Shade::muted, text::small);
    g.drawText(say_(answer_->keys()), keysArea_, juce::Justification::centredLeft, true);
}

void StudyAnswerPane::resized() {
    auto area = standsAlone_ ? getLocalBounds().reduced(pageInset, 16) : getLocalBounds();
    questionArea_ = standsAlone_ ? area.removeFromTop(64) : juce::Rectangle<int>{};
    auto foot = area.removeFromBottom(footHeight);
    confirm_.setBounds(foot.withSizeKeepingCentre(260, 64));
    keysArea_ = foot.removeFromBottom(36).withWidth((foot.getWidth() - 280) / 2);
    if (answer_) answer_->setBounds(area);
}

namespace {

constexpr int space = 16;

/// A column in the upper part of `area`, near the stimulus buttons.
juce::Rectangle<int> column(juce::Rectangle<int> area, int width, int height) {
    const int high = std::min(height, area.getHeight());
    return area.withTrimmedTop((area.getHeight() - high) / 4)
        .withHeight(high)
        .withSizeKeepingCentre(std::min(width, area.getWidth()), high);
}

/// One button per label.
class LabelAnswer final : public ChosenAnswer {
public:
    LabelAnswer(std::vector<std::string> labels, const StudyWords& say)
        : labels_{std::move(labels)} {
        setTitle("Stimuli");
        for (const std::string& label : labels_) {
            auto& button = buttons_.emplace_back(std::make_unique<BigButton>(say(label), utf8(label)));
            offer(*button, label);
            addAndMakeVisible(*button);
        }
    }
    std::string keys() const override { return "Arrows and Enter: answer.  Enter: confirm."; }
    bool handleKey(const juce::KeyPress& key) override { return moveFocus(*this, key); }
    void mark(const std::set<std::string>& felt) override {
        for (std::size_t i = 0; i < buttons_.size(); ++i) {
            const bool isFelt = felt.contains(labels_[i]);
            buttons_[i]->setMarked(isFelt);
            buttons_[i]->setDescription(isFelt ? "was felt" : "");
        }
    }
    void resized() override {
        const int count = static_cast<int>(buttons_.size());
        const int across = std::max(1, static_cast<int>(std::ceil(std::sqrt(0.6 * count)))),
                  down = (count + across - 1) / across;
        auto area = column(getLocalBounds(), 260 * across, 84 * down);
        for (int i = 0; i < count; ++i)
            nth(buttons_, i)
                ->setBounds(juce::Rectangle<int>{area.getX() + i % across * area.getWidth() / across,
                                                 area.getY() + i / across * area.getHeight() / down,
                                                 area.getWidth() / across, area.getHeight() / down}
                                .reduced(5));
    }

private:
    std::vector<std::unique_ptr<BigButton>> buttons_;
    const std::vector<std::string> labels_;
};

/// One button per part, by number; the names of the parts are hidden.
class ChoiceAnswer final : public ChosenAnswer {
public:
    ChoiceAnswer(const Trial& trial, const StudyWords& say)
        : parts_{trial.parts} {
        setTitle("Choice");
        for (int i = 0; i < static_cast<int>(parts_.size()); ++i) {
            auto& button = buttons_.emplace_back(
                std::make_unique<BigButton>(say.ordinal(i), "Answer: number " + juce::String{i + 1}));
            button->setWords(say.ordinal(i), say("key {n}", {{"n", juce::String{i + 1}}}));
            offer(*button, nth(parts_, i));
            addAndMakeVisible(*button);
        }
    }
    std::string keys() const override { return "1, 2: answer.  Enter: confirm."; }
    bool handleKey(const juce::KeyPress& key) override {
        const int i = static_cast<int>(key.getTextCharacter() - '1');
        if (!isEnabled() || i < 0 || i >= static_cast<int>(parts_.size())) return moveFocus(*this, key);
        choose(nth(parts_, i));
        return true;
    }
    void resized() override {
        const int count = static_cast<int>(buttons_.size());
        auto area = column(getLocalBounds(), 320 * count, 150);
        const int width = area.getWidth() / count;
        for (auto& button : buttons_) button->setBounds(area.removeFromLeft(width).reduced(space / 2));
    }

private:
    const std::vector<std::string> parts_;
    std::vector<std::unique_ptr<BigButton>> buttons_;
};

/// One slider per scale, with its definition, or per object in the order of its button. A slider that was not
/// moved has no answer. The score is hidden unless the session shows numbers, because visible numbers bias
/// ratings.
class RatingAnswer final : public StudyAnswer {
public:
    RatingAnswer(const SessionPlan& session, const Trial& trial, const StudyWords& say)
        : say_{say}
        , anchors_{session.anchors.empty()
                       ? std::vector<std::string>{usualAnchors.begin(), usualAnchors.end()}
                       : session.anchors}
        , points_{session.points}
        , showsNumbers_{session.showsNumbers} {
        setTitle("Ratings");
        const std::size_t open = session.reference.empty() ? 0 : 1;
        for (std::size_t i = 0; i < session.scores().size(); ++i) {
            auto& scale = scales_.emplace_back(std::make_unique<Scale>());
            const bool isObject = session.ratesSideBySide();
            const auto capital = [](const juce::String& words) {
                return words.substring(0, 1).toUpperCase() + words.substring(1);
            };
            places_.push_back(isObject ? static_cast<std::size_t>(
                                             std::ranges::find(session.objects, trial.parts[open + i]) -
                                             session.objects.begin())
                                       : i);
            scale->name = capital(isObject ? partLetter(i) : say(session.scales[i]));
            if (i < session.definitions.size()) scale->meaning = say(session.definitions[i]);
            auto& slider = scale->slider;
            slider.setTitle(capital(isObject ? partLetter(i) : utf8(session.scales[i])));
            slider.setDescription(scale->meaning);
            slider.setSliderStyle(juce::Slider::LinearHorizontal);
            slider.setTextBoxStyle(juce::Slider::NoTextBox, true, 0, 0);
            slider.setRange(points_ > 0 ? 1.0 : 0.0, points_ > 0 ? points_ : 100.0, 1.0);
            slider.setValue(points_ > 0 ? (1 + points_) / 2 : 50.0, juce::dontSendNotification);
            slider.setWantsKeyboardFocus(true);
            slider.getProperties().set(tintProperty, static_cast<juce::int64>(palette::muted.getARGB()));
            slider.onValueChange = slider.onDragEnd = [this, s = scale.get()] { touched(*s); };
            addAndMakeVisible(slider);
        }
    }
    Answer answer() const override {
        Answer answer;
        answer.scores.resize(scales_.size());
        for (std::size_t i = 0; i < scales_.size(); ++i)
            answer.scores[places_[i]] = scales_[i]->slider.getValue();
        return answer;
    }
    bool isComplete() const override {
        return std::ranges::all_of(scales_, [](const auto& scale) { return scale->isMoved; });
    }
    std::string keys() const override { return "Tab: next scale.  Arrows: move.  Enter: next."; }
    void paint(juce::Graphics& g) override {
        for (const auto& scale : scales_) {
            auto row = scale->area;
            ink(g, *this, isEnabled() ? Shade::text : Shade::muted, text::large);
            auto words = row.removeFromTop(28);
            g.drawText(scale->name, words.removeFromLeft(150), juce::Justification::centredLeft, true);
            ink(g, *this, Shade::muted, text::medium);
            g.drawText(scale->meaning, words, juce::Justification::centredLeft, true);
            for (int point = 1; point <= points_; ++point)
                g.fillEllipse(juce::Rectangle<float>{8.0f, 8.0f}.withCentre(
                    {static_cast<float>(scale->slider.getX()) + scale->slider.getPositionOfValue(point),
                     static_cast<float>(scale->slider.getBounds().getCentreY())}));
            const auto ends = row.withTrimmedTop(30).removeFromTop(22);
            g.drawText(say_(anchors_[0]), ends, juce::Justification::centredLeft, true);
            g.drawText(say_(anchors_[1]), ends, juce::Justification::centredRight, true);
            const auto valueText = !scale->isMoved ? say_("not set")
                                   : showsNumbers_ ? juce::String{juce::roundToInt(scale->slider.getValue())}
                                                   : juce::String{};
            g.drawText(valueText, ends, juce::Justification::centred, true);
        }
    }
    void resized() override {
        const int count = static_cast<int>(scales_.size()), each = std::min(118, getHeight() / count);
        auto area = column(getLocalBounds(), 860, each * count);
        for (auto& scale : scales_) {
            scale->area = area.removeFromTop(each);
            scale->slider.setBounds(scale->area.withTrimmedTop(28).withHeight(30));
        }
    }
    void enablementChanged() override { repaint(); }

private:
    struct Scale {
        juce::String name, meaning;
        juce::Slider slider;
        juce::Rectangle<int> area;
        bool isMoved = false;
    };
    void touched(Scale& scale) {
        scale.isMoved = true;
        scale.slider.getProperties().remove(tintProperty);
        repaint();
        onChange();
    }
    const StudyWords& say_;
    const std::vector<std::string> anchors_;
    const int points_; // 0: from 0 to 100
    const bool showsNumbers_;
    std::vector<std::size_t> places_; // of each slider, among the session's scores
    std::vector<std::unique_ptr<Scale>> scales_;
};

/// Method of adjustment: softer or stronger by one step. The level is hidden.
class AdjustAnswer final : public StudyAnswer {
public:
    AdjustAnswer(const Adjustment& adjustment, double startDb, const StudyWords& say)
        : adjustment_{adjustment}
        , db_{startDb} {
        setTitle("Level");
        for (auto* button : {&softer_, &stronger_}) addAndMakeVisible(*button);
        softer_.setWords(say("Softer"), say("arrow down"));
        stronger_.setWords(say("Stronger"), say("arrow up"));
        softer_.onClick = [this] { step(-1.0); };
        stronger_.onClick = [this] { step(1.0); };
    }
    Answer answer() const override { return {.response = {}, .place = {}, .scores = {}, .value = db_}; }
    bool isComplete() const override { return true; }
    bool isOpen() const override { return true; }
    std::string keys() const override { return "Up, down: level.  Enter: they are equal."; }
    bool handleKey(const juce::KeyPress& key) override {
        if (!isEnabled()) return false;
        if (key.isKeyCode(juce::KeyPress::upKey)) return step(1.0), true;
        if (key.isKeyCode(juce::KeyPress::downKey)) return step(-1.0), true;
        return false;
    }
    void beginAnew() override {}
    void paint(juce::Graphics& g) override {
        fillRound(g, *this, Shade::well, bar_, 8.0f);
        const double share = (db_ - adjustment_.leastDb) / (adjustment_.mostDb - adjustment_.leastDb);
        g.setColour(shade(*this, Shade::accent).withMultipliedAlpha(isEnabled() ? 1.0f : 0.4f));
        g.fillRoundedRectangle(bar_.withWidth(std::max(16.0f, bar_.getWidth() * static_cast<float>(share))),
                               8.0f);
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
        onChange();
    }
    const Adjustment adjustment_;
    double db_;
    BigButton softer_{"Softer", "Softer"}, stronger_{"Stronger", "Stronger"};
    juce::Rectangle<float> bar_;
};

/// What is typed into one field.
class TypedAnswer : public StudyAnswer {
public:
    // for keys typed while the focus was elsewhere
    bool handleKey(const juce::KeyPress& key) override { return isEnabled() && typed_.keyPressed(key); }
    void beginAnew() override { typed_.grabKeyboardFocus(); }
    void resized() override { typed_.setBounds(column(getLocalBounds(), width_, height_)); }
    void enablementChanged() override {
        typed_.setVisible(isEnabled()); // hidden until it may be answered
        if (isEnabled()) typed_.applyColourToAllText(shade(*this, Shade::text));
    }

protected:
    TypedAnswer(const juce::String& title, int width, int height, bool isSpaceTyped)
        : width_{width}
        , height_{height} {
        setTitle(title);
        typed_.isSpaceTyped = isSpaceTyped;
        typed_.setTitle(title);
        typed_.setFont(text::font(text::large));
        typed_.onTextChange = [this] { onChange(); };
        typed_.setEscapeAndReturnKeysConsumed(false); // so that Esc silences and Enter confirms
        addAndMakeVisible(typed_);
    }
    juce::TextEditor& typed() { return typed_; }
    juce::String written() const { return typed_.getText(); }

private:
    struct Editor final : juce::TextEditor {
        bool isSpaceTyped = false; // else it plays again
        bool keyPressed(const juce::KeyPress& key) override {
            return (isSpaceTyped || !key.isKeyCode(juce::KeyPress::spaceKey)) &&
                   juce::TextEditor::keyPressed(key);
        }
    } typed_;
    const int width_, height_;
};

/// Magnitude estimation.
class NumberAnswer final : public TypedAnswer {
public:
    NumberAnswer()
        : TypedAnswer{"Number", 260, 64, false} {
        typed().setInputRestrictions(9, "0123456789.,");
        typed().setJustification(juce::Justification::centred);
    }
    Answer answer() const override {
        Answer answer;
        answer.value = parseNumber<double>(written().replaceCharacter(',', '.').toStdString()).value_or(0.0);
        return answer;
    }
    bool isComplete() const override { return answer().value > 0.0; }
    std::string keys() const override { return "Type a number, then Enter."; }
};

/// One paragraph in the participant's own words.
class WordsAnswer final : public TypedAnswer {
public:
    explicit WordsAnswer(bool mayBeEmpty)
        : TypedAnswer{"Words", 760, 200, true}
        , mayBeEmpty_{mayBeEmpty} {
        typed().setMultiLine(true);
        typed().setInputRestrictions(mostAnswerBytes / 4); // characters of UTF-8
    }
    Answer answer() const override {
        Answer answer;
        answer.response = written().replaceCharacters("\r\n\t", "   ").trim().toStdString();
        return answer;
    }
    bool isComplete() const override { return mayBeEmpty_ || !answer().response.empty(); }
    std::string keys() const override { return "Write, then Enter."; }

private:
    const bool mayBeEmpty_;
};

std::unique_ptr<StudyAnswer> labelled(const ConditionPlan& condition, const LayoutDescription& layout,
                                      const StudyWords& words) {
    if (std::holds_alternative<PatternSet>(condition.stimuli))
        return makePatternAnswer(condition, layout, words);
    if (const auto* grid = std::get_if<GridSet>(&condition.stimuli)) return makeCellAnswer(*grid, layout);
    std::vector<std::string> labels;
    for (StimulusItem& item : stimuliOf(condition)) labels.push_back(std::move(item.label));
    return std::make_unique<LabelAnswer>(std::move(labels), words);
}

} // namespace

std::unique_ptr<StudyAnswer> makeStudyAnswer(const Experiment& experiment, const LayoutDescription& layout,
                                             const StudyWords& words) {
    const SessionPlan& session = experiment.session();
    switch (session.answer()) {
    case AnswerKind::wish:
        return session.fewestTouches > 0 ? makePlaceAnswer(layout)
                                         : labelled(experiment.condition(), layout, words);
    case AnswerKind::label: return labelled(experiment.condition(), layout, words);
    case AnswerKind::place: return makePlaceAnswer(layout);
    case AnswerKind::choice:
        if (!session.answers.empty()) return std::make_unique<LabelAnswer>(session.answers, words);
        return std::make_unique<ChoiceAnswer>(experiment.trial(), words);
    case AnswerKind::scores: return std::make_unique<RatingAnswer>(session, experiment.trial(), words);
    case AnswerKind::level:
        return std::make_unique<AdjustAnswer>(*session.adjustment, experiment.trial().levelDb, words);
    case AnswerKind::number: return std::make_unique<NumberAnswer>();
    case AnswerKind::words: return std::make_unique<WordsAnswer>(session.mayBeEmpty);
    }
    return nullptr;
}

} // namespace physvib
