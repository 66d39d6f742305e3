// SPDX-License-Identifier: GPL-3.0-or-later
// Pages of the study screen and their keys; checks whether this mixer can play a study.
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
    record.trial.stimulus = conditionStimuli(protocol.conditions[condition]).front().label;
    for (const Alternative& a : s.alternatives) {
        record.trial.parts.push_back(a.name);
        record.trial.partLevelsDb.push_back(a.levelDb);
    }
    if (!s.objects.empty()) record.trial.parts = s.objects;
    return record;
}

std::string jobPlaybackError(MixerModel& model, const Protocol& protocol, const ConditionPlan& condition,
                             const TrialJob& job) {
    if (!std::holds_alternative<WorldSet>(condition.stimuli))
        return StimulusPlayer::prepare(model, job, protocol.folder).error;
    const auto world = makePlayableWorld(std::get<ResolvedCall>(job), protocol.folder);
    return world ? StudyWorld::playbackError(model, world.value) : world.error;
}

/// Minutes and seconds, such as "1:05".
juce::String minutesText(double seconds) {
    const int roundedSeconds = static_cast<int>(std::ceil(seconds));
    return juce::String{roundedSeconds / 60} + ":" + juce::String{roundedSeconds % 60}.paddedLeft('0', 2);
}

constexpr int maxWrongLevelPlays = 3; // of a part, until it counts; the trial's row is then marked

constexpr int studyBarHeight = 56, partWidth = 300, partHeight = 84, choiceHeight = 216;

} // namespace

Apparatus currentApparatus(MixerModel& model) {
    const ListeningSettings& listening = model.device().listening().settings();
    Apparatus apparatus{PHYSVIB_VERSION, model.output().device(), model.mix().levelDb};
    if (!listening.noise.empty()) apparatus.noiseDb = listening.noiseDb;
    const auto add = [](std::string& list, int output) {
        list.append(list.empty() ? "" : " ").append(output < 0 ? "-" : std::to_string(output + 1));
    };
    for (const Strip& strip : model.mix().strips) add(apparatus.outputs, strip.output);
    for (const int output : listening.noise) add(apparatus.noiseOutputs, output);
    return apparatus;
}

std::string findPlaybackError(const Protocol& protocol, MixerModel& model) {
    for (std::size_t c = 0; c < protocol.conditions.size(); ++c)
        for (std::size_t s = 0; s < protocol.sessions.size(); ++s)
            for (const TrialJob& job : trialJobs(protocol, firstRecord(protocol, c, s)))
                if (auto error = jobPlaybackError(model, protocol, protocol.conditions[c], job);
                    !error.empty())
                    return error;
    return {};
}

std::string outputsError(const Protocol& protocol, const MixerModel& model) {
    const auto& strips = model.mix().strips;
    const auto& channelMap = model.output().channelMap();
    std::size_t maxActuators = 0;
    for (const ConditionPlan& condition : protocol.conditions) {
        const auto layout = resolveLayout(resolveProtocolPath(protocol.folder, condition.layout));
        if (!layout) return layout.error;
        const std::size_t needed = layout.value.actuators.size();
        if (needed > strips.size())
            return actuatorCountError(condition.layout, static_cast<int>(needed),
                                      static_cast<int>(strips.size()));
        maxActuators = std::max(maxActuators, needed);
    }
    std::vector<std::string> labels;
    for (std::size_t j = 0; j < maxActuators; ++j)
        if (const int output = j < channelMap.size() ? channelMap[j] : -1;
            !model.device().hasNoDevice() && (output < 0 || output >= model.device().outputCount()))
            labels.push_back(model.mix().layout.actuators[j].label);
    if (!labels.empty())
        return std::to_string(labels.size()) + " of " + std::to_string(maxActuators) +
               (labels.size() == 1 ? " actuators has no output: " : " actuators have no output: ") +
               nameList(labels);
    return model.output().isPlaying()
               ? std::string{}
               : "expected a device that runs, found none: " +
                     (model.output().device().empty() ? "no device is open" : model.output().device());
}

