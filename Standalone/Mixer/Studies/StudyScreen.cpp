// SPDX-License-Identifier: GPL-3.0-or-later
// From page to page.
#include "Mixer/Studies/StudyScreen.h"
#include "CommandLine/Render/LayoutNamed.h"
#include "Files/ProtocolFile.h"
#include "Mixer/Window/Parts.h"
#include "Mixer/Studies/StudyWords.h"
#include <cmath>

namespace physvib {
namespace {

constexpr int barHeight = 56, inset = 40, partWidth = 300, partHeight = 84;

/// The answer as it would be with the first stimulus of a condition, to see what it renders to.
TrialRecord firstRecord(const Protocol& protocol, std::size_t condition, std::size_t session) {
    const SessionPlan& s = protocol.sessions[session];
    TrialRecord record;
    record.trial.condition = condition;
    record.trial.session = session;
    record.trial.stimulus = stimuliOf(protocol.conditions[condition]).front().label;
    for (const Alternative& a : s.alternatives) {
        record.trial.parts.push_back(a.name);
        record.trial.partLevelsDb.push_back(a.levelDb);
    }
    if (s.task == StudyTask::rate) record.trial.parts = s.objects;
    return record;
}

} // namespace

std::string feltFault(const Protocol& protocol, Desk& desk) {
    for (std::size_t c = 0; c < protocol.conditions.size(); ++c)
        for (std::size_t s = 0; s < protocol.sessions.size(); ++s)
            for (const std::string& call : partCallsOf(protocol, firstRecord(protocol, c, s)))
                if (const auto stimulus = StudySound::make(desk, call, protocol.folder); !stimulus) return stimulus.error;
    return {};
}

StudyScreen::StudyScreen(Desk& desk, std::unique_ptr<StudyRun> study)
    : desk_{desk}
    , study_{std::move(study)}
    , sound_{desk}
    , squaresBefore_{squareGSecondsOf(study_->exposureToday()) - desk.exposure().squareGSeconds()} {
    setTitle("Study");
    setOpaque(true);
    setWantsKeyboardFocus(true);
    setFocusContainerType(FocusContainerType::keyboardFocusContainer);
    next_.setMain(true);
    next_.onClick = [this] { goOn(); };
    silence_.setTitle("Silence");
    silence_.getProperties().set(stopProperty, true);
    silence_.onClick = [this] { desk_.setSilent(!desk_.isSilent()), refresh(); };
    leave_ = quietButton("Leave", "Leave the study; what was answered is kept");
    leave_->onClick = [this] { leave(); };
    for (juce::Component* c : std::initializer_list<juce::Component*>{&next_, &silence_, leave_.get()}) addAndMakeVisible(c);
    prepareControls(*this);
    showNext();
}

StudyScreen::~StudyScreen() = default;

void StudyScreen::parentSizeChanged() {
    if (auto* parent = getParentComponent()) setBounds(parent->getLocalBounds());
}

// ---- pages

void StudyScreen::showNext() {
    if (experiment().isDone()) return showPage(Page::done);
    if (isExposed()) return showPage(Page::exposed);
    const Trial& trial = experiment().trial();
    const bool isFirstSeen = answer_ == nullptr;
    if (!isFirstSeen && trial.number > 1 && trial.restSeconds <= 0.0) return showTrial();
    restEndsMs_ = nowMs() + 1e3 * trial.restSeconds;
    showPage(Page::pause);
}

void StudyScreen::showPage(Page page) {
    page_ = page;
    answer_.reset();
    parts_.clear();
    resized();
    refresh();
    if (isShowing() && next_.isEnabled()) next_.grabKeyboardFocus();
    repaint();
}

void StudyScreen::showTrial() {
    auto layout = layoutNamed(besideProtocol(study_->protocol().folder, experiment().condition().layout));
    if (!layout) return fail(layout.error);
    layout_ = std::move(layout.value);
    page_ = Page::trial;
    progress_.emplace(experiment().session(), experiment().trial());
    exploring_.reset();
    felt_.assign(std::max<std::size_t>(1, experiment().trial().parts.size()), {});
    part_ = 0;
    counted_ = firstFeltMs_ = 0.0;
    answer_ = makeStudyAnswer(experiment(), layout_);
    answer_->onAnswer = [this] { answered(); };
    answer_->onChange = [this] { refresh(); };
    if (isExploring()) answer_->mark(experiment().explored());
    addAndMakeVisible(*answer_);
    showParts();
    prepareControls(*this);
    resized();
    refresh();
    repaint();
    if (isShowing()) grabKeyboardFocus();
}

void StudyScreen::showParts() {
    parts_.clear();
    if (isExploring()) return;
    const auto count = std::max<std::size_t>(1, experiment().trial().parts.size());
    for (std::size_t i = 0; i < count; ++i) {
        auto& button = parts_.emplace_back(std::make_unique<BigButton>("Feel it", count == 1 ? juce::String{"Feel it"} : "Feel number " + juce::String{static_cast<int>(i) + 1}));
        button->onClick = [this, i] { play(i); };
        addAndMakeVisible(*button);
    }
}

void StudyScreen::fail(const std::string& reason) {
    fault_ = reason;
    sound_.stop();
    showPage(Page::fault);
}

void StudyScreen::leave() {
    if (sound_.isPlaying()) return;
    if (onClose) juce::MessageManager::callAsync([close = onClose] { close(); }); // it ends with this component
}

void StudyScreen::goOn() {
    switch (page_) {
    case Page::pause: if (restLeft() <= 0.0) showTrial(); return;
    case Page::trial: return answered();
    case Page::done:
    case Page::exposed:
    case Page::fault: return leave();
    }
}

// ---- a trial

bool StudyScreen::isExploring() const { return experiment().trial().task == StudyTask::explore; }

bool StudyScreen::canAnswer() const { return progress_->canAnswer() && !sound_.isPlaying(); }

double StudyScreen::restLeft() const { return std::max(0.0, 1e-3 * (restEndsMs_ - nowMs())); }

/// The one after the last that was felt, and the first to begin with.
std::size_t StudyScreen::nextPart() const { return progress_->plays() == 0 ? 0 : (part_ + 1) % parts_.size(); }

void StudyScreen::play(std::size_t part) {
    if (page_ != Page::trial || sound_.isPlaying() || desk_.isSilent() || !progress_->canPlay(part)) return;
    const TrialRecord asked{experiment().trial(), exploring_.value_or(answer_->answer())};
    const auto stimulus = StudySound::make(desk_, partCallsOf(study_->protocol(), asked)[part], study_->protocol().folder);
    if (!stimulus) return fail(stimulus.error);
    noteFelt();
    if (const auto fault = sound_.play(stimulus.value); !fault.empty()) return fail(fault);
    if (progress_->plays() == 0) firstFeltMs_ = nowMs();
    progress_->played(part);
    part_ = part;
    counted_ = 0.0;
    refresh();
}

void StudyScreen::answered() {
    if (page_ != Page::trial || !answer_->isComplete() || sound_.isPlaying()) return;
    if (isExploring()) {
        exploring_ = answer_->answer();
        play(0);
    } else if (canAnswer()) {
        take(answer_->answer());
    }
}

/// Of the part that was felt last, before another is.
void StudyScreen::noteFelt() {
    desk_.exposure().update();
    if (progress_->plays() > 0) felt_[part_] = desk_.exposure().felt(sound_.feltSeconds());
}

/// A(8) of what this study's trials of today have cost the participant.
double StudyScreen::exposure() const { return dailyExposure(std::max(0.0, squaresBefore_ + desk_.exposure().squareGSeconds())); }

void StudyScreen::take(Answer answer) {
    noteFelt();
    answer.felt = felt_;
    answer.exposure = exposure();
    answer.plays = std::max(1, progress_->plays());
    answer.seconds = std::round(nowMs() - firstFeltMs_) * 1e-3;
    const auto session = experiment().sessionNumber();
    if (!study_->take(std::move(answer))) return fail(study_->error());
    const bool staysOpen = !experiment().isDone() && isExploring() && experiment().sessionNumber() == session && experiment().trial().restSeconds <= 0.0 && !isExposed();
    if (!staysOpen) return showNext();
    exploring_.reset(); // the same screen, with what was felt marked
    progress_.emplace(experiment().session(), experiment().trial());
    answer_->mark(experiment().explored());
    refresh();
    answer_->repaint();
}

void StudyScreen::refresh() {
    if (isShowing() && !hasKeyboardFocus(true)) grabKeyboardFocus(); // first: an open answer takes it from here
    const bool isTrial = page_ == Page::trial;
    const bool isSilent = desk_.isSilent();
    silence_.setButtonText(isSilent ? "SILENT  Esc: feel" : "SILENCE  Esc");
    silence_.setToggleState(isSilent, juce::dontSendNotification);
    leave_->setEnabled(!sound_.isPlaying());
    if (isTrial) updateTrial();
    if (page_ == Page::pause) {
        next_.setEnabled(restLeft() <= 0.0);
        next_.setWords(experiment().trial().number == 1 ? "Begin" : "Go on", "Enter");
    }
    if (page_ == Page::done || page_ == Page::exposed || page_ == Page::fault) next_.setEnabled(true), next_.setWords("Close", "Enter");
    if (auto words = headline() + "\n" + body() + "\n" + progressWords(); words != shown_) {
        shown_ = words;
        setDescription(words);
        repaint();
    }
}

void StudyScreen::updateTrial() {
    if (progress_->plays() > 0) { // what was felt since the last time
        const double felt = sound_.feltSeconds();
        progress_->spent(part_, felt - counted_);
        counted_ = felt;
    }
    if (exploring_ && !sound_.isPlaying() && progress_->plays() > 0) return take(*exploring_);
    const bool isOpen = !sound_.isPlaying() && !desk_.isSilent() && (progress_->canAnswer() || answer_->isOpen() || isExploring());
    if (isOpen != answer_->isEnabled()) answer_->setEnabled(isOpen);
    if (isOpen && hasKeyboardFocus(false)) answer_->begin();
    next_.setVisible(answer_->needsNext());
    next_.setEnabled(canAnswer() && answer_->isComplete());
    next_.setWords("Next", "Enter");
    updateParts();
}

void StudyScreen::updateParts() {
    const SessionPlan& session = experiment().session();
    const Trial& trial = experiment().trial();
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        auto& button = *parts_[i];
        const bool isPlaying = sound_.isPlaying() && part_ == i, wasFelt = progress_->plays(i) > 0;
        juce::String words = parts_.size() == 1 ? juce::String{wasFelt ? "Feel it again" : "Feel it"} : juce::String{static_cast<int>(i) + 1};
        if (trial.task == StudyTask::rate && !trial.parts.empty()) words += "   " + utf8(trial.parts[i]);
        if (trial.task == StudyTask::adjust && session.adjustment->alternative == trial.parts[i]) words += "   to be matched";
        juce::StringArray remarks;
        if (isPlaying) remarks.add("feel it now");
        else if (i == nextPart()) remarks.add("space bar");
        if (session.mostPlays > 0) remarks.add(juce::String{session.mostPlays - progress_->plays(i)} + " of " + juce::String{session.mostPlays} + " left");
        else if (wasFelt && !isPlaying) remarks.add("felt " + juce::String{progress_->plays(i)} + (progress_->plays(i) == 1 ? " time" : " times"));
        button.setWords(words, remarks.joinIntoString(",  "));
        button.setToggleState(isPlaying, juce::dontSendNotification);
        button.setEnabled(!sound_.isPlaying() && !desk_.isSilent() && progress_->canPlay(i));
        if (session.leastSeconds > 0.0) button.setShare(progress_->seconds(i) / session.leastSeconds);
    }
}

