// SPDX-License-Identifier: GPL-3.0-or-later
// Pages of the study screen, and its keys.
#include "Mixer/Studies/StudyScreen.h"
#include "Core/Units.h"
#include "Io/Text/NameList.h"
#include "Io/Text/NumberText.h"
#include "Lab/Files/ProtocolFile.h"
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

std::string jobFault(MixerModel& model, const Protocol& protocol, const ConditionPlan& condition,
                     const TrialJob& job) {
    if (!std::holds_alternative<WorldSet>(condition.stimuli))
        return StudySound::make(model, job, protocol.folder).error;
    const auto world = feltWorld(std::get<WrittenCall>(job), protocol.folder);
    return world ? StudyWorld::refusal(model, world.value) : world.error;
}

/// Minutes and seconds, such as "1:05".
juce::String minutesText(double seconds) {
    const int whole = static_cast<int>(std::ceil(seconds));
    return juce::String{whole / 60} + ":" + juce::String{whole % 60}.paddedLeft('0', 2);
}

constexpr int maxUnlike = 3; // plays of a part at another level than planned; then its row is marked

constexpr int studyBarHeight = 56, partWidth = 300, partHeight = 84, choiceHeight = 216;

} // namespace

Apparatus apparatusOf(MixerModel& model) {
    const ListeningSettings& listening = model.device().listening().settings();
    Apparatus with{PHYSVIB_VERSION, model.output().device(), model.mix().levelDb};
    if (!listening.noise.empty()) with.noiseDb = listening.noiseDb;
    const auto add = [](std::string& words, int output) {
        words.append(words.empty() ? "" : " ").append(output < 0 ? "-" : std::to_string(output + 1));
    };
    for (const Strip& strip : model.mix().strips) add(with.outputs, strip.output);
    for (const int output : listening.noise) add(with.noiseOutputs, output);
    return with;
}

std::string feltFault(const Protocol& protocol, MixerModel& model) {
    for (std::size_t c = 0; c < protocol.conditions.size(); ++c)
        for (std::size_t s = 0; s < protocol.sessions.size(); ++s)
            for (const TrialJob& job : jobsOf(protocol, firstRecord(protocol, c, s)))
                if (auto fault = jobFault(model, protocol, protocol.conditions[c], job); !fault.empty())
                    return fault;
    return {};
}

std::string outputsFault(const Protocol& protocol, const MixerModel& model) {
    const auto& strips = model.mix().strips;
    const auto& map = model.output().channelMap();
    std::size_t most = 0;
    for (const ConditionPlan& condition : protocol.conditions) {
        const auto layout = layoutNamed(besideProtocol(protocol.folder, condition.layout));
        if (!layout) return layout.error;
        const std::size_t wanted = layout.value.enchanters.size();
        if (wanted > strips.size())
            return tooFew(condition.layout, static_cast<int>(wanted), static_cast<int>(strips.size()));
        most = std::max(most, wanted);
    }
    std::vector<std::string> without;
    for (std::size_t j = 0; j < most; ++j)
        if (const int output = j < map.size() ? map[j] : -1;
            !model.device().isNone() && (output < 0 || output >= model.device().outputs()))
            without.push_back(model.mix().layout.enchanters[j].label);
    if (!without.empty())
        return std::to_string(without.size()) + " of " + std::to_string(most) +
               (without.size() == 1 ? " actuators has no output: " : " actuators have no output: ") +
               listed(without);
    return model.output().isPlaying()
               ? std::string{}
               : "expected a device that runs, found none: " +
                     (model.output().device().empty() ? "no device is open" : model.output().device());
}