StudyScreen::StudyScreen(MixerModel& model, std::unique_ptr<StudyInProgress> study, Translation translation,
                         bool hasAnswerWindow, std::vector<MaterialPicture> pictures)
    : FullScreen{model, "Study"}
    , study_{std::move(study)}
    , translate_{std::move(translation)}
    , pictures_{std::move(pictures)}
    , player_{model}
    , worldPane_{model}
    , squareGSecondsBefore_{squareGSecondsOf(study_->exposureToday()) - model.exposure().squareGSeconds()}
    , answers_{translate_}
    , markers_{study_->protocol().name}
    , initialMessage_{model.messageText()} {
    next_.setPrimary(true);
    next_.onClick = [this] { continueStudy(); };
    pause_.onClick = [this] { pause(); };
    leave_ = makeLinkButton(translate_("Leave"), "Leave the study; what was answered is kept",
                            [this] { leave(); });
    comment_.setTitle("Comment");
    comment_.setMultiLine(true);
    comment_.setReturnKeyStartsNewLine(true);
    comment_.setEscapeAndReturnKeysConsumed(false);
    worldPane_.show(pictures_);
    worldPane_.onError = [this](const std::string& error) { model_.report(utf8(error)); };
    answers_.onConfirm = [this] { confirm(); };
    answers_.onKey = [this](const juce::KeyPress& key) { return keyPressed(key); };
    answers_.setSeparateWindow(hasAnswerWindow);
    addAll(*this, {&next_, &silenceButton_, leave_.get()});
    addHidden(*this, {&worldPane_, &pause_, &comment_});
    if (!hasAnswerWindow) addChildComponent(answers_);
    prepareControls(*this);
    showNext();
}

void StudyScreen::showNext() {
    const bool asksComment = page_ == Page::trial && !study_->protocol().closingQuestion.empty();
    if (experiment().isDone())
        return logEvent(studyEvents::end), showPage(asksComment ? Page::comment : Page::done);
    if (isExposureLimitReached()) return showPage(Page::exposureLimit);
    const Trial& trial = experiment().trial();
    const bool isFirstSeen = !answers_;
    if (!isFirstSeen && trial.number > 1 && trial.breakSeconds <= 0.0) return showTrial();
    breakEndMs_ = nowMs() + 1e3 * study_->remainingBreakSeconds();
    if (trial.breakSeconds > 0.0 && !study_->hasBreakBegun()) logEvent(studyEvents::breakStart);
    showPage(Page::ready);
}

void StudyScreen::showPage(Page page) {
    page_ = page;
    answers_.show(nullptr);
    partButtons_.clear();
    progress_.reset();
    physvib::setVisible({&worldPane_, &pause_}, false);
    answers_.setVisible(answers_.isSeparateWindow());
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
    auto layout =
        resolveLayout(resolveProtocolPath(study_->protocol().folder, experiment().condition().layout));
    if (!layout) return showError(layout.error);
    if (answers_.isSeparateWindow() && !answerWindow_) answerWindow_ = makeAnswerWindow(answers_, *this);
    layout_ = std::move(layout.value);
    page_ = Page::trial;
    progress_.emplace(experiment().session(), experiment().trial());
    exploredAnswer_.reset();
    queuedPart_.reset();
    savedSessions_.clear();
    const bool isQuestionnaire = experiment().session().isQuestionnaire; // such a session has no stimuli
    playedLevels_.assign(isQuestionnaire ? 0 : std::max<std::size_t>(1, experiment().trial().parts.size()),
                         {});
    wrongLevelPlays_.assign(playedLevels_.size(), 0);
    isPlayIncomplete_ = false;
    acceptedSeconds_.reset();
    part_ = 0;
    countedSeconds_ = 0.0;
    firstPlayMs_ = isQuestionnaire ? nowMs() : 0.0;
    auto answer = makeStudyAnswer(experiment(), layout_, translate_);
    answer->onAnswer = [this] { handleResponse(); };
    answer->onChange = [this] { refresh(); };
    if (isExploring()) answer->markPlayed(experiment().explored());
    answers_.show(std::move(answer));
    if (const WorldSet* const set = worldSet()) { // previews the first button's world
        worldPane_.setWorldScale(set->displayScale);
        const auto jobs = trialJobs(study_->protocol(), {experiment().trial(), answers_->answer()});
        const auto world = makePlayableWorld(std::get<ResolvedCall>(jobs.front()), study_->protocol().folder);
        if (world)
            worldPane_.preview(set->isInteractive ? sceneForUserInput(world.value.setup.scene)
                                                  : world.value.setup.scene);
    }
    answers_.setVisible(true);
    next_.setVisible(false);
    worldPane_.setVisible(worldSet() != nullptr);
    pause_.setVisible(isInteractive());
    showParts();
    prepareControls(*this);
    setHasFocusOutline(false); // a frame around the whole screen would not show where the focus is
    answers_.setHasFocusOutline(false);
    resized();
    refresh();
    repaint();
    if (isShowing()) grabKeyboardFocus();
}