bool StudyScreen::keyPressed(const juce::KeyPress& key) {
    using juce::KeyPress;
    if (key.isKeyCode(KeyPress::tabKey)) return false; // moves the focus
    if (key.isKeyCode(KeyPress::escapeKey)) silence_.onClick();
    else if (page_ == Page::trial && key.isKeyCode(KeyPress::spaceKey) && !parts_.empty()) play(nextPart());
    else if (page_ == Page::trial && answer_->takeKey(key)) {}
    else if (key.isKeyCode(KeyPress::returnKey) && next_.isVisible() && next_.isEnabled()) goOn();
    return true; // nothing reaches the mixer below
}

// ---- words and places

juce::String StudyScreen::headline() const {
    switch (page_) {
    case Page::trial: return questionOf(experiment().session(), experiment().condition());
    case Page::done: return "Thank you. That was everything.";
    case Page::exposed: return "That is enough vibration for today: the study pauses.";
    case Page::fault: return "The study cannot go on.";
    case Page::pause: break;
    }
    const Trial& trial = experiment().trial();
    if (restLeft() > 0.0) return "A break: rest your hands.  " + minutesText(restLeft());
    if (trial.number > 1) return "Ready to go on?";
    return experiment().session().isTraining ? "Training" : "The study";
}

juce::String StudyScreen::body() const {
    switch (page_) {
    case Page::trial: return desk_.isSilent() ? "Everything is silent. Esc: feel again." : desk_.trouble();
    case Page::done: return "Your answers are in\n" + utf8(study_->path().string());
    case Page::exposed:
        return "Your hands have taken A(8) = " + number(exposure(), 2) + " m/s^2 (ISO 5349-1); this study's limit is " + number(study_->protocol().exposureLimit, 2) +
               " m/s^2.\nWhat you answered is kept, and the study goes on there another day.";
    case Page::fault: return utf8(fault_) + "\nWhat was answered so far is kept, and the study goes on there.";
    case Page::pause: return instructionOf(experiment().session(), experiment().condition());
    }
    return {};
}

