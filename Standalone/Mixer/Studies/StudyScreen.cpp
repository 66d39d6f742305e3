// SPDX-License-Identifier: GPL-3.0-or-later
// Pages of the study screen, and its keys.
#include "Mixer/Studies/StudyScreen.h"
#include "Io/Text/NameList.h"
#include "Lab/Files/ProtocolFile.h"
#include "Live/Devices/NoDevice.h"
#include "Mixer/Window/Parts.h"
#include "Scene/LayoutNamed.h"
#include "Scene/SceneEdits.h"

namespace physvib {
namespace {

/// A record with the first stimulus of a condition, to check that it can be rendered.
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
    if (!s.objects.empty()) record.trial.parts = s.objects;
    return record;
}

std::string jobFault(Desk& desk, const Protocol& protocol, const ConditionPlan& condition,
                     const TrialJob& job) {
    if (!std::holds_alternative<WorldSet>(condition.stimuli))
        return StudySound::make(desk, job, protocol.folder).error;
    const auto world = feltWorld(std::get<WrittenCall>(job), protocol.folder);
    return world ? StudyWorld::refusal(desk, world.value) : world.error;
}

} // namespace

Apparatus apparatusOf(Desk& desk) {
    const ListeningSettings& listening = desk.device().listening().settings();
    Apparatus with{PHYSVIB_VERSION, desk.output().device(), desk.mix().levelDb};
    if (!listening.noise.empty()) with.noiseDb = listening.noiseDb;
    const auto add = [](std::string& words, int output) {
        words.append(words.empty() ? "" : " ").append(output < 0 ? "-" : std::to_string(output + 1));
    };
    for (const Strip& strip : desk.mix().strips) add(with.outputs, strip.output);
    for (const int output : listening.noise) add(with.noiseOutputs, output);
    return with;
}

bool hasNoDevice(const Desk& desk) { return desk.output().device().starts_with(noDeviceType); }

std::string feltFault(const Protocol& protocol, Desk& desk) {
    for (std::size_t c = 0; c < protocol.conditions.size(); ++c)
        for (std::size_t s = 0; s < protocol.sessions.size(); ++s)
            for (const TrialJob& job : jobsOf(protocol, firstRecord(protocol, c, s)))
                if (auto fault = jobFault(desk, protocol, protocol.conditions[c], job); !fault.empty())
                    return fault;
    return {};
}

std::string outputsFault(const Protocol& protocol, const Desk& desk) {
    const auto& strips = desk.mix().strips;
    const auto& map = desk.output().channelMap();
    for (const ConditionPlan& condition : protocol.conditions) {
        const auto layout = layoutNamed(besideProtocol(protocol.folder, condition.layout));
        const std::size_t wanted = layout.value.enchanters.size();
        if (!layout) return layout.error;
        if (wanted > strips.size())
            return condition.layout + ": expected " + std::to_string(wanted) +
                   " actuators in the mixer, found " + std::to_string(strips.size());
        std::vector<std::string> without;
        for (std::size_t j = 0; j < wanted; ++j)
            if (const int output = j < map.size() ? map[j] : -1;
                !hasNoDevice(desk) && (output < 0 || output >= desk.device().outputs()))
                without.push_back(desk.mix().layout.enchanters[j].label);
        if (!without.empty())
            return std::to_string(without.size()) + " of " + std::to_string(wanted) +
                   (without.size() == 1 ? " actuators has no output: " : " actuators have no output: ") +
                   listed(without);
    }
    return desk.output().isPlaying()
               ? std::string{}
               : "expected a device that runs, found none: " +
                     (desk.output().device().empty() ? "no device is open" : desk.output().device());
}