void StudyScreen::showParts() {
    partButtons_.clear();
    if (isExploring() || experiment().session().isQuestionnaire) return;
    const auto count = std::max<std::size_t>(1, experiment().trial().parts.size());
    for (std::size_t i = 0; i < count; ++i) {
        auto& button = partButtons_.emplace_back(std::make_unique<BigButton>(
            "Feel it",
            count == 1 ? juce::String{"Feel it"} : "Feel number " + juce::String{static_cast<int>(i) + 1}));
        button->onClick = [this, i] { play(i); };
        addAndMakeVisible(*button);
    }
}

void StudyScreen::showError(const std::string& reason) {
    error_ = reason;
    player_.stop();
    worldPane_.world().stop();
    showPage(Page::error);
}

void StudyScreen::requestClose() {
    if (page_ == Page::comment) return submitComment();
    if (page_ != Page::ready && page_ != Page::trial) return leave();
    logEvent(studyEvents::pause);
    player_.stop();
    worldPane_.world().stop();
    showPage(Page::paused);
}

void StudyScreen::leave() {
    if (isStimulusPlaying() && !isInteractive()) return;
    if (!experiment().isDone()) logEvent(studyEvents::leave);
    close();
}

void StudyScreen::continueStudy() {
    switch (page_) {
    case Page::ready:
        if (remainingBreakSeconds() > 0.0) return;
        if (study_->isOnBreak()) logEvent(studyEvents::goOn);
        wasRight_.reset(), hasTimedOut_ = false; // the page has shown this feedback
        return showTrial();
    case Page::paused: return logEvent(studyEvents::goOn), showNext();
    case Page::trial: return;
    case Page::comment: return submitComment();
    case Page::done:
    case Page::exposureLimit:
    case Page::error: return leave();
    }
}

void StudyScreen::submitComment() {
    if (const auto comment = comment_.getText().trim(); comment.isNotEmpty())
        if (const auto error = study_->saveComment(comment.toStdString()); !error.empty())
            return showError(error);
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
    else if (page_ == Page::trial && worldPane_.handleKey(key)) {
    } else if (page_ == Page::trial && isInteractive() && digit >= 0 &&
               digit < static_cast<int>(partButtons_.size()))
        play(static_cast<std::size_t>(digit));
    else if (page_ == Page::trial && isAnswerShown() && answers_->handleKey(key)) {
    } else if (page_ == Page::trial && key.isKeyCode(KeyPress::spaceKey) && pause_.isShowing() &&
               pause_.isEnabled())
        pause();
    else if (page_ == Page::trial && key.isKeyCode(KeyPress::spaceKey) && !partButtons_.empty())
        play(nextPart());
    else if (key.isKeyCode(KeyPress::returnKey) && page_ == Page::trial)
        answers_.confirm();
    else if (key.isKeyCode(KeyPress::returnKey) && next_.isVisible() && next_.isEnabled())
        continueStudy();
    return true; // no key reaches the mixer below
}

/// Counts the time since answers are accepted, without silences; true when the time limit is reached.
bool StudyScreen::updateTimeLimit() {
    const double elapsedSeconds = 1e-3 * (nowMs() - std::exchange(lastUpdateMs_, nowMs()));
    if (!progress_->canAnswer())
        acceptedSeconds_.reset(); // a part must be felt again
    else if (acceptedSeconds_ && !model_.isSilent() && !isDeviceStopped())
        *acceptedSeconds_ += elapsedSeconds;
    else if (!acceptedSeconds_ && canAnswer())
        acceptedSeconds_ = 0.0;
    const double maxSeconds = experiment().session().answerSeconds;
    return maxSeconds > 0.0 && acceptedSeconds_ && *acceptedSeconds_ >= maxSeconds && !isStimulusPlaying();
}

/// An interactive world has the whole screen until the participant leaves it to answer.
bool StudyScreen::isAnswerShown() const {
    return answers_.isSeparateWindow() || !isInteractive() || canAnswer();
}

/// The part after the last played one; before the first play, the first part.
std::size_t StudyScreen::nextPart() const {
    if (experiment().session().intervalSeconds > 0.0 && !isInteractive()) return 0; // starts the sequence
    return progress_->plays() == 0 ? 0 : (part_ + 1) % partButtons_.size();
}

