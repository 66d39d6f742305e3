// SPDX-License-Identifier: GPL-3.0-or-later
// Texts and layout of the study screen.
#include "Io/Text/NumberText.h"
#include "Mixer/Studies/StudyScreen.h"
#include "Mixer/Window/Parts.h"

namespace physvib {
namespace {

constexpr int studyBarHeight = 56, partWidth = 300, partHeight = 84, choiceHeight = 216;

} // namespace

void StudyScreen::refresh() {
    const bool hasFocus = hasKeyboardFocus(true) || (elsewhere_ && elsewhere_->hasKeyboardFocus(true));
    if (isShowing() && !hasFocus) grabKeyboardFocus(); // an answer may then take it
    const bool isSilent = desk_.isSilent();
    silence_.setButtonText(isSilent ? say_("SILENT: press to feel") : say_("SILENCE  Esc"));
    silence_.setToggleState(isSilent, juce::dontSendNotification);
    leave_->setEnabled(!isFeeling() || hasHands());
    if (page_ == Page::trial) updateTrial();
    if (page_ == Page::pause) {
        next_.setEnabled(restLeft() <= 0.0);
        next_.setWords(say_(experiment().trial().number == 1 ? "Begin" : "Go on"), say_("Enter"));
    }
    if (page_ == Page::paused) next_.setEnabled(true), next_.setWords(say_("Go on"), say_("Enter"));
    if (page_ == Page::comment) next_.setEnabled(true), next_.setWords(say_("Next"));
    if (page_ == Page::done || page_ == Page::exposed || page_ == Page::fault)
        next_.setEnabled(true), next_.setWords(say_("Close"), say_("Enter"));
    if (page_ != Page::trial)
        answers_.setConfirm(false, false, {}), answers_.setQuestion(say_("Look at the other screen."));
    if (auto words = headline() + "\n" + body() + "\n" + progressWords(); words != shown_) {
        shown_ = words;
        setDescription(words);
        repaint();
    }
}

void StudyScreen::updateParts() {
    const SessionPlan& session = experiment().session();
    const Trial& trial = experiment().trial();
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        auto& button = *parts_[i];
        const bool isPlaying = isFeeling() && part_ == i, wasFelt = progress_->plays(i) > 0;
        juce::String words = parts_.size() == 1 ? say_(wasFelt ? "Feel it again" : "Feel it")
                                                : juce::String{static_cast<int>(i) + 1};
        if (!session.objects.empty() && worldSet() == nullptr) words += "   " + say_(trial.parts[i]);
        if (session.adjustment && session.adjustment->alternative == trial.parts[i])
            words += "   " + say_("to be matched");
        if (i == 0 && !session.modulus.empty()) words += "   = " + utf8(numberText(session.modulusNumber));
        juce::StringArray remarks;
        if (isPlaying)
            remarks.add(say_("feel it now"));
        else if (hasHands())
            remarks.add(say_("key {n}", {{"n", juce::String{static_cast<int>(i) + 1}}}));
        else if (i == nextPart())
            remarks.add(say_("space bar"));
        if (session.mostPlays > 0)
            remarks.add(
                say_("{n} of {most} left", {{"n", juce::String{session.mostPlays - progress_->plays(i)}},
                                            {"most", juce::String{session.mostPlays}}}));
        else if (wasFelt && !isPlaying)
            remarks.add(progress_->plays(i) == 1
                            ? say_("felt once")
                            : say_("felt {n} times", {{"n", juce::String{progress_->plays(i)}}}));
        button.setWords(words, remarks.joinIntoString(",  "));
        button.setToggleState(isPlaying, juce::dontSendNotification);
        const bool isInSequence = session.intervalSeconds > 0.0 && !hasHands() &&
                                  (i > 0 || progress_->plays(0) > progress_->plays(parts_.size() - 1));
        button.setEnabled((!isFeeling() || hasHands()) && !desk_.isSilent() && !isWaiting() &&
                          progress_->canPlay(i) && !isInSequence);
        if (session.leastSeconds > 0.0) button.setShare(progress_->seconds(i) / session.leastSeconds);
    }
}

// ---- words