StudyScreen::StudyScreen(MixerModel& model, std::unique_ptr<StudyInProgress> study, Words words,
                         bool answersElsewhere, std::vector<MaterialPicture> pictures)
    : FullScreen{model, "Study"}
    , study_{std::move(study)}
    , say_{std::move(words)}
    , pictures_{std::move(pictures)}
    , sound_{model}
    , pane_{model}
    , squaresBefore_{squareGSecondsOf(study_->exposureToday()) - model.exposure().squareGSeconds()}
    , answers_{say_}
    , markers_{study_->protocol().name}
    , troubleBefore_{model.trouble()} {
    next_.setMain(true);
    next_.onClick = [this] { goOn(); };
    pause_.onClick = [this] { pause(); };
    leave_ = quietButton(say_("Leave"), "Leave the study; what was answered is kept", [this] { leave(); });
    comment_.setTitle("Comment");
    comment_.setMultiLine(true);
    comment_.setReturnKeyStartsNewLine(true);
    comment_.setEscapeAndReturnKeysConsumed(false);
    pane_.show(pictures_);
    pane_.onFault = [this](const std::string& fault) { model_.report(utf8(fault)); };
    answers_.onConfirm = [this] { confirm(); };
    answers_.onKey = [this](const juce::KeyPress& key) { return keyPressed(key); };
    answers_.setStandsAlone(answersElsewhere);
    addAll(*this, {&next_, &silence_, leave_.get()});
    addHidden(*this, {&pane_, &pause_, &comment_});
    if (!answersElsewhere) addChildComponent(answers_);
    prepareControls(*this);
    showNext();
}

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
    physvib::setVisible({&pane_, &pause_}, false);
    answers_.setVisible(answers_.standsAlone());
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
    const bool isOnce = experiment().session().isOnce; // nothing is felt
    felt_.assign(isOnce ? 0 : std::max<std::size_t>(1, experiment().trial().parts.size()), {});
    unlike_.assign(felt_.size(), 0);
    isLost_ = false;
    openSeconds_.reset();
    part_ = 0;
    counted_ = 0.0;
    firstFeltMs_ = isOnce ? nowMs() : 0.0;
    auto answer = makeStudyAnswer(experiment(), layout_, say_);
    answer->onAnswer = [this] { asked(); };
    answer->onChange = [this] { refresh(); };
    if (isExploring()) answer->mark(experiment().explored());
    answers_.show(std::move(answer));
    if (const WorldSet* const set = worldSet()) { // previews the first button's world
        pane_.setWorldScale(set->displayScale);
        const auto jobs = jobsOf(study_->protocol(), {experiment().trial(), answers_->answer()});
        const auto world = feltWorld(std::get<WrittenCall>(jobs.front()), study_->protocol().folder);
        if (world)
            pane_.preview(set->hasHands ? sceneForHands(world.value.setup.scene) : world.value.setup.scene);
    }
    answers_.setVisible(true);
    next_.setVisible(false);
    pane_.setVisible(worldSet() != nullptr);
    pause_.setVisible(hasHands());
    showParts();
    prepareControls(*this);
    setHasFocusOutline(false); // a frame around all of it would not show a target
    answers_.setHasFocusOutline(false);
    resized();
    refresh();
    repaint();
    if (isShowing()) grabKeyboardFocus();
}