void StudyScreen::play(std::size_t part) {
    if (page_ != Page::trial || model_.isSilent() || isDeviceStopped() || !progress_->canPlay(part)) return;
    if (isStimulusPlaying()) {
        if (!isInteractive() || (part == part_ && worldPane_.world().isMoving())) return;
        queuedPart_ = part;
        return worldPane_.world().stop();
    }
    if (const auto error = startPart(part); !error.empty())
        return isDeviceStopped() ? refresh() : showError(error);
    isPlayIncomplete_ = false;
    if (progress_->plays() == 0) firstPlayMs_ = nowMs();
    progress_->addPlay(part);
    part_ = part;
    countedSeconds_ = 0.0;
    isStartMarkerPending_ = true;
    sendStartMarker();
    if (isInteractive()) resized();
    refresh();
}

std::string StudyScreen::startPart(std::size_t part) {
    const TrialRecord record{experiment().trial(), exploredAnswer_.value_or(answers_->answer())};
    const auto job = trialJobs(study_->protocol(), record)[part];
    if (worldSet() == nullptr) {
        const auto stimulus = StimulusPlayer::prepare(model_, job, study_->protocol().folder);
        return stimulus ? player_.play(stimulus.value) : stimulus.error;
    }
    auto world = makePlayableWorld(std::get<ResolvedCall>(job), study_->protocol().folder);
    if (!world) return world.error;
    const auto number = std::to_string(experiment().answeredTrials() + 1);
    const auto name = "trial-" + std::string(number.size() < 4 ? 4 - number.size() : 0, '0') + number + "-" +
                      std::to_string(savedSessions_.size() + 1) + ".json";
    const auto folder = study_->worldSessionsFolder();
    auto error = worldPane_.begin(std::move(world.value), worldSet()->isInteractive, folder / name);
    if (error.empty()) savedSessions_.push_back((folder.filename() / name).string());
    return error;
}

/// Decides by the receipts whether the play that is over counts.
void StudyScreen::countPlay(PlaybackStatus status) {
    model_.exposure().update();
    // stored now, because a restart of the device clears the receipts
    playedLevels_[part_] = worldSet() != nullptr ? worldPane_.world().level() : player_.level();
    int& wrongPlays = wrongLevelPlays_[part_];
    wrongPlays = status == PlaybackStatus::complete     ? 0
                 : status == PlaybackStatus::wrongLevel ? wrongPlays + 1
                                                        : wrongPlays;
    if (status == PlaybackStatus::complete ||
        (status == PlaybackStatus::wrongLevel && wrongPlays >= maxWrongLevelPlays))
        return;
    markers_.push(markerText("lost"));
    isPlayIncomplete_ = true;
    exploredAnswer_.reset();
    if (worldSet() != nullptr) savedSessions_.pop_back(); // its repetition gets the same name
    const bool isSequence = experiment().session().intervalSeconds > 0.0 && !isInteractive();
    for (std::size_t part = isSequence ? 0 : part_; part <= part_; ++part) progress_->revokePlay(part);
    countedSeconds_ = playedSeconds();
}

/// Plays the parts after the first, each one interval of the session after the end of the previous one.
void StudyScreen::playSequence() {
    const double intervalSeconds = experiment().session().intervalSeconds;
    const std::size_t next = part_ + 1;
    if (intervalSeconds > 0.0 && !isPlayIncomplete_ && !isStimulusPlaying() && !isInteractive() &&
        next < partButtons_.size() && progress_->plays(next) < progress_->plays(part_) &&
        nowMs() >= partEndMs_ + 1e3 * intervalSeconds)
        play(next);
}

void StudyScreen::pause() {
    if (!isInteractive() || !progress_->canAnswer()) return;
    queuedPart_.reset();
    worldPane_.world().stop();
    refresh();
}

/// An exploration plays the choice at once; other answers wait for confirmation.
void StudyScreen::handleResponse() {
    if (page_ != Page::trial) return;
    if (!isExploring()) return refresh(), answers_.focusConfirm(); // the button may have become enabled
    if (isStimulusPlaying()) return;
    exploredAnswer_ = answers_->answer();
    play(0);
}

void StudyScreen::confirm() {
    if (page_ != Page::trial) return;
    if (isExploring()) {
        if (!experiment().mayEnd() || isStimulusPlaying()) return;
        study_->endSession();
        return showNext();
    }
    if (answers_->isComplete() && canAnswer()) submit(answers_->answer());
}

/// Marker text of the current trial: "felt;condition=PHONE;session=main;trial=3;stimulus=2,2;part=1".
std::string StudyScreen::markerText(const char* event) const {
    const Trial& trial = experiment().trial();
    return std::string{event} + ";condition=" + experiment().condition().name +
           ";session=" + experiment().session().name + ";trial=" + std::to_string(trial.number) +
           ";stimulus=" + trial.stimulus;
}