juce::String StudyScreen::progressWords() const {
    if (experiment().isDone()) return juce::String{experiment().trialsTaken()} + " trials";
    const auto& session = experiment().session();
    const int sessions = static_cast<int>(study_->protocol().conditions.size() * study_->protocol().sessions.size());
    juce::String words = session.isTraining ? "Training" : "Study";
    if (sessions > 1) words += ", part " + juce::String{experiment().sessionNumber()} + " of " + juce::String{sessions};
    words += juce::String::fromUTF8("   \xc2\xb7   trial ") + juce::String{experiment().trial().number};
    if (experiment().sessionTrials() > 0) words += " of " + juce::String{experiment().sessionTrials()};
    return words;
}

void StudyScreen::paint(juce::Graphics& g) {
    g.fillAll(shade(*this, Shade::ground));
    g.setColour(shade(*this, Shade::muted));
    g.setFont(juce::Font{text::medium});
    g.drawText(progressWords(), headArea_, juce::Justification::centredLeft, true);
    if (!experiment().isDone() && experiment().sessionTrials() > 0) {
        const auto bar = juce::Rectangle<int>{inset, barHeight - 2, getWidth() - 2 * inset, 4}.toFloat();
        g.setColour(shade(*this, Shade::line));
        g.fillRoundedRectangle(bar, 2.0f);
        g.setColour(shade(*this, Shade::accent));
        g.fillRoundedRectangle(bar.withWidth(bar.getWidth() * static_cast<float>(experiment().trial().number - 1) / static_cast<float>(experiment().sessionTrials())), 2.0f);
    }
    g.setColour(shade(*this, Shade::text));
    g.setFont(juce::Font{text::large, juce::Font::bold});
    g.drawFittedText(headline(), questionArea_, juce::Justification::centred, 2);
    g.setColour(shade(*this, page_ == Page::trial ? Shade::now : Shade::muted));
    g.setFont(juce::Font{page_ == Page::trial ? text::medium : text::large});
    g.drawFittedText(body(), bodyArea_, juce::Justification::centredTop, 6);
    if (page_ != Page::trial) return;
    g.setColour(shade(*this, Shade::muted));
    g.setFont(juce::Font{text::small});
    juce::String keys = answer_->keys();
    if (!parts_.empty()) keys = "Space: feel.  " + keys;
    g.drawText(keys, keysArea_, juce::Justification::centredLeft, true);
}

