// SPDX-License-Identifier: GPL-3.0-or-later
// The answer pane and its window, and answers by label, choice, rating, level, number and words.
#include "Host/Views/WorldView.h"
#include "Io/Text/NumberText.h"
#include "Mixer/Studies/StudyParts.h"

namespace physvib {
namespace {

constexpr int answerFooterHeight = 84;

class AnswerWindow final : public juce::DocumentWindow {
public:
    AnswerWindow(StudyAnswerPane& pane, const juce::Component& studyScreen)
        : juce::DocumentWindow{"PhysVib: answers", palette::ground, 0, false} {
        setUsingNativeTitleBar(true);
        setLookAndFeel(&studyScreen.getLookAndFeel());
        setContentNonOwned(&pane, false);
        juce::Rectangle<int> area{100, 100, 900, 640};
        for (const auto& display : juce::Desktop::getInstance().getDisplays().displays)
            if (totalAreaOf(display) != displayOf(studyScreen)) area = userAreaOf(display);
        setBounds(area);
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

std::unique_ptr<juce::Component> makeAnswerWindow(StudyAnswerPane& pane, const juce::Component& studyScreen) {
    return std::make_unique<AnswerWindow>(pane, studyScreen);
}

StudyAnswerPane::StudyAnswerPane(const StudyTexts& texts)
    : translate_{texts} {
    setTitle("Answers");
    setWantsKeyboardFocus(true);
    setFocusContainerType(FocusContainerType::keyboardFocusContainer);
    confirm_.setPrimary(true);
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

void StudyAnswerPane::setConfirm(bool isShown, bool isEnabled, const juce::String& label) {
    const bool wasEnabled = confirm_.isEnabled() && confirm_.isVisible();
    confirm_.setVisible(isShown);
    confirm_.setEnabled(isEnabled);
    confirm_.setText(label, translate_("Enter"));
    if (wasEnabled != (isShown && isEnabled)) repaint();
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
    if (isSeparateWindow_) {
        g.fillAll(shade(*this, Shade::background));
        setInk(g, *this, Shade::text, text::large, juce::Font::bold);
        g.drawFittedText(question_, questionArea_, juce::Justification::centred, 2, 1.0f);
    }
    if (!answer_ || !answer_->isVisible()) return;
    setInk(g, *this, Shade::muted, text::small);
    g.drawText(translate_(answer_->keyHelp()), keyHelpArea_, juce::Justification::centredLeft, true);
}

void StudyAnswerPane::resized() {
    auto area = isSeparateWindow_ ? getLocalBounds().reduced(pageInset, 16) : getLocalBounds();
    questionArea_ = isSeparateWindow_ ? area.removeFromTop(64) : juce::Rectangle<int>{};
    auto footer = area.removeFromBottom(answerFooterHeight);
    confirm_.setBounds(footer.withSizeKeepingCentre(260, 64));
    keyHelpArea_ = footer.removeFromBottom(36).withWidth((footer.getWidth() - 280) / 2);
    if (answer_) answer_->setBounds(area);
}

namespace {

constexpr int answerSpacing = 16;

/// A centred column in the upper part of `area`, of at most `width` x `height` pixels.
juce::Rectangle<int> topColumn(juce::Rectangle<int> area, int width, int height) {
    const int columnHeight = std::min(height, area.getHeight());
    return area.withTrimmedTop((area.getHeight() - columnHeight) / 4)
        .withHeight(columnHeight)
        .withSizeKeepingCentre(std::min(width, area.getWidth()), columnHeight);
}

/// Identification: one button per label.
class LabelAnswer final : public ButtonAnswer {
public:
    LabelAnswer(std::vector<std::string> labels, const StudyTexts& translate)
        : labels_{std::move(labels)} {
        setTitle("Stimuli");
        for (const std::string& label : labels_) {
            auto& button = buttons_.emplace_back(std::make_unique<BigButton>(translate(label), utf8(label)));
            addChoice(*button, label);
            addAndMakeVisible(*button);
        }
    }
    std::string keyHelp() const override { return "Arrows and Enter: answer.  Enter: confirm."; }
    bool handleKey(const juce::KeyPress& key) override { return moveFocus(*this, key); }
    void markPlayed(const std::set<std::string>& played) override {
        for (std::size_t i = 0; i < buttons_.size(); ++i) {
            const bool wasPlayed = played.contains(labels_[i]);
            buttons_[i]->setMarked(wasPlayed);
            buttons_[i]->setDescription(wasPlayed ? "was felt" : "");
        }
    }
    void resized() override {
        const int count = static_cast<int>(buttons_.size());
        const int columns = std::max(1, static_cast<int>(std::ceil(std::sqrt(0.6 * count)))),
                  rows = (count + columns - 1) / columns;
        auto area = topColumn(getLocalBounds(), 260 * columns, 84 * rows);
        for (int i = 0; i < count; ++i)
            nth(buttons_, i)
                ->setBounds(juce::Rectangle<int>{area.getX() + i % columns * area.getWidth() / columns,
                                                 area.getY() + i / columns * area.getHeight() / rows,
                                                 area.getWidth() / columns, area.getHeight() / rows}
                                .reduced(5));
    }

private:
    std::vector<std::unique_ptr<BigButton>> buttons_;
    const std::vector<std::string> labels_;
};

/// Choice between the parts of a trial: one numbered button per part; the names of the parts are hidden.
class ChoiceAnswer final : public ButtonAnswer {
public:
    ChoiceAnswer(const Trial& trial, const StudyTexts& translate)
        : parts_{trial.parts} {
        setTitle("Choice");
        for (int i = 0; i < static_cast<int>(parts_.size()); ++i) {
            auto& button = buttons_.emplace_back(
                std::make_unique<BigButton>(translate.ordinal(i), "Answer: number " + juce::String{i + 1}));
            button->setText(translate.ordinal(i), translate("key {n}", {{"n", juce::String{i + 1}}}));
            addChoice(*button, nth(parts_, i));
            addAndMakeVisible(*button);
        }
    }
    std::string keyHelp() const override { return "1, 2: answer.  Enter: confirm."; }
    bool handleKey(const juce::KeyPress& key) override {
        const int i = static_cast<int>(key.getTextCharacter() - '1');
        if (!isEnabled() || i < 0 || i >= static_cast<int>(parts_.size())) return moveFocus(*this, key);
        choose(nth(parts_, i));
        return true;
    }
    void resized() override {
        const int count = static_cast<int>(buttons_.size());
        auto area = topColumn(getLocalBounds(), 320 * count, 150);
        const int width = area.getWidth() / count;
        for (auto& button : buttons_)
            button->setBounds(area.removeFromLeft(width).reduced(answerSpacing / 2));
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
    RatingAnswer(const SessionPlan& session, const Trial& trial, const StudyTexts& translate)
        : translate_{translate}
        , anchors_{session.anchors.empty()
                       ? std::vector<std::string>{defaultAnchors.begin(), defaultAnchors.end()}
                       : session.anchors}
        , pointCount_{session.points}
        , showsNumbers_{session.showsNumbers} {
        setTitle("Ratings");
        const std::size_t referenceCount = session.reference.empty() ? 0 : 1;
        for (std::size_t i = 0; i < session.scores().size(); ++i) {
            auto& scale = scales_.emplace_back(std::make_unique<Scale>());
            const bool isObject = session.ratesSideBySide();
            const auto capitalised = [](const juce::String& text) {
                return text.substring(0, 1).toUpperCase() + text.substring(1);
            };
            scoreIndices_.push_back(
                isObject ? static_cast<std::size_t>(
                               std::ranges::find(session.objects, trial.parts[referenceCount + i]) -
                               session.objects.begin())
                         : i);
            scale->name = capitalised(isObject ? partLetter(i) : translate(session.scales[i]));
            if (i < session.definitions.size()) scale->definition = translate(session.definitions[i]);
            auto& slider = scale->slider;
            slider.setTitle(capitalised(isObject ? partLetter(i) : utf8(session.scales[i])));
            slider.setDescription(scale->definition);
            slider.setSliderStyle(juce::Slider::LinearHorizontal);
            slider.setTextBoxStyle(juce::Slider::NoTextBox, true, 0, 0);
            slider.setRange(pointCount_ > 0 ? 1.0 : 0.0, pointCount_ > 0 ? pointCount_ : 100.0, 1.0);
            slider.setValue(pointCount_ > 0 ? (1 + pointCount_) / 2 : 50.0, juce::dontSendNotification);
            slider.setWantsKeyboardFocus(true);
            slider.getProperties().set(tintProperty, static_cast<juce::int64>(palette::muted.getARGB()));
            slider.onValueChange = slider.onDragEnd = [this, s = scale.get()] { setMoved(*s); };
            addAndMakeVisible(slider);
        }
    }
    Answer answer() const override {
        Answer answer;
        answer.scores.resize(scales_.size());
        for (std::size_t i = 0; i < scales_.size(); ++i)
            answer.scores[scoreIndices_[i]] = scales_[i]->slider.getValue();
        return answer;
    }
    bool isComplete() const override {
        return std::ranges::all_of(scales_, [](const auto& scale) { return scale->isMoved; });
    }
    std::string keyHelp() const override { return "Tab: next scale.  Arrows: move.  Enter: next."; }
    void paint(juce::Graphics& g) override {
        for (const auto& scale : scales_) {
            auto row = scale->area;
            setInk(g, *this, isEnabled() ? Shade::text : Shade::muted, text::large);
            auto heading = row.removeFromTop(28);
            g.drawText(scale->name, heading.removeFromLeft(150), juce::Justification::centredLeft, true);
            setInk(g, *this, Shade::muted, text::medium);
            g.drawText(scale->definition, heading, juce::Justification::centredLeft, true);
            for (int point = 1; point <= pointCount_; ++point)
                g.fillEllipse(juce::Rectangle<float>{8.0f, 8.0f}.withCentre(
                    {static_cast<float>(scale->slider.getX()) + scale->slider.getPositionOfValue(point),
                     static_cast<float>(scale->slider.getBounds().getCentreY())}));
            const auto anchorArea = row.withTrimmedTop(30).removeFromTop(22);
            g.drawText(translate_(anchors_[0]), anchorArea, juce::Justification::centredLeft, true);
            g.drawText(translate_(anchors_[1]), anchorArea, juce::Justification::centredRight, true);
            const auto valueText = !scale->isMoved ? translate_("not set")
                                   : showsNumbers_ ? juce::String{juce::roundToInt(scale->slider.getValue())}
                                                   : juce::String{};
            g.drawText(valueText, anchorArea, juce::Justification::centred, true);
        }
    }
    void resized() override {
        const int count = static_cast<int>(scales_.size()), scaleHeight = std::min(118, getHeight() / count);
        auto area = topColumn(getLocalBounds(), 860, scaleHeight * count);
        for (auto& scale : scales_) {
            scale->area = area.removeFromTop(scaleHeight);
            scale->slider.setBounds(scale->area.withTrimmedTop(28).withHeight(30));
        }
    }
    void enablementChanged() override { repaint(); }

private:
    struct Scale {
        juce::String name, definition;
        juce::Slider slider;
        juce::Rectangle<int> area;
        bool isMoved = false;
    };
    void setMoved(Scale& scale) {
        scale.isMoved = true;
        scale.slider.getProperties().remove(tintProperty);
        repaint();
        onChange();
    }
    const StudyTexts& translate_;
    const std::vector<std::string> anchors_;
    const int pointCount_; // points of the scale, from 1; 0: a scale from 0 to 100
    const bool showsNumbers_;
    std::vector<std::size_t> scoreIndices_; // place of each slider's score among the session's scores
    std::vector<std::unique_ptr<Scale>> scales_;
};

/// Method of adjustment: softer or stronger by one step. A bar shows the level, no number does.
class AdjustAnswer final : public StudyAnswer {
public:
    AdjustAnswer(const Adjustment& adjustment, double startDb, const StudyTexts& translate)
        : adjustment_{adjustment}
        , db_{startDb} {
        setTitle("Level");
        for (auto* button : {&softer_, &stronger_}) addAndMakeVisible(*button);
        softer_.setText(translate("Softer"), translate("arrow down"));
        stronger_.setText(translate("Stronger"), translate("arrow up"));
        softer_.onClick = [this] { changeLevel(-1.0); };
        stronger_.onClick = [this] { changeLevel(1.0); };
    }
    Answer answer() const override { return {.response = {}, .place = {}, .scores = {}, .value = db_}; }
    bool isComplete() const override { return true; }
    bool canAnswerEarly() const override { return true; }
    std::string keyHelp() const override { return "Up, down: level.  Enter: they are equal."; }
    bool handleKey(const juce::KeyPress& key) override {
        if (!isEnabled()) return false;
        if (key.isKeyCode(juce::KeyPress::upKey)) return changeLevel(1.0), true;
        if (key.isKeyCode(juce::KeyPress::downKey)) return changeLevel(-1.0), true;
        return false;
    }
    void focusFirst() override {}
    void paint(juce::Graphics& g) override {
        fillRound(g, *this, Shade::well, bar_, 8.0f);
        const double share = (db_ - adjustment_.minDb) / (adjustment_.maxDb - adjustment_.minDb);
        g.setColour(shade(*this, Shade::accent).withMultipliedAlpha(isEnabled() ? 1.0f : 0.4f));
        g.fillRoundedRectangle(bar_.withWidth(std::max(16.0f, bar_.getWidth() * static_cast<float>(share))),
                               8.0f);
    }
    void resized() override {
        auto area = topColumn(getLocalBounds(), 760, 170);
        bar_ = area.removeFromTop(16).toFloat();
        area.removeFromTop(answerSpacing * 2);
        softer_.setBounds(area.removeFromLeft(area.getWidth() / 2 - answerSpacing / 2));
        stronger_.setBounds(area.withTrimmedLeft(answerSpacing));
    }
    void enablementChanged() override { repaint(); }

private:
    void changeLevel(double steps) {
        db_ = std::clamp(db_ + steps * adjustment_.stepDb, adjustment_.minDb, adjustment_.maxDb);
        repaint();
        onChange();
    }
    const Adjustment adjustment_;
    double db_;
    BigButton softer_{"Softer", "Softer"}, stronger_{"Stronger", "Stronger"};
    juce::Rectangle<float> bar_;
};

/// An answer typed into one text field.
class TypedAnswer : public StudyAnswer {
public:
    // the editor also gets keys that were typed while the focus was elsewhere
    bool handleKey(const juce::KeyPress& key) override { return isEnabled() && editor_.keyPressed(key); }
    void focusFirst() override { editor_.grabKeyboardFocus(); }
    void resized() override { editor_.setBounds(topColumn(getLocalBounds(), width_, height_)); }
    void enablementChanged() override {
        editor_.setVisible(isEnabled()); // hidden until an answer is accepted
        if (isEnabled()) editor_.applyColourToAllText(shade(*this, Shade::text));
    }

protected:
    TypedAnswer(const juce::String& title, int width, int height, bool isSpaceTyped)
        : width_{width}
        , height_{height} {
        setTitle(title);
        editor_.isSpaceTyped = isSpaceTyped;
        editor_.setTitle(title);
        editor_.setFont(text::font(text::large));
        editor_.onTextChange = [this] { onChange(); };
        editor_.setEscapeAndReturnKeysConsumed(false); // so that Esc silences and Enter confirms
        addAndMakeVisible(editor_);
    }
    juce::TextEditor& editor() { return editor_; }
    juce::String typedText() const { return editor_.getText(); }

private:
    struct Editor final : juce::TextEditor {
        bool isSpaceTyped = false; // false: the space bar plays the stimulus again
        bool keyPressed(const juce::KeyPress& key) override {
            return (isSpaceTyped || !key.isKeyCode(juce::KeyPress::spaceKey)) &&
                   juce::TextEditor::keyPressed(key);
        }
    } editor_;
    const int width_, height_;
};

/// Magnitude estimation: a typed number above 0.
class NumberAnswer final : public TypedAnswer {
public:
    NumberAnswer()
        : TypedAnswer{"Number", 260, 64, false} {
        editor().setInputRestrictions(9, "0123456789.,");
        editor().setJustification(juce::Justification::centred);
    }
    Answer answer() const override {
        Answer answer;
        answer.value =
            parseNumber<double>(typedText().replaceCharacter(',', '.').toStdString()).value_or(0.0);
        return answer;
    }
    bool isComplete() const override { return answer().value > 0.0; }
    std::string keyHelp() const override { return "Type a number, then Enter."; }
};

/// One paragraph in the participant's own words.
class TextAnswer final : public TypedAnswer {
public:
    explicit TextAnswer(bool mayBeEmpty)
        : TypedAnswer{"Words", 760, 200, true}
        , mayBeEmpty_{mayBeEmpty} {
        editor().setMultiLine(true);
        editor().setInputRestrictions(maxAnswerBytes / 4); // a character of UTF-8 has up to four bytes
    }
    Answer answer() const override {
        Answer answer;
        answer.response = typedText().replaceCharacters("\r\n\t", "   ").trim().toStdString();
        return answer;
    }
    bool isComplete() const override { return mayBeEmpty_ || !answer().response.empty(); }
    std::string keyHelp() const override { return "Write, then Enter."; }

private:
    const bool mayBeEmpty_;
};

std::unique_ptr<StudyAnswer> makeLabelAnswer(const ConditionPlan& condition, const LayoutDescription& layout,
                                             const StudyTexts& texts) {
    if (std::holds_alternative<PatternSet>(condition.stimuli))
        return makePatternAnswer(condition, layout, texts);
    if (const auto* grid = std::get_if<GridSet>(&condition.stimuli)) return makeCellAnswer(*grid, layout);
    std::vector<std::string> labels;
    for (StimulusItem& item : conditionStimuli(condition)) labels.push_back(std::move(item.label));
    return std::make_unique<LabelAnswer>(std::move(labels), texts);
}

} // namespace

std::unique_ptr<StudyAnswer> makeStudyAnswer(const Experiment& experiment, const LayoutDescription& layout,
                                             const StudyTexts& texts) {
    const SessionPlan& session = experiment.session();
    switch (session.answerKind()) {
    case AnswerKind::request:
        return session.minTouches > 0 ? makePlaceAnswer(layout)
                                      : makeLabelAnswer(experiment.condition(), layout, texts);
    case AnswerKind::label: return makeLabelAnswer(experiment.condition(), layout, texts);
    case AnswerKind::place: return makePlaceAnswer(layout);
    case AnswerKind::choice:
        if (!session.answers.empty()) return std::make_unique<LabelAnswer>(session.answers, texts);
        return std::make_unique<ChoiceAnswer>(experiment.trial(), texts);
    case AnswerKind::scores: return std::make_unique<RatingAnswer>(session, experiment.trial(), texts);
    case AnswerKind::level:
        return std::make_unique<AdjustAnswer>(*session.adjustment, experiment.trial().levelDb, texts);
    case AnswerKind::number: return std::make_unique<NumberAnswer>();
    case AnswerKind::words: return std::make_unique<TextAnswer>(session.mayBeEmpty);
    }
    return nullptr;
}

} // namespace physvib