StudyScreen::StudyScreen(Desk& desk, std::unique_ptr<StudyInProgress> study, Words words,
                         bool answersElsewhere, std::vector<MaterialPicture> pictures)
    : desk_{desk}
    , study_{std::move(study)}
    , say_{std::move(words)}
    , pictures_{std::move(pictures)}
    , sound_{desk}
    , pane_{desk}
    , squaresBefore_{squareGSecondsOf(study_->exposureToday()) - desk.exposure().squareGSeconds()}
    , answers_{say_}
    , markers_{study_->protocol().name} {
    setTitle("Study");
    setOpaque(true);
    setWantsKeyboardFocus(true);
    setFocusContainerType(FocusContainerType::keyboardFocusContainer);
    next_.setMain(true);
    next_.onClick = [this] { goOn(); };
    pause_.onClick = [this] { pause(); };
    silence_.setTitle("Silence");
    silence_.getProperties().set(stopProperty, true);
    silence_.onClick = [this] { desk_.setSilent(!desk_.isSilent()), refresh(); };
    leave_ = quietButton(say_("Leave"), "Leave the study; what was answered is kept");
    leave_->onClick = [this] { leave(); };
    comment_.setTitle("Comment");
    comment_.setMultiLine(true);
    comment_.setReturnKeyStartsNewLine(true);
    comment_.setEscapeAndReturnKeysConsumed(false);
    pane_.show(pictures_);
    pane_.onFault = [this](const std::string& fault) { desk_.report(utf8(fault)); };
    answers_.onConfirm = [this] { confirm(); };
    answers_.onKey = [this](const juce::KeyPress& key) { return keyPressed(key); };
    answers_.setStandsAlone(answersElsewhere);
    for (juce::Component* c : std::initializer_list<juce::Component*>{&next_, &silence_, leave_.get()})
        addAndMakeVisible(c);
    for (juce::Component* c : std::initializer_list<juce::Component*>{&pane_, &pause_, &comment_})
        addChildComponent(c);
    if (!answersElsewhere) addChildComponent(answers_);
    prepareControls(*this);
    showNext();
}

StudyScreen::~StudyScreen() = default;

void StudyScreen::parentSizeChanged() {
    if (auto* parent = getParentComponent()) setBounds(parent->getLocalBounds());
}

// ---- pages

void StudyScreen::showNext() {
    const bool asksComment = page_ == Page::trial && !study_->protocol().closingQuestion.empty();
    if (experiment().isDone())
        return note(studyEvents::end), showPage(asksComment ? Page::comment : Page::done);
    if (isExposed()) return showPage(Page::exposed);
    const Trial& trial = experiment().trial();
    const bool isFirstSeen = !answers_;
    if (!isFirstSeen && trial.number > 1 && trial.restSeconds <= 0.0) return showTrial();
    restEndsMs_ = nowMs() + 1e3 * study_->restLeft();
    if (trial.restSeconds > 0.0 && !study_->hasRested()) note(studyEvents::rest);
    showPage(Page::pause);
}

void StudyScreen::showPage(Page page) {
    page_ = page;
    answers_.show(nullptr);
    parts_.clear();
    progress_.reset();
    for (juce::Component* c : std::initializer_list<juce::Component*>{&pane_, &pause_, &answers_})
        c->setVisible(c == &answers_ && answers_.standsAlone());
    comment_.setVisible(page == Page::comment);
    next_.setVisible(true);
    resized();
    refresh();
    if (isShowing() && page == Page::comment)
        comment_.grabKeyboardFocus();
    else if (isShowing() && next_.isEnabled())
        next_.grabKeyboardFocus();
    repaint();
}

void StudyScreen::showTrial() {
    auto layout = layoutNamed(besideProtocol(study_->protocol().folder, experiment().condition().layout));
    if (!layout) return fail(layout.error);
    if (answers_.standsAlone() && !elsewhere_) elsewhere_ = makeAnswerWindow(answers_, *this);
    layout_ = std::move(layout.value);
    page_ = Page::trial;
    progress_.emplace(experiment().session(), experiment().trial());
    exploring_.reset();
    wanted_.reset();
    sessions_.clear();
    felt_.assign(std::max<std::size_t>(1, experiment().trial().parts.size()), {});
    unlike_.assign(felt_.size(), 0);
    isLost_ = false;
    part_ = 0;
    counted_ = firstFeltMs_ = 0.0;
    auto answer = makeStudyAnswer(experiment(), layout_, say_);
    answer->onAnswer = [this] { asked(); };
    answer->onChange = [this] { refresh(); };
    if (isExploring()) answer->mark(experiment().explored());
    answers_.show(std::move(answer));
    if (worldSet() != nullptr) pane_.setWorldScale(worldSet()->displayScale), previewWorld();
    answers_.setVisible(true);
    next_.setVisible(false);
    pane_.setVisible(worldSet() != nullptr);
    pause_.setVisible(hasHands());
    showParts();
    prepareControls(*this);
    answers_.setHasFocusOutline(false); // a frame around the whole pane would not show a target
    resized();
    refresh();
    repaint();
    if (isShowing()) grabKeyboardFocus();
}

