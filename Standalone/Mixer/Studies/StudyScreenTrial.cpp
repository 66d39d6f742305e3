// SPDX-License-Identifier: GPL-3.0-or-later
// Course of a trial: plays its parts, and stores the answer.
#include "Core/Units.h"
#include "Mixer/Studies/StudyScreen.h"
#include <algorithm>
#include <cmath>
#include <utility>

namespace physvib {
namespace {

constexpr int mostUnlike = 3; // plays of a part at another level than planned; then its row is marked

} // namespace

bool StudyScreen::isExploring() const { return experiment().session().answer() == AnswerKind::wish; }

bool StudyScreen::canAnswer() const { return progress_->canAnswer() && !isFeeling(); }

/// An interactive world has the whole screen until the participant leaves it to answer.
bool StudyScreen::isAnswerSeen() const { return answers_.standsAlone() || !hasHands() || canAnswer(); }

double StudyScreen::restLeft() const { return std::max(0.0, 1e-3 * (restEndsMs_ - nowMs())); }

/// The part after the last played one; at first, the first.
std::size_t StudyScreen::nextPart() const {
    if (experiment().session().intervalSeconds > 0.0 && !hasHands()) return 0; // starts the sequence
    return progress_->plays() == 0 ? 0 : (part_ + 1) % parts_.size();
}

void StudyScreen::play(std::size_t part) {
    if (page_ != Page::trial || desk_.isSilent() || isWaiting() || !progress_->canPlay(part)) return;
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
        const auto stimulus = StudySound::make(desk_, job, study_->protocol().folder);
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
    noteFelt();
    int& unlike = unlike_[part_];
    unlike = course == Course::left ? 0 : course == Course::unlike ? unlike + 1 : unlike;
    if (course == Course::left || (course == Course::unlike && unlike >= mostUnlike)) return;
    markers_.push(markerWords("lost"));
    isLost_ = true;
    exploring_.reset();
    if (worldSet() != nullptr) sessions_.pop_back(); // the next one takes its name
    const bool isSequence = experiment().session().intervalSeconds > 0.0 && !hasHands();
    for (std::size_t part = isSequence ? 0 : part_; part <= part_; ++part) progress_->lost(part);
    counted_ = feltSeconds();
}

void StudyScreen::playWanted() {
    if (!wanted_ || isFeeling()) return;
    const auto part = *wanted_;
    wanted_.reset();
    play(part);
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
    if (page_ != Page::trial || isFeeling()) return;
    if (!isExploring()) return refresh(), answers_.focusConfirm(); // it may be enabled only now
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
    if (answers_->isComplete() && canAnswer()) take(answers_->answer());
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

/// Stores the felt level of the part that is over: a device that restarts later knows it no more.
void StudyScreen::noteFelt() {
    desk_.exposure().update();
    felt_[part_] =
        worldSet() != nullptr ? desk_.exposure().felt(pane_.world().measuredSeconds()) : sound_.felt();
}

/// The participant's A(8) from this study's trials of today.
double StudyScreen::exposure() const {
    return dailyExposure(std::max(0.0, squaresBefore_ + desk_.exposure().squareGSeconds()));
}

void StudyScreen::take(Answer answer) {
    desk_.exposure().update();
    answer.felt = felt_;
    answer.apparatus = apparatusOf(desk_);
    answer.limiterDb = std::exchange(limiterDb_, 0.0);
    answer.exposure = exposure();
    answer.plays = std::max(1, progress_->plays());
    if (!hasNoDevice(desk_))
        answer.left = std::ranges::all_of(unlike_, [](int plays) { return plays < mostUnlike; });
    answer.again = progress_->again();
    answer.seconds = std::round(nowMs() - firstFeltMs_) * 1e-3;
    answer.sessions = sessions_;
    const auto session = experiment().sessionNumber();
    markers_.push(markerWords("answer") + ";response=" + answer.response);
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
            -toDecibels(std::max(1e-6, static_cast<double>(desk_.session().status().render.limiterGain))));
    pane_.refresh();
    sound_.update();
    markFelt();
    if (wasFeeling && !isFeeling()) settle(course()), endedMs_ = nowMs(), resized();
    if (!pane_.world().fault().empty()) return fail(pane_.world().fault());
    playWanted();
    playSequence();
    if (exploring_ && !isFeeling() && progress_->plays() > 0) return take(*exploring_);
    const bool isOpen =
        !isFeeling() && !desk_.isSilent() && (progress_->canAnswer() || answers_->isOpen() || isExploring());
    answers_.setVisible(isAnswerSeen());
    if (isOpen != answers_->isEnabled()) answers_->setEnabled(isOpen);
    if (isOpen && (answers_.standsAlone() ? answers_.hasKeyboardFocus(false) : hasKeyboardFocus(false)))
        answers_->begin();
    const bool mayConfirm =
        isExploring() ? experiment().mayEnd() && !isFeeling() : canAnswer() && answers_->isComplete();
    answers_.setConfirm(true, mayConfirm, say_(worldSet() != nullptr ? "OK" : "Next"));
    answers_.setQuestion(headline());
    updateParts();
    updatePause();
}

void StudyScreen::updatePause() {
    pause_.setEnabled(hasHands() && pane_.world().isMoving() && progress_->canAnswer());
    pause_.setWords(say_("PAUSE"),
                    say_(pause_.isEnabled() ? "space bar: answer" : "when each was felt for long enough"));
}

} // namespace physvib
