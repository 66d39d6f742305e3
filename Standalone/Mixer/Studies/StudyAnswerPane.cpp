// SPDX-License-Identifier: GPL-3.0-or-later
// Layout of the answer component and its confirm button.
#include "Mixer/Studies/StudyAnswerPane.h"
#include "Mixer/Window/Parts.h"

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
        const auto& displays = juce::Desktop::getInstance().getDisplays();
        const auto* here = displays.getDisplayForRect(beside.getScreenBounds());
        juce::Rectangle<int> room{100, 100, 900, 640};
        for (const auto& display : displays.displays)
            if (here != nullptr && display.totalArea != here->totalArea) room = display.userArea;
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
    confirm_.onClick = [this] {
        if (onConfirm) onConfirm();
    };
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

void StudyAnswerPane::setQuestion(const juce::String& question) {
    if (question == question_) return;
    question_ = question;
    repaint();
}

void StudyAnswerPane::paint(juce::Graphics& g) {
    if (standsAlone_) {
        g.fillAll(shade(*this, Shade::ground));
        g.setColour(shade(*this, Shade::text));
        g.setFont(juce::Font{text::large, juce::Font::bold});
        g.drawFittedText(question_, questionArea_, juce::Justification::centred, 2, 1.0f);
    }
    if (!answer_ || !answer_->isVisible()) return;
    g.setColour(shade(*this, Shade::muted));
    g.setFont(juce::Font{text::small});
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

} // namespace physvib