juce::String StudyScreen::headline() const {
    switch (page_) {
    case Page::trial: return say_.question(experiment().session(), experiment().condition());
    case Page::comment: return say_(study_->protocol().closingQuestion);
    case Page::done: return feedback() + say_("Thank you. That was everything.");
    case Page::exposed: return say_("That is enough vibration for today: the study pauses.");
    case Page::fault: return say_("The study cannot go on.");
    case Page::paused: return say_("The study is paused.");
    case Page::pause: break;
    }
    const Trial& trial = experiment().trial();
    if (restLeft() > 0.0)
        return feedback() + say_("A break: rest your hands.") + "  " + minutesText(restLeft());
    if (trial.number > 1) return feedback() + say_("Ready to go on?");
    return feedback() + say_(experiment().session().isTraining ? "Training" : "The study");
}

/// On the answer before, for the page that follows it.
juce::String StudyScreen::feedback() const {
    return wasRight_ ? say_(*wasRight_ ? "That was right." : "That was wrong.") + "  " : juce::String{};
}

// News is no reason why a participant feels nothing.
juce::String StudyScreen::wrong() const {
    return desk_.isNews() ? desk_.device().trouble() : desk_.trouble();
}

juce::String StudyScreen::body() const {
    switch (page_) {
    case Page::trial:
        if (desk_.isSilent()) return say_("Everything is silent. Press the button to feel again.");
        if (isWaiting()) return say_("Nothing can be felt now: the study waits for the device.");
        if (isLost_) return say_("That did not come through whole. Please feel it again.");
        if (wasRight_ && plays() == 0 && wrong().isEmpty()) return feedback().trimEnd();
        return wrong().isNotEmpty()
                   ? wrong()
                   : say_.instruction(experiment().session(), experiment().condition()).replace("\n", " ");
    case Page::comment: return say_("In your own words, if you like.");
    case Page::done: return say_("Your answers are in") + "\n" + utf8(study_->path().string());
    case Page::exposed:
        return say_(
                   "Your hands have taken A(8) = {n} m/s^2 (ISO 5349-1); this study's limit is {most} m/s^2.",
                   {{"n", number(exposure(), 2)}, {"most", number(study_->protocol().exposureLimit, 2)}}) +
               "\n" + say_("What you answered is kept, and the study goes on there another day.");
    case Page::fault:
        return utf8(fault_) + "\n" + say_("What was answered so far is kept, and the study goes on there.");
    case Page::paused:
        return say_("What you answered is kept. Close the window again to leave; the study goes on here.");
    case Page::pause: return say_.instruction(experiment().session(), experiment().condition());
    }
    return {};
}

juce::String StudyScreen::progressWords() const {
    if (experiment().isDone()) return say_("{n} trials", {{"n", juce::String{experiment().trialsTaken()}}});
    const auto& session = experiment().session();
    const int sessions =
        static_cast<int>(study_->protocol().conditions.size() * study_->protocol().sessions.size());
    juce::StringArray words{say_(session.isTraining ? "Training" : "The study")};
    if (sessions > 1)
        words.add(say_("part {n} of {most}", {{"n", juce::String{experiment().sessionNumber()}},
                                              {"most", juce::String{sessions}}}));
    const juce::String trial{experiment().trial().number};
    if (experiment().sessionTrials() > 0)
        words.add(say_("trial {n} of {most}",
                       {{"n", trial}, {"most", juce::String{experiment().sessionTrials()}}}));
    else if (!isExploring())
        words.add(say_("trial {n}", {{"n", trial}}));
    return words.joinIntoString(juce::String::fromUTF8("   \xc2\xb7   "));
}

// ---- places

void StudyScreen::paint(juce::Graphics& g) {
    g.fillAll(shade(*this, Shade::ground));
    g.setColour(shade(*this, Shade::muted));
    g.setFont(juce::Font{text::medium});
    g.drawText(progressWords(), headArea_, juce::Justification::centredLeft, true);
    if (!experiment().isDone() && experiment().sessionTrials() > 0) {
        const auto bar =
            juce::Rectangle<int>{pageInset, studyBarHeight - 2, getWidth() - 2 * pageInset, 4}.toFloat();
        g.setColour(shade(*this, Shade::line));
        g.fillRoundedRectangle(bar, 2.0f);
        g.setColour(shade(*this, Shade::accent));
        g.fillRoundedRectangle(
            bar.withWidth(bar.getWidth() * static_cast<float>(experiment().trial().number - 1) /
                          static_cast<float>(experiment().sessionTrials())),
            2.0f);
    }
    g.setColour(shade(*this, Shade::text));
    g.setFont(juce::Font{page_ == Page::trial ? text::large : 30.0f, juce::Font::bold});
    g.drawFittedText(headline(), questionArea_, juce::Justification::centred, 2, 1.0f);
    const bool isTrouble =
        page_ == Page::trial && (desk_.isSilent() || isWaiting() || isLost_ || wrong().isNotEmpty());
    g.setColour(shade(*this, isTrouble ? Shade::limit : Shade::muted));
    g.setFont(juce::Font{page_ == Page::trial ? text::medium : text::large});
    g.drawFittedText(body(), bodyArea_, juce::Justification::centred, page_ == Page::trial ? 2 : 5, 1.0f);
    if (page_ == Page::pause) drawMaterials(g);
}