// The start time of a stimulus is known when it is sent, that of a world once it plays.
void StudyScreen::sendStartMarker() {
    if (!isStartMarkerPending_ || (worldSet() != nullptr && worldPane_.world().playedSeconds() <= 0.0))
        return;
    isStartMarkerPending_ = false;
    const double startSeconds =
        worldSet() != nullptr ? -worldPane_.world().playedSeconds() : player_.secondsToStart();
    markers_.push(
        markerText("felt") + ";part=" +
            (experiment().trial().parts.empty() ? std::string{"1"} : experiment().trial().parts[part_]),
        startSeconds);
}

double StudyScreen::exposure() const {
    return dailyExposure(std::max(0.0, squareGSecondsBefore_ + model_.exposure().squareGSeconds()));
}

void StudyScreen::submit(Answer answer) {
    model_.exposure().update();
    answer.playedLevels = playedLevels_;
    answer.apparatus = currentApparatus(model_);
    answer.limiterDb = std::exchange(maxReductionDb_, 0.0);
    answer.exposure = exposure();
    answer.plays = std::max(1, progress_->plays());
    if (!model_.device().hasNoDevice() && !playedLevels_.empty())
        answer.wasDelivered =
            std::ranges::all_of(wrongLevelPlays_, [](int plays) { return plays < maxWrongLevelPlays; });
    answer.revokedPlays = progress_->revokedPlays();
    answer.seconds = std::round(nowMs() - firstPlayMs_) * 1e-3;
    answer.worldSessions = savedSessions_;
    const auto session = experiment().sessionNumber();
    hasTimedOut_ = answer.timedOut;
    markers_.push(markerText(hasTimedOut_ ? "ran-out" : "answer") + ";response=" + answer.response);
    const auto isRight = isCorrect(study_->protocol(), {experiment().trial(), answer});
    wasRight_ = experiment().session().givesFeedback ? isRight : std::nullopt;
    if (!study_->acceptAnswer(std::move(answer))) return showError(study_->error());
    const bool staysOpen = !experiment().isDone() && isExploring() &&
                           experiment().sessionNumber() == session &&
                           experiment().trial().breakSeconds <= 0.0 && !isExposureLimitReached();
    if (!staysOpen) return showNext();
    exploredAnswer_.reset(); // stays on this page, and marks what was played
    progress_.emplace(experiment().session(), experiment().trial());
    wrongLevelPlays_.assign(1, 0);
    answers_->markPlayed(experiment().explored());
    refresh();
    answers_->repaint();
}

void StudyScreen::updateTrial() {
    if (progress_->plays() > 0) { // adds the time played since the last update
        const double seconds = playedSeconds();
        progress_->addSeconds(part_, seconds - countedSeconds_);
        countedSeconds_ = seconds;
    }
    const bool wasPlaying = isStimulusPlaying();
    if (wasPlaying)
        maxReductionDb_ = std::max(
            maxReductionDb_,
            -toDecibels(std::max(1e-6, static_cast<double>(model_.session().status().render.limiterGain))));
    worldPane_.refresh();
    player_.update();
    sendStartMarker();
    if (wasPlaying && !isStimulusPlaying()) countPlay(status()), partEndMs_ = nowMs(), resized();
    if (!worldPane_.world().saveError().empty()) return showError(worldPane_.world().saveError());
    if (queuedPart_ && !isStimulusPlaying()) play(*std::exchange(queuedPart_, {}));
    playSequence();
    if (exploredAnswer_ && !isStimulusPlaying() && progress_->plays() > 0) return submit(*exploredAnswer_);
    if (Answer unanswered; updateTimeLimit()) return unanswered.timedOut = true, submit(unanswered);
    // an answer may be given while the last part plays, and is confirmed after it
    const bool isOpen =
        !model_.isSilent() &&
        (isStimulusPlaying() ? progress_->canAnswer() && !isExploring()
                             : progress_->canAnswer() || answers_->canAnswerEarly() || isExploring());
    answers_.setVisible(isAnswerShown());
    if (isOpen != answers_->isEnabled()) answers_->setEnabled(isOpen);
    if (isOpen && (answers_.isSeparateWindow() ? answers_.hasKeyboardFocus(false) : hasKeyboardFocus(false)))
        answers_->focusLast();
    const bool mayConfirm =
        isExploring() ? experiment().mayEnd() && !isStimulusPlaying() : canAnswer() && answers_->isComplete();
    answers_.setConfirm(true, mayConfirm, translate_(worldSet() != nullptr ? "OK" : "Next"));
    answers_.setQuestion(titleText());
    updateParts();
    pause_.setEnabled(isInteractive() && worldPane_.world().isMoving() && progress_->canAnswer());
    pause_.setText(
        translate_("PAUSE"),
        translate_(pause_.isEnabled() ? "space bar: answer" : "when each was felt for long enough"));
}