void StudyScreen::showParts() {
    parts_.clear();
    if (isExploring() || experiment().session().isOnce) return;
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

void StudyScreen::closeRequested() {
    if (page_ == Page::comment) return submitComment();
    if (page_ != Page::pause && page_ != Page::trial) return leave();
    note(studyEvents::pause);
    sound_.stop();
    pane_.world().end();
    showPage(Page::paused);
}

void StudyScreen::leave() {
    if (isFeeling() && !hasHands()) return;
    if (!experiment().isDone()) note(studyEvents::leave);
    close();
}

void StudyScreen::goOn() {
    switch (page_) {
    case Page::pause:
        if (restLeft() > 0.0) return;
        if (study_->isResting()) note(studyEvents::goOn);
        wasRight_.reset(), ranOut_ = false; // this page has shown them
        return showTrial();
    case Page::paused: return note(studyEvents::goOn), showNext();
    case Page::trial: return;
    case Page::comment: return submitComment();
    case Page::done:
    case Page::exposed:
    case Page::fault: return leave();
    }
}

void StudyScreen::submitComment() {
    if (const auto words = comment_.getText().trim(); words.isNotEmpty())
        if (const auto fault = study_->keepComment(words.toStdString()); !fault.empty()) return fail(fault);
    showPage(Page::done);
}

bool StudyScreen::keyPressed(const juce::KeyPress& key) {
    using juce::KeyPress;
    if (key.isKeyCode(KeyPress::tabKey)) return false; // moves the focus
    const int digit = static_cast<int>(key.getTextCharacter() - '1');
    if (key.isKeyCode(KeyPress::escapeKey))
        model_.setSilent(true), refresh();
    else if (page_ == Page::comment)
        return false;
    else if (page_ == Page::trial && pane_.handleKey(key)) {
    } else if (page_ == Page::trial && hasHands() && digit >= 0 && digit < static_cast<int>(parts_.size()))
        play(static_cast<std::size_t>(digit));
    else if (page_ == Page::trial && isAnswerSeen() && answers_->handleKey(key)) {
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

/// Counts the time for an answer: from when one is accepted, except while nothing can be felt.
bool StudyScreen::isTimeOver() {
    const double passed = 1e-3 * (nowMs() - std::exchange(updatedMs_, nowMs()));
    if (!progress_->canAnswer())
        openSeconds_.reset(); // a part must be felt again
    else if (openSeconds_ && !model_.isSilent() && !isWaiting())
        *openSeconds_ += passed;
    else if (!openSeconds_ && canAnswer())
        openSeconds_ = 0.0;
    const double most = experiment().session().answerSeconds;
    return most > 0.0 && openSeconds_ && *openSeconds_ >= most && !isFeeling();
}

/// An interactive world has the whole screen until the participant leaves it to answer.
bool StudyScreen::isAnswerSeen() const { return answers_.standsAlone() || !hasHands() || canAnswer(); }

/// The part after the last played one; at first, the first.
std::size_t StudyScreen::nextPart() const {
    if (experiment().session().intervalSeconds > 0.0 && !hasHands()) return 0; // starts the sequence
    return progress_->plays() == 0 ? 0 : (part_ + 1) % parts_.size();
}

void StudyScreen::play(std::size_t part) {
    if (page_ != Page::trial || model_.isSilent() || isWaiting() || !progress_->canPlay(part)) return;
    if (isFeeling()) {
        if (!hasHands() || (part == part_ && pane_.world().isMoving())) return;
        wanted_ = part;
        return pane_.world().end();
    }
    if (const auto fault = begin(part); !fault.empty()) return isWaiting() ? refresh() : fail(fault);
    isLost_ = false;
    if (progress_->plays() == 0) firstFeltMs_ = nowMs();
    progress_->played(part);
    part_ = part;
    counted_ = 0.0;
    isToBeMarked_ = true;
    markFelt();
    if (hasHands()) resized();
    refresh();
}

std::string StudyScreen::begin(std::size_t part) {
    const TrialRecord asked{experiment().trial(), exploring_.value_or(answers_->answer())};
    const auto job = jobsOf(study_->protocol(), asked)[part];
    if (worldSet() == nullptr) {
        const auto stimulus = StudySound::make(model_, job, study_->protocol().folder);
        return stimulus ? sound_.play(stimulus.value) : stimulus.error;
    }
    auto world = feltWorld(std::get<WrittenCall>(job), study_->protocol().folder);
    if (!world) return world.error;
    const auto number = std::to_string(experiment().trialsTaken() + 1);
    const auto name = "trial-" + std::string(number.size() < 4 ? 4 - number.size() : 0, '0') + number + "-" +
                      std::to_string(sessions_.size() + 1) + ".json";
    const auto folder = study_->feltFolder();
    auto fault = pane_.begin(std::move(world.value), worldSet()->hasHands, folder / name);
    if (fault.empty()) sessions_.push_back((folder.filename() / name).string());
    return fault;
}

/// Decides by the receipts whether the play that is over counts.
void StudyScreen::settle(Course course) {
    model_.exposure().update();
    // stored now, because a restart of the device clears the receipts
    felt_[part_] = worldSet() != nullptr ? pane_.world().felt() : sound_.felt();
    int& unlike = unlike_[part_];
    unlike = course == Course::left ? 0 : course == Course::unlike ? unlike + 1 : unlike;
    if (course == Course::left || (course == Course::unlike && unlike >= maxUnlike)) return;
    markers_.push(markerWords("lost"));
    isLost_ = true;
    exploring_.reset();
    if (worldSet() != nullptr) sessions_.pop_back(); // the next one takes its name
    const bool isSequence = experiment().session().intervalSeconds > 0.0 && !hasHands();
    for (std::size_t part = isSequence ? 0 : part_; part <= part_; ++part) progress_->lost(part);
    counted_ = feltSeconds();
}

/// The parts after the first, each the session's interval after the one before.
void StudyScreen::playSequence() {
    const double interval = experiment().session().intervalSeconds;
    const std::size_t next = part_ + 1;
    if (interval > 0.0 && !isLost_ && !isFeeling() && !hasHands() && next < parts_.size() &&
        progress_->plays(next) < progress_->plays(part_) && nowMs() >= endedMs_ + 1e3 * interval)
        play(next);
}

void StudyScreen::pause() {
    if (!hasHands() || !progress_->canAnswer()) return;
    wanted_.reset();
    pane_.world().end();
    refresh();
}

/// An exploration plays the choice at once; other answers wait for confirmation.
void StudyScreen::asked() {
    if (page_ != Page::trial) return;
    if (!isExploring()) return refresh(), answers_.focusConfirm(); // it may be enabled only now
    if (isFeeling()) return;
    exploring_ = answers_->answer();
    play(0);
}

void StudyScreen::confirm() {
    if (page_ != Page::trial) return;
    if (isExploring()) {
        if (!experiment().mayEnd() || isFeeling()) return;
        study_->endSession();
        return showNext();
    }
    if (answers_->isComplete() && canAnswer()) submit(answers_->answer());
}

/// Marker text of the current trial: "felt;condition=PHONE;session=main;trial=3;stimulus=2,2;part=1".
std::string StudyScreen::markerWords(const char* what) const {
    const Trial& trial = experiment().trial();
    return std::string{what} + ";condition=" + experiment().condition().name +
           ";session=" + experiment().session().name + ";trial=" + std::to_string(trial.number) +
           ";stimulus=" + trial.stimulus;
}

// The start time of a stimulus is known when it is posted, that of a world when it is first felt.
void StudyScreen::markFelt() {
    if (!isToBeMarked_ || (worldSet() != nullptr && pane_.world().feltSeconds() <= 0.0)) return;
    isToBeMarked_ = false;
    const double fromNow = worldSet() != nullptr ? -pane_.world().feltSeconds() : sound_.startsInSeconds();
    markers_.push(
        markerWords("felt") + ";part=" +
            (experiment().trial().parts.empty() ? std::string{"1"} : experiment().trial().parts[part_]),
        fromNow);
}

/// The participant's A(8) from this study's trials of today.
double StudyScreen::exposure() const {
    return dailyExposure(std::max(0.0, squaresBefore_ + model_.exposure().squareGSeconds()));
}

void StudyScreen::submit(Answer answer) {
    model_.exposure().update();
    answer.felt = felt_;
    answer.apparatus = apparatusOf(model_);
    answer.limiterDb = std::exchange(limiterDb_, 0.0);
    answer.exposure = exposure();
    answer.plays = std::max(1, progress_->plays());
    if (!model_.device().isNone() && !felt_.empty())
        answer.left = std::ranges::all_of(unlike_, [](int plays) { return plays < maxUnlike; });
    answer.again = progress_->again();
    answer.seconds = std::round(nowMs() - firstFeltMs_) * 1e-3;
    answer.sessions = sessions_;
    const auto session = experiment().sessionNumber();
    ranOut_ = answer.ranOut;
    markers_.push(markerWords(ranOut_ ? "ran-out" : "answer") + ";response=" + answer.response);
    const auto right = isCorrect(study_->protocol(), {experiment().trial(), answer});
    wasRight_ = experiment().session().givesFeedback ? right : std::nullopt;
    if (!study_->take(std::move(answer))) return fail(study_->error());
    const bool staysOpen = !experiment().isDone() && isExploring() &&
                           experiment().sessionNumber() == session &&
                           experiment().trial().restSeconds <= 0.0 && !isExposed();
    if (!staysOpen) return showNext();
    exploring_.reset(); // stays on this screen and marks what was felt
    progress_.emplace(experiment().session(), experiment().trial());
    unlike_.assign(1, 0);
    answers_->mark(experiment().explored());
    refresh();
    answers_->repaint();
}

void StudyScreen::updateTrial() {
    if (progress_->plays() > 0) { // time felt since the last update
        const double felt = feltSeconds();
        progress_->spent(part_, felt - counted_);
        counted_ = felt;
    }
    const bool wasFeeling = isFeeling();
    if (wasFeeling)
        limiterDb_ = std::max(
            limiterDb_,
            -toDecibels(std::max(1e-6, static_cast<double>(model_.session().status().render.limiterGain))));
    pane_.refresh();
    sound_.update();
    markFelt();
    if (wasFeeling && !isFeeling()) settle(course()), endedMs_ = nowMs(), resized();
    if (!pane_.world().fault().empty()) return fail(pane_.world().fault());
    if (wanted_ && !isFeeling()) play(*std::exchange(wanted_, {}));
    playSequence();
    if (exploring_ && !isFeeling() && progress_->plays() > 0) return submit(*exploring_);
    if (Answer late; isTimeOver()) return late.ranOut = true, submit(late);
    // an answer may be given while the last part plays, and is confirmed after it
    const bool isOpen =
        !model_.isSilent() && (isFeeling() ? progress_->canAnswer() && !isExploring()
                                           : progress_->canAnswer() || answers_->isOpen() || isExploring());
    answers_.setVisible(isAnswerSeen());
    if (isOpen != answers_->isEnabled()) answers_->setEnabled(isOpen);
    if (isOpen && (answers_.standsAlone() ? answers_.hasKeyboardFocus(false) : hasKeyboardFocus(false)))
        answers_->begin();
    const bool mayConfirm =
        isExploring() ? experiment().mayEnd() && !isFeeling() : canAnswer() && answers_->isComplete();
    answers_.setConfirm(true, mayConfirm, say_(worldSet() != nullptr ? "OK" : "Next"));
    answers_.setQuestion(headline());
    updateParts();
    pause_.setEnabled(hasHands() && pane_.world().isMoving() && progress_->canAnswer());
    pause_.setWords(say_("PAUSE"),
                    say_(pause_.isEnabled() ? "space bar: answer" : "when each was felt for long enough"));
}

void StudyScreen::refresh() {
    const bool hasFocus = hasKeyboardFocus(true) || (elsewhere_ && elsewhere_->hasKeyboardFocus(true));
    if (isShowing() && !hasFocus) grabKeyboardFocus(); // an answer may then take it
    showSilence(say_("SILENT: press to feel"), say_("SILENCE  Esc"));
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
        const std::size_t open = session.reference.empty() ? 0 : 1;
        if (session.ratesSideBySide())
            words = i < open ? say_("Reference") : partLetter(i - open);
        else if (!session.objects.empty() && worldSet() == nullptr)
            words += "   " + say_(trial.parts[i]);
        const bool isMatched = session.adjustment && session.adjustment->alternative == trial.parts[i];
        if (isMatched) words += "   " + say_("to be matched");
        button.setMarked(isMatched);
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
        button.setEnabled((!isFeeling() || hasHands()) && !model_.isSilent() && !isWaiting() &&
                          progress_->canPlay(i) && !isInSequence);
        if (session.leastSeconds > 0.0) button.setShare(progress_->seconds(i) / session.leastSeconds);
    }
}

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

/// Feedback on the previous answer.
juce::String StudyScreen::feedback() const {
    if (ranOut_) return say_("Time was over.") + "  ";
    return wasRight_ ? say_(*wasRight_ ? "That was right." : "That was wrong.") + "  " : juce::String{};
}

// Why a participant feels nothing: neither news nor what the experimenter knew before the study counts.
juce::String StudyScreen::wrong() const {
    return model_.isNews() || model_.trouble() == troubleBefore_ ? model_.device().trouble()
                                                                 : model_.trouble();
}

juce::String StudyScreen::body() const {
    switch (page_) {
    case Page::trial:
        if (model_.isSilent()) return say_("Everything is silent. Press the button to feel again.");
        if (isWaiting()) return say_("Nothing can be felt now: the study waits for the device.");
        if (isLost_) return say_("That did not come through whole. Please feel it again.");
        if (feedback().isNotEmpty() && plays() == 0 && wrong().isEmpty()) return feedback().trimEnd();
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

void StudyScreen::paint(juce::Graphics& g) {
    g.fillAll(shade(*this, Shade::ground));
    ink(g, *this, Shade::muted, text::medium);
    g.drawText(progressWords(), headArea_, juce::Justification::centredLeft, true);
    if (!experiment().isDone() && experiment().sessionTrials() > 0) {
        const auto bar =
            juce::Rectangle<int>{pageInset, studyBarHeight - 2, getWidth() - 2 * pageInset, 4}.toFloat();
        fillRound(g, *this, Shade::line, bar, 2.0f);
        fillRound(g, *this, Shade::accent,
                  bar.withWidth(bar.getWidth() * static_cast<float>(experiment().trial().number - 1) /
                                static_cast<float>(experiment().sessionTrials())),
                  2.0f);
    }
    ink(g, *this, Shade::text, page_ == Page::trial ? text::large : 30.0f, juce::Font::bold);
    g.drawFittedText(headline(), questionArea_, juce::Justification::centred, 2, 1.0f);
    const bool isTrouble =
        page_ == Page::trial && (model_.isSilent() || isWaiting() || isLost_ || wrong().isNotEmpty());
    ink(g, *this, isTrouble ? Shade::limit : Shade::muted, page_ == Page::trial ? text::medium : text::large);
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
    g.setFont(text::font(text::medium));
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