// On the page before a session: the materials that will be seen, with their names.
void StudyScreen::drawMaterials(juce::Graphics& g) const {
    const auto legends = materialsSeen();
    if (legends.empty()) return;
    constexpr int swatch = 48, height = 76;
    const int width = std::min(190, (getWidth() - 2 * pageInset) / static_cast<int>(legends.size()));
    auto row = juce::Rectangle<int>{pageInset, next_.getBottom() + 24, getWidth() - 2 * pageInset, height}
                   .withSizeKeepingCentre(width * static_cast<int>(legends.size()), height);
    if (row.getBottom() > getHeight()) return;
    g.setFont(juce::Font{text::medium});
    for (const MaterialLegend& legend : legends) {
        auto cell = row.removeFromLeft(width);
        juce::Path shape;
        shape.addRectangle(-0.5f * swatch, -0.5f * swatch, 1.0f * swatch, 1.0f * swatch);
        const auto place =
            juce::AffineTransform::translation(cell.removeFromTop(swatch).getCentre().toFloat());
        if (const MaterialPicture* const picture = pictureOf(pictures_, legend.stands))
            fillWithPicture(g, shape, place, picture->image, legend.isHollow);
        else
            fillWithMaterial(g, shape, place, legend.look, legend.isHollow);
        g.setColour(shade(*this, Shade::text));
        g.drawFittedText(say_(std::string{legend.words}), cell, juce::Justification::centred, 1, 1.0f);
    }
}

std::vector<MaterialLegend> StudyScreen::materialsSeen() const {
    if (experiment().isDone() || !std::holds_alternative<WorldSet>(experiment().condition().stimuli))
        return {};
    std::string names;
    for (const StimulusItem& item : stimuliOf(experiment().condition())) names += item.label + " ";
    for (const std::string& object : experiment().session().objects) names += object + " ";
    std::vector<MaterialLegend> seen;
    for (const MaterialLegend& legend : materialLegends)
        if (names.find(legend.stands) != std::string::npos) seen.push_back(legend);
    return seen;
}

void StudyScreen::resized() {
    auto area = getLocalBounds().reduced(pageInset, 0);
    auto head = area.removeFromTop(studyBarHeight - 8);
    silence_.setBounds(head.removeFromRight(160).withTrimmedTop(8));
    leave_->setBounds(head.removeFromRight(110).reduced(16, 10));
    headArea_ = head;
    area.removeFromTop(20);
    if (page_ == Page::trial) return placeTrial(area);
    auto middle = area.withSizeKeepingCentre(std::min(900, area.getWidth()),
                                             std::min(area.getHeight(), page_ == Page::comment ? 520 : 320));
    questionArea_ = middle.removeFromTop(60);
    bodyArea_ = middle.removeFromTop(page_ == Page::comment ? 44 : 150);
    if (page_ == Page::comment) comment_.setBounds(middle.removeFromTop(middle.getHeight() - 110));
    next_.setBounds(middle.withSizeKeepingCentre(260, 72));
}

void StudyScreen::placeTrial(juce::Rectangle<int> area) {
    questionArea_ = area.removeFromTop(40);
    bodyArea_ = area.removeFromTop(40);
    if (!parts_.empty()) {
        auto row = area.removeFromTop(partHeight);
        const int count = static_cast<int>(parts_.size()) + (hasHands() ? 1 : 0),
                  width = std::min(partWidth, row.getWidth() / count);
        row = row.withSizeKeepingCentre(width * count, partHeight);
        for (auto& part : parts_) part->setBounds(row.removeFromLeft(width).reduced(8, 4));
        if (hasHands()) pause_.setBounds(row.reduced(8, 4));
        area.removeFromTop(16);
    }
    if (!answers_.standsAlone())
        answers_.setBounds(worldSet() != nullptr && !hasHands() ? area.removeFromBottom(choiceHeight) : area);
    pane_.setBounds(area.withTrimmedBottom(12));
    pane_.setVisible(worldSet() != nullptr && (!hasHands() || answers_.standsAlone() || !isAnswerSeen()));
}

} // namespace physvib