void StudyScreen::refresh() {
    const bool hasFocus = hasKeyboardFocus(true) || (answerWindow_ && answerWindow_->hasKeyboardFocus(true));
    if (isShowing() && !hasFocus) grabKeyboardFocus(); // the answer component may take the focus afterwards
    updateSilenceButton(translate_("SILENT: press to feel"), translate_("SILENCE  Esc"));
    leave_->setEnabled(!isStimulusPlaying() || isInteractive());
    if (page_ == Page::trial) updateTrial();
    if (page_ == Page::ready) {
        next_.setEnabled(remainingBreakSeconds() <= 0.0);
        next_.setText(translate_(experiment().trial().number == 1 ? "Begin" : "Go on"), translate_("Enter"));
    }
    if (page_ == Page::paused)
        next_.setEnabled(true), next_.setText(translate_("Go on"), translate_("Enter"));
    if (page_ == Page::comment) next_.setEnabled(true), next_.setText(translate_("Next"));
    if (page_ == Page::done || page_ == Page::exposureLimit || page_ == Page::error)
        next_.setEnabled(true), next_.setText(translate_("Close"), translate_("Enter"));
    if (page_ != Page::trial)
        answers_.setConfirm(false, false, {}), answers_.setQuestion(translate_("Look at the other screen."));
    if (auto newText = titleText() + "\n" + bodyText() + "\n" + progressText(); newText != displayedText_) {
        displayedText_ = newText;
        setDescription(newText);
        repaint();
    }
}

void StudyScreen::updateParts() {
    const SessionPlan& session = experiment().session();
    const Trial& trial = experiment().trial();
    for (std::size_t i = 0; i < partButtons_.size(); ++i) {
        auto& button = *partButtons_[i];
        const bool isPlaying = isStimulusPlaying() && part_ == i, wasFelt = progress_->plays(i) > 0;
        juce::String label = partButtons_.size() == 1 ? translate_(wasFelt ? "Feel it again" : "Feel it")
                                                      : juce::String{static_cast<int>(i) + 1};
        const std::size_t referenceCount = session.reference.empty() ? 0 : 1;
        if (session.ratesSideBySide())
            label = i < referenceCount ? translate_("Reference") : partLetter(i - referenceCount);
        else if (!session.objects.empty() && worldSet() == nullptr)
            label += "   " + translate_(trial.parts[i]);
        const bool isMatched = session.adjustment && session.adjustment->alternative == trial.parts[i];
        if (isMatched) label += "   " + translate_("to be matched");
        button.setMarked(isMatched);
        if (i == 0 && !session.modulus.empty()) label += "   = " + utf8(numberText(session.modulusNumber));
        juce::StringArray remarks;
        if (isPlaying)
            remarks.add(translate_("feel it now"));
        else if (isInteractive())
            remarks.add(translate_("key {n}", {{"n", juce::String{static_cast<int>(i) + 1}}}));
        else if (i == nextPart())
            remarks.add(translate_("space bar"));
        if (session.maxPlays > 0)
            remarks.add(
                translate_("{n} of {most} left", {{"n", juce::String{session.maxPlays - progress_->plays(i)}},
                                                  {"most", juce::String{session.maxPlays}}}));
        else if (wasFelt && !isPlaying)
            remarks.add(progress_->plays(i) == 1
                            ? translate_("felt once")
                            : translate_("felt {n} times", {{"n", juce::String{progress_->plays(i)}}}));
        button.setText(label, remarks.joinIntoString(",  "));
        button.setToggleState(isPlaying, juce::dontSendNotification);
        const bool isInSequence = session.intervalSeconds > 0.0 && !isInteractive() &&
                                  (i > 0 || progress_->plays(0) > progress_->plays(partButtons_.size() - 1));
        button.setEnabled((!isStimulusPlaying() || isInteractive()) && !model_.isSilent() &&
                          !isDeviceStopped() && progress_->canPlay(i) && !isInSequence);
        if (session.minSeconds > 0.0) button.setProgress(progress_->seconds(i) / session.minSeconds);
    }
}

