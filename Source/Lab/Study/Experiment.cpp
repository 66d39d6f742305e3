// SPDX-License-Identifier: MIT
// Runs conditions, sessions and trials in orders that derive from the seed; creates the jobs of a trial.
#include "Lab/Study/Experiment.h"
#include "Core/Units.h"
#include <cmath>
#include <numeric>

namespace physvib {
namespace {

bool isValidScore(const SessionPlan& s, double score) noexcept {
    return s.points > 0 ? score >= 1.0 && score <= s.points && score == std::floor(score)
                        : score >= 0.0 && score <= 100.0;
}

bool isOnField(const std::optional<FieldPlace>& place) noexcept {
    return place && place->x >= 0.0 && place->x <= 1.0 && place->y >= 0.0 && place->y <= 1.0;
}

} // namespace

TrialProgress::TrialProgress(const SessionPlan& session, const Trial& trial)
    : session_{session}
    , parts_(session.isQuestionnaire ? 0 : std::max<std::size_t>(1, trial.parts.size())) {}

int TrialProgress::plays() const noexcept {
    return std::accumulate(parts_.begin(), parts_.end(), 0,
                           [](int sum, const Part& p) { return sum + p.plays; });
}

Experiment::Experiment(const Protocol& protocol, Participant participant, bool endsOnRequest)
    : protocol_{protocol}
    , participant_{std::move(participant)}
    , endsOnRequest_{endsOnRequest}
    , conditions_{conditionOrder(protocol, participant_.number)} {
    beginSession();
    advance();
}

SeededRandom Experiment::makeRandom(const std::string& purpose) const {
    const std::string& condition = protocol_.conditions[conditionIndex()].name;
    return SeededRandom{static_cast<std::uint64_t>(protocol_.seed), std::to_string(participant_.number) +
                                                                        "/" + condition + "/" + plan().name +
                                                                        "/" + purpose};
}

void Experiment::beginSession() {
    items_ = stimulusItems(plan(), protocol_.conditions[conditionIndex()]);
    answeredInSession_ = consecutiveCorrect_ = 0;
    explored_.clear();
    isExplorationEnded_ = false;
    adaptive_.reset();
    auto random = makeRandom("order");
    order_ = sessionOrder(plan(), items_.size(), random);
    if (plan().adaptedAlternative()) adaptive_.emplace(plan());
}

bool Experiment::isSessionOver() const {
    if (adaptive_) return adaptive_->isDone();
    if (plan().untilCorrect > 0 && consecutiveCorrect_ >= plan().untilCorrect) return true;
    if (plan().answerKind() != AnswerKind::request)
        return answeredInSession_ >= static_cast<int>(order_.size());
    return isExplorationEnded_ || (!endsOnRequest_ && hasExplored());
}

void Experiment::advance() {
    trial_.reset();
    while (isSessionOver()) {
        if (++sessionIndex_ == protocol_.sessions.size()) {
            sessionIndex_ = 0;
            if (++conditionPosition_ == conditions_.size()) return;
        }
        beginSession();
    }
    trial_ = nextTrial();
}

Trial Experiment::nextTrial() {
    const SessionPlan& s = plan();
    Trial trial;
    trial.condition = conditionIndex();
    trial.session = sessionIndex_;
    trial.number = answeredInSession_ + 1;
    trial.task = s.task;
    const bool isNextCondition = conditionPosition_ > 0 && sessionIndex_ == 0;
    if (answeredInSession_ == 0)
        trial.breakSeconds =
            std::max(s.breakBeforeSeconds, isNextCondition ? protocol_.conditionBreakSeconds : 0.0);
    else if (s.breakEvery > 0 && answeredInSession_ % s.breakEvery == 0)
        trial.breakSeconds = s.breakSeconds;
    if (s.answerKind() == AnswerKind::request) return trial;

    auto random = makeRandom("trial " + std::to_string(trial.number));
    const bool isPlanned = !adaptive_;
    const PlannedTrial planned = isPlanned ? order_[static_cast<std::size_t>(answeredInSession_)]
                                           : PlannedTrial{random.below(items_.size()), random.chance(0.5)};
    trial.stimulus = items_[planned.stimulus].label;
    if (adaptive_) trial.staircase = adaptive_->drawStaircase(random);
    if (!s.alternatives.empty()) addAlternatives(trial, planned.isSwapped);
    if (!s.modulus.empty()) trial.parts = {"modulus", "stimulus"};
    if (!s.objects.empty()) {
        trial.parts = s.objects;
        random.shuffle(trial.parts);
        if (!s.reference.empty()) trial.parts.insert(trial.parts.begin(), s.reference);
    }
    if (s.comparesPairs) {
        const std::size_t split = trial.stimulus.find(pairSeparator);
        trial.parts = {trial.stimulus.substr(0, split), trial.stimulus.substr(split + pairSeparator.size())};
        if (planned.isSwapped) std::ranges::reverse(trial.parts);
    }
    return trial;
}

double Experiment::adjustmentStartDb(const Adjustment& a, int trial) const {
    if (!a.hasRandomStart) return a.startDb;
    const auto steps = static_cast<std::size_t>(std::floor((a.maxDb - a.minDb) / a.stepDb + 1e-6));
    return a.minDb +
           a.stepDb * static_cast<double>(makeRandom("start " + std::to_string(trial)).below(steps + 1));
}

void Experiment::addAlternatives(Trial& trial, bool isSwapped) {
    const SessionPlan& s = plan();
    std::vector<Alternative> buttons = s.alternatives;
    if (isSwapped) std::ranges::reverse(buttons);
    if (buttons.size() > 2 && s.answerKind() == AnswerKind::choice)
        makeRandom("buttons " + std::to_string(trial.number)).shuffle(buttons);
    if (adaptive_) trial.levelDb = adaptive_->levelDb();
    if (s.adjustment) trial.levelDb = adjustmentStartDb(*s.adjustment, trial.number);
    const std::string variedName = adaptive_      ? *s.adaptedAlternative()
                                   : s.adjustment ? s.adjustment->alternative
                                                  : std::string{};
    double roveDb = 0.0;
    if (s.roveDb > 0.0) // in steps of 0.1 dB
        roveDb = std::round(10.0 * s.roveDb *
                            (2.0 * makeRandom("rove " + std::to_string(trial.number)).uniform() - 1.0)) /
                 10.0;
    if (hasRovingVariable(protocol_.conditions[trial.condition])) trial.roveDb = std::exchange(roveDb, 0.0);
    for (const Alternative& button : buttons) {
        double db = roveDb + button.levelDb + (button.name == variedName ? trial.levelDb : 0.0);
        if (!s.levelsFrom.empty()) {
            const auto source = std::ranges::find(protocol_.sessions, s.levelsFrom, &SessionPlan::name);
            if (button.name == source->adjustment->alternative) {
                trial.levelDb = adjustedDb(trial.condition, s.levelsFrom, trial.stimulus).value_or(0.0);
                db += trial.levelDb;
            }
        }
        if (const auto* fileLevel =
                s.levelsFile.empty()
                    ? nullptr
                    : findLevel(protocol_.levels, protocol_.conditions[trial.condition].name, trial.stimulus);
            fileLevel && fileLevel->alternative == button.name) {
            trial.levelDb = fileLevel->levelDb;
            db += fileLevel->levelDb;
        }
        trial.parts.push_back(button.name);
        trial.partLevelsDb.push_back(db);
    }
}

std::string Experiment::answerError(const Answer& answer) const {
    const SessionPlan& s = session();
    const auto isLabel = [&] {
        return std::ranges::find(items_, answer.response, &StimulusItem::label) != items_.end();
    };
    if (answer.plays < 1) return "expected that the stimulus was felt";
    if (!(answer.seconds >= 0.0)) return "expected a time from 0 s on";
    if (answer.timedOut) return s.answerSeconds > 0.0 ? "" : "expected an answer, as time does not run out";
    switch (s.answerKind()) {
    case AnswerKind::request:
        if (s.minTouches > 0) return isOnField(answer.place) ? "" : "expected a place on the field";
        return isLabel() ? "" : "expected the label of a stimulus, found " + answer.response;
    case AnswerKind::label:
        return isLabel() ? "" : "expected the label of a stimulus, found " + answer.response;
    case AnswerKind::place: return isOnField(answer.place) ? "" : "expected a place on the field";
    case AnswerKind::choice: {
        const auto& offered = s.answers.empty() ? trial_->parts : s.answers;
        const bool isOffered = std::ranges::find(offered, answer.response) != offered.end();
        return isOffered ? "" : "expected one of the alternatives, found " + answer.response;
    }
    case AnswerKind::scores:
        return answer.scores.size() == s.scores().size() &&
                       std::ranges::all_of(answer.scores,
                                           [&](double score) { return isValidScore(s, score); })
                   ? ""
                   : "expected a score from " + std::string(s.points > 0 ? "1" : "0") + " to " +
                         std::to_string(s.points > 0 ? s.points : 100) + " per scale";
    case AnswerKind::level:
        return answer.value >= s.adjustment->minDb && answer.value <= s.adjustment->maxDb
                   ? ""
                   : "expected a level within the adjustment's range";
    case AnswerKind::number:
        return answer.value >= minEstimate && answer.value <= maxEstimate
                   ? ""
                   : "expected a number from 1e-12 to 1e12";
    case AnswerKind::words:
        if (answer.response.empty()) return s.mayBeEmpty ? "" : "expected words, found none";
        return answer.response.size() <= maxAnswerBytes
                   ? ""
                   : "expected at most " + std::to_string(maxAnswerBytes) + " bytes of words";
    }
    return "expected a task";
}

TrialRecord Experiment::acceptAnswer(Answer answer) {
    TrialRecord record{std::move(*trial_), std::move(answer)};
    if (plan().answerKind() == AnswerKind::request) explored_.insert(record.answer.response);
    const bool wasDelivered = record.answer.wasDelivered.value_or(true),
               movesLevel = wasDelivered && !record.answer.timedOut;
    if (plan().adjustment && movesLevel)
        adjusted_[{record.trial.condition, plan().name}][record.trial.stimulus].push_back(
            record.answer.value);
    if (adaptive_ && movesLevel) adaptive_->answer(record.answer.response == *plan().adaptedAlternative());
    if (wasDelivered)
        consecutiveCorrect_ = isCorrect(protocol_, record).value_or(false) ? consecutiveCorrect_ + 1 : 0;
    ++answeredInSession_;
    ++answeredTrials_;
    advance();
    return record;
}

std::string Experiment::replay(const TrialRecord& record) {
    if (!isDone() && mayEnd() &&
        (record.trial.condition != trial_->condition || record.trial.session != trial_->session))
        endSession();
    if (isDone()) return "expected no more trials";
    const Trial& t = *trial_;
    if (record.trial.condition != t.condition)
        return "expected the condition " + protocol_.conditions[t.condition].name;
    if (record.trial.session != t.session)
        return "expected the session " + protocol_.sessions[t.session].name;
    if (record.trial.number != t.number) return "expected trial " + std::to_string(t.number);
    if (record.trial.stimulus != t.stimulus) return "expected the stimulus " + t.stimulus;
    if (adaptive_ && record.trial.levelDb != t.levelDb)
        return "expected the level " + std::to_string(t.levelDb) + " dB";
    if (auto error = answerError(record.answer); !error.empty()) return error;
    acceptAnswer(record.answer);
    return {};
}

std::optional<double> Experiment::adjustedDb(std::size_t condition, const std::string& session,
                                             const std::string& stimulus) const {
    const auto found = adjusted_.find({condition, session});
    if (found == adjusted_.end()) return std::nullopt;
    const auto values = found->second.find(stimulus);
    if (values == found->second.end()) return std::nullopt;
    return std::accumulate(values->second.begin(), values->second.end(), 0.0) /
           static_cast<double>(values->second.size());
}

// Scores a trial and creates the jobs that reproduce its stimulus.

namespace {

/// Level in g, rounded so that its text is short and exact to a thousandth of a dB.
double scaledLevelG(double levelG, double db) {
    return db == 0.0 ? levelG : std::round(levelG * fromDecibels(db) * 1e6) * 1e-6;
}

struct Part {
    std::string name;
    double levelDb = 0.0;
};

struct JobMaker {
    const Protocol& protocol;
    const ConditionPlan& condition;
    const TrialRecord& record;