/// Shows the world of the first button, paused until it is played.
void StudyScreen::previewWorld() {
    const auto jobs = jobsOf(study_->protocol(), {experiment().trial(), answers_->answer()});
    const auto world = feltWorld(std::get<WrittenCall>(jobs.front()), study_->protocol().folder);
    if (world) pane_.preview(hasHands() ? sceneForHands(world.value.setup.scene) : world.value.setup.scene);
}

void StudyScreen::showParts() {
    parts_.clear();
    if (isExploring()) return;
    const auto count = std::max<std::size_t>(1, experiment().trial().parts.size());
    for (std::size_t i = 0; i < count; ++i) {
        auto& button = parts_.emplace_back(std::make_unique<BigButton>(
            "Feel it",
            count == 1 ? juce::String{"Feel it"} : "Feel number " + juce::String{static_cast<int>(i) + 1}));
        button->onClick = [this, i] { play(i); };
        addAndMakeVisible(*button);
    }
}

void StudyScreen::fail(const std::string& reason) {
    fault_ = reason;
    sound_.stop();
    pane_.world().end();
    showPage(Page::fault);
}

void StudyScreen::note(std::string_view event) {
    if (const auto fault = study_->note(event); !fault.empty()) desk_.report(utf8(fault));
}

void StudyScreen::closeRequested() {
    if (page_ == Page::comment) return takeComment();
    if (page_ != Page::pause && page_ != Page::trial) return leave();
    note(studyEvents::pause);
    sound_.stop();
    pane_.world().end();
    showPage(Page::paused);
}

void StudyScreen::leave() {
    if (isFeeling() && !hasHands()) return;
    if (!experiment().isDone()) note(studyEvents::leave);
    // asynchronous, because it deletes this component
    if (onClose) juce::MessageManager::callAsync([close = onClose] { close(); });
}

void StudyScreen::goOn() {
    switch (page_) {
    case Page::pause:
        if (restLeft() > 0.0) return;
        if (study_->isResting()) note(studyEvents::goOn);
        wasRight_.reset(); // it stood on this page
        return showTrial();
    case Page::paused: return note(studyEvents::goOn), showNext();
    case Page::trial: return;
    case Page::comment: return takeComment();
    case Page::done:
    case Page::exposed:
    case Page::fault: return leave();
    }
}

void StudyScreen::takeComment() {
    if (const auto words = comment_.getText().trim(); words.isNotEmpty())
        if (const auto fault = study_->keepComment(words.toStdString()); !fault.empty()) return fail(fault);
    showPage(Page::done);
}

// ---- keys

bool StudyScreen::keyPressed(const juce::KeyPress& key) {
    using juce::KeyPress;
    if (key.isKeyCode(KeyPress::tabKey)) return false; // moves the focus
    const int digit = static_cast<int>(key.getTextCharacter() - '1');
    if (key.isKeyCode(KeyPress::escapeKey))
        desk_.setSilent(true), refresh();
    else if (page_ == Page::comment)
        return false;
    else if (page_ == Page::trial && pane_.takeKey(key)) {
    } else if (page_ == Page::trial && hasHands() && digit >= 0 && digit < static_cast<int>(parts_.size()))
        play(static_cast<std::size_t>(digit));
    else if (page_ == Page::trial && isAnswerSeen() && answers_->takeKey(key)) {
    } else if (page_ == Page::trial && key.isKeyCode(KeyPress::spaceKey) && pause_.isShowing() &&
               pause_.isEnabled())
        pause();
    else if (page_ == Page::trial && key.isKeyCode(KeyPress::spaceKey) && !parts_.empty())
        play(nextPart());
    else if (key.isKeyCode(KeyPress::returnKey) && page_ == Page::trial)
        answers_.confirm();
    else if (key.isKeyCode(KeyPress::returnKey) && next_.isVisible() && next_.isEnabled())
        goOn();
    return true; // no key reaches the mixer below
}

} // namespace physvib