juce::String StudyScreen::titleText() const {
    switch (page_) {
    case Page::trial: return translate_.question(experiment().session(), experiment().condition());
    case Page::comment: return translate_(study_->protocol().closingQuestion);
    case Page::done: return feedbackText() + translate_("Thank you. That was everything.");
    case Page::exposureLimit: return translate_("That is enough vibration for today: the study pauses.");
    case Page::error: return translate_("The study cannot go on.");
    case Page::paused: return translate_("The study is paused.");
    case Page::ready: break;
    }
    const Trial& trial = experiment().trial();
    if (remainingBreakSeconds() > 0.0)
        return feedbackText() + translate_("A break: rest your hands.") + "  " +
               minutesText(remainingBreakSeconds());
    if (trial.number > 1) return feedbackText() + translate_("Ready to go on?");
    return feedbackText() + translate_(experiment().session().isTraining ? "Training" : "The study");
}

/// Feedback on the previous answer.
juce::String StudyScreen::feedbackText() const {
    if (hasTimedOut_) return translate_("Time was over.") + "  ";
    return wasRight_ ? translate_(*wasRight_ ? "That was right." : "That was wrong.") + "  " : juce::String{};
}

// The error because of which nothing is played. Infos, and the message from before the study, are left out.
juce::String StudyScreen::problemText() const {
    return model_.isInfo() || model_.messageText() == initialMessage_ ? model_.device().error()
                                                                      : model_.messageText();
}

juce::String StudyScreen::bodyText() const {
    switch (page_) {
    case Page::trial:
        if (model_.isSilent()) return translate_("Everything is silent. Press the button to feel again.");
        if (isDeviceStopped()) return translate_("Nothing can be felt now: the study waits for the device.");
        if (isPlayIncomplete_) return translate_("That did not come through whole. Please feel it again.");
        if (feedbackText().isNotEmpty() && plays() == 0 && problemText().isEmpty())
            return feedbackText().trimEnd();
        return problemText().isNotEmpty()
                   ? problemText()
                   : translate_.instruction(experiment().session(), experiment().condition())
                         .replace("\n", " ");
    case Page::comment: return translate_("In your own words, if you like.");
    case Page::done: return translate_("Your answers are in") + "\n" + utf8(study_->path().string());
    case Page::exposureLimit:
        return translate_(
                   "Your hands have taken A(8) = {n} m/s^2 (ISO 5349-1); this study's limit is {most} m/s^2.",
                   {{"n", number(exposure(), 2)}, {"most", number(study_->protocol().exposureLimit, 2)}}) +
               "\n" + translate_("What you answered is kept, and the study goes on there another day.");
    case Page::error:
        return utf8(error_) + "\n" +
               translate_("What was answered so far is kept, and the study goes on there.");
    case Page::paused:
        return translate_(
            "What you answered is kept. Close the window again to leave; the study goes on here.");
    case Page::ready: return translate_.instruction(experiment().session(), experiment().condition());
    }
    return {};
}

juce::String StudyScreen::progressText() const {
    if (experiment().isDone())
        return translate_("{n} trials", {{"n", juce::String{experiment().answeredTrials()}}});
    const auto& session = experiment().session();
    const int sessions =
        static_cast<int>(study_->protocol().conditions.size() * study_->protocol().sessions.size());
    juce::StringArray parts{translate_(session.isTraining ? "Training" : "The study")};
    if (sessions > 1)
        parts.add(translate_("part {n} of {most}", {{"n", juce::String{experiment().sessionNumber()}},
                                                    {"most", juce::String{sessions}}}));
    const juce::String trial{experiment().trial().number};
    if (experiment().sessionTrials() > 0)
        parts.add(translate_("trial {n} of {most}",
                             {{"n", trial}, {"most", juce::String{experiment().sessionTrials()}}}));
    else if (!isExploring())
        parts.add(translate_("trial {n}", {{"n", trial}}));
    return parts.joinIntoString(juce::String::fromUTF8("   \xc2\xb7   "));
}