void StudyScreen::resized() {
    auto area = getLocalBounds().reduced(inset, 0);
    auto head = area.removeFromTop(barHeight - 8);
    silence_.setBounds(head.removeFromRight(160).withTrimmedTop(8));
    leave_->setBounds(head.removeFromRight(110).reduced(16, 10));
    headArea_ = head;
    area.removeFromTop(20);
    if (page_ != Page::trial) {
        auto middle = area.withSizeKeepingCentre(std::min(900, area.getWidth()), 320);
        questionArea_ = middle.removeFromTop(60);
        bodyArea_ = middle.removeFromTop(150);
        next_.setVisible(true);
        next_.setBounds(middle.withSizeKeepingCentre(260, 72));
        return;
    }
    questionArea_ = area.removeFromTop(40);
    bodyArea_ = area.removeFromTop(24);
    auto foot = area.removeFromBottom(answer_ && answer_->needsNext() ? 96 : 36);
    next_.setBounds(foot.withSizeKeepingCentre(260, 68));
    keysArea_ = foot.removeFromBottom(36).withWidth((foot.getWidth() - 300) / 2);
    if (!parts_.empty()) {
        auto row = area.removeFromTop(partHeight);
        const int count = static_cast<int>(parts_.size()), width = std::min(partWidth, row.getWidth() / count);
        row = row.withSizeKeepingCentre(width * count, partHeight);
        for (auto& part : parts_) part->setBounds(row.removeFromLeft(width).reduced(8, 4));
        area.removeFromTop(16);
    }
    if (answer_) answer_->setBounds(area);
}

} // namespace physvib