    const std::string& label() const {
        return record.trial.stimulus.empty() ? record.answer.response : record.trial.stimulus;
    }
    StimulusJob job(std::variant<PatternJob, PhantomJob> stimulus, double db) const {
        return {std::move(stimulus), condition.layout,
                condition.isAtResonance ? std::nullopt : std::optional{condition.frequencyHz},
                scaledLevelG(condition.levelG, db)};
    }

    TrialJob operator()(const PatternSet& set, const Part& part) const {
        return job(PatternJob{label(), set.gapSeconds}, part.levelDb);
    }
    TrialJob operator()(const GridSet& set, const Part& part) const {
        PhantomJob phantom{GridPlace{set.grid(), parseGridCell(label()).value_or(GridCell{})}, set.law,
                           set.exponent, set.seconds};
        if (record.trial.stimulus.empty() && record.answer.place) phantom.target = *record.answer.place;
        return job(std::move(phantom), part.levelDb);
    }
    TrialJob operator()(const CallSet& set, const Part& part) const {
        const auto items = conditionStimuli(condition);
        const auto item = std::ranges::find(items, label(), &StimulusItem::label);
        return ResolvedCall{
            addSoundOptions(protocol, resolveCall(set, item != items.end() ? *item : StimulusItem{},
                                                  part.name, part.levelDb, record.trial.roveDb))};
    }
};

} // namespace

std::optional<GridCell> targetCell(const ConditionPlan& condition, const Trial& trial) {
    return std::holds_alternative<GridSet>(condition.stimuli) ? parseGridCell(trial.stimulus) : std::nullopt;
}

std::optional<bool> isCorrect(const Protocol& protocol, const TrialRecord& record) {
    const SessionPlan& session = protocol.sessions[record.trial.session];
    if (!session.hasCorrectAnswers() || record.answer.timedOut) return std::nullopt;
    const std::string* const adapted = session.adaptedAlternative();
    return record.answer.response == (adapted != nullptr         ? *adapted
                                      : !session.correct.empty() ? session.correct
                                                                 : record.trial.stimulus);
}

std::vector<TrialJob> trialJobs(const Protocol& protocol, const TrialRecord& record) {
    const ConditionPlan& condition = protocol.conditions[record.trial.condition];
    const SessionPlan& session = protocol.sessions[record.trial.session];
    std::vector<TrialJob> jobs;
    if (session.isQuestionnaire) return jobs;
    const auto add = [&](const TrialRecord& partRecord, const Part& part) {
        jobs.push_back(std::visit(
            [&](const auto& set) {
                return JobMaker{protocol, condition, partRecord}(set, part);
            },
            condition.stimuli));
    };
    const bool hasModulus = !session.modulus.empty() && record.trial.parts.size() == 2;
    if (hasModulus || (session.comparesPairs && !record.trial.parts.empty())) { // the parts are stimuli
        TrialRecord partRecord = record;
        for (std::size_t i = 0; i < record.trial.parts.size(); ++i) {
            partRecord.trial.stimulus = !hasModulus ? record.trial.parts[i]
                                        : i == 0    ? session.modulus
                                                    : record.trial.stimulus;
            add(partRecord, {});
        }
        return jobs;
    }
    for (std::size_t i = 0; i < record.trial.parts.size(); ++i) {
        const std::string& name = record.trial.parts[i];
        // an adjusted alternative is played at the answered level
        const bool isAdjusted = session.adjustment && session.adjustment->alternative == name;
        add(record, {name, isAdjusted                             ? record.answer.value
                           : i < record.trial.partLevelsDb.size() ? record.trial.partLevelsDb[i]
                                                                  : 0.0});
    }
    if (jobs.empty()) add(record, {});
    return jobs;
}

// Computes balanced Latin squares and shuffled orders.

namespace {

/// Indices of the conditions of each group, groups in the order of their first condition. A condition without
/// a group forms its own.
std::vector<std::vector<std::size_t>> groupsOf(const Protocol& protocol) {
    std::vector<std::vector<std::size_t>> groups;
    for (std::size_t i = 0; i < protocol.conditions.size(); ++i) {
        const std::string& name = protocol.conditions[i].group;
        const auto found = std::ranges::find_if(groups, [&](const auto& g) {
            return !name.empty() && protocol.conditions[g.front()].group == name;
        });
        if (found == groups.end())
            groups.push_back({i});
        else
            found->push_back(i);
    }
    return groups;
}

} // namespace

std::vector<std::size_t> latinSquareRow(std::size_t count, std::size_t row) {
    std::vector<std::size_t> order;
    const std::size_t shift = row % std::max<std::size_t>(count, 1);
    for (std::size_t i = 0; i < count; ++i) { // 0, 1, n-1, 2, n-2, ... shifted
        const std::size_t zigzag = i % 2 ? (i + 1) / 2 : (count - i / 2) % count;
        order.push_back((zigzag + shift) % count);
    }
    // with an odd count, the square and its mirror image are balanced together
    if (count % 2 && row / count % 2) std::ranges::reverse(order);
    return order;
}

std::vector<std::size_t> conditionOrder(const Protocol& protocol, int number) {
    const auto groups = groupsOf(protocol);
    const auto row = static_cast<std::size_t>(number - 1);
    std::vector<std::size_t> order;
    if (protocol.conditionOrder == Protocol::ConditionOrder::latinSquare) {
        // Participants with the same order of groups rotate through the orders inside the groups.
        for (const std::size_t g : latinSquareRow(groups.size(), row))
            for (const std::size_t c :
                 latinSquareRow(groups[g].size(), groups.size() > 1 ? row / groups.size() : row))
                order.push_back(groups[g][c]);
        return order;
    }
    order.resize(protocol.conditions.size());
    std::iota(order.begin(), order.end(), 0u);
    SeededRandom random{static_cast<std::uint64_t>(protocol.seed), "conditions of " + std::to_string(number)};
    if (protocol.conditionOrder == Protocol::ConditionOrder::random) random.shuffle(order);
    return order;
}

std::vector<PlannedTrial> sessionOrder(const SessionPlan& session, std::size_t stimuli,
                                       SeededRandom& random) {
    std::vector<PlannedTrial> all;
    for (int repetition = 0; repetition < session.repetitions; ++repetition) {
        std::vector<PlannedTrial> block;
        for (std::size_t s = 0; s < stimuli; ++s) {
            const bool comparesTwo = session.comparesPairs || (session.alternatives.size() == 2 &&
                                                               session.answerKind() == AnswerKind::choice);
            block.push_back({s, !session.bothOrders && comparesTwo && random.chance(0.5)});
            if (session.bothOrders) block.push_back({s, true});
        }
        if (session.order == SessionPlan::Order::blocks) random.shuffle(block);
        all.insert(all.end(), block.begin(), block.end());
    }
    if (session.order == SessionPlan::Order::random) random.shuffle(all);
    return all;
}

} // namespace physvib