void StudyScreen::paint(juce::Graphics& g) {
    g.fillAll(shade(*this, Shade::background));
    setInk(g, *this, Shade::muted, text::medium);
    g.drawText(progressText(), progressArea_, juce::Justification::centredLeft, true);
    if (!experiment().isDone() && experiment().sessionTrials() > 0) {
        const auto bar =
            juce::Rectangle<int>{pageInset, studyBarHeight - 2, getWidth() - 2 * pageInset, 4}.toFloat();
        fillRound(g, *this, Shade::line, bar, 2.0f);
        fillRound(g, *this, Shade::accent,
                  bar.withWidth(bar.getWidth() * static_cast<float>(experiment().trial().number - 1) /
                                static_cast<float>(experiment().sessionTrials())),
                  2.0f);
    }
    setInk(g, *this, Shade::text, page_ == Page::trial ? text::large : 30.0f, juce::Font::bold);
    g.drawFittedText(titleText(), questionArea_, juce::Justification::centred, 2, 1.0f);
    const bool isProblem = page_ == Page::trial && (model_.isSilent() || isDeviceStopped() ||
                                                    isPlayIncomplete_ || problemText().isNotEmpty());
    setInk(g, *this, isProblem ? Shade::limit : Shade::muted,
           page_ == Page::trial ? text::medium : text::large);
    g.drawFittedText(bodyText(), bodyArea_, juce::Justification::centred, page_ == Page::trial ? 2 : 5, 1.0f);
    if (page_ == Page::ready) drawMaterials(g);
}

// On the page before a session: the materials that will be seen, with their names.
void StudyScreen::drawMaterials(juce::Graphics& g) const {
    const auto legends = visibleMaterials();
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
        if (const MaterialPicture* const picture = findPicture(pictures_, legend.stimulusWord))
            fillWithPicture(g, shape, place, picture->image, legend.isHollow);
        else
            fillWithMaterial(g, shape, place, legend.look, legend.isHollow);
        g.setColour(shade(*this, Shade::text));
        g.drawFittedText(translate_(std::string{legend.words}), cell, juce::Justification::centred, 1, 1.0f);
    }
}

std::vector<MaterialLegend> StudyScreen::visibleMaterials() const {
    if (experiment().isDone() || !std::holds_alternative<WorldSet>(experiment().condition().stimuli))
        return {};
    std::string names;
    for (const StimulusItem& item : conditionStimuli(experiment().condition())) names += item.label + " ";
    for (const std::string& object : experiment().session().objects) names += object + " ";
    std::vector<MaterialLegend> visible;
    for (const MaterialLegend& legend : materialLegends)
        if (names.find(legend.stimulusWord) != std::string::npos) visible.push_back(legend);
    return visible;
}

void StudyScreen::resized() {
    auto area = getLocalBounds().reduced(pageInset, 0);
    auto header = area.removeFromTop(studyBarHeight - 8);
    silenceButton_.setBounds(header.removeFromRight(silenceButtonWidth).withTrimmedTop(8));
    leave_->setBounds(header.removeFromRight(110).reduced(16, 10));
    progressArea_ = header;
    area.removeFromTop(20);
    if (page_ == Page::trial) return placeTrial(area);
    auto pageArea = area.withSizeKeepingCentre(
        std::min(900, area.getWidth()), std::min(area.getHeight(), page_ == Page::comment ? 520 : 320));
    questionArea_ = pageArea.removeFromTop(60);
    bodyArea_ = pageArea.removeFromTop(page_ == Page::comment ? 44 : 150);
    if (page_ == Page::comment) comment_.setBounds(pageArea.removeFromTop(pageArea.getHeight() - 110));
    next_.setBounds(pageArea.withSizeKeepingCentre(260, 72));
}

void StudyScreen::placeTrial(juce::Rectangle<int> area) {
    questionArea_ = area.removeFromTop(40);
    bodyArea_ = area.removeFromTop(40);
    if (!partButtons_.empty()) {
        auto row = area.removeFromTop(partHeight);
        const int count = static_cast<int>(partButtons_.size()) + (isInteractive() ? 1 : 0),
                  width = std::min(partWidth, row.getWidth() / count);
        row = row.withSizeKeepingCentre(width * count, partHeight);
        for (auto& part : partButtons_) part->setBounds(row.removeFromLeft(width).reduced(8, 4));
        if (isInteractive()) pause_.setBounds(row.reduced(8, 4));
        area.removeFromTop(16);
    }
    if (!answers_.isSeparateWindow())
        answers_.setBounds(worldSet() != nullptr && !isInteractive() ? area.removeFromBottom(choiceHeight)
                                                                     : area);
    worldPane_.setBounds(area.withTrimmedBottom(12));
    worldPane_.setVisible(worldSet() != nullptr &&
                          (!isInteractive() || answers_.isSeparateWindow() || !isAnswerShown()));
}

} // namespace physvib
