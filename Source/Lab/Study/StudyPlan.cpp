// SPDX-License-Identifier: MIT
// Computes trials, levels and times of a study from the protocol alone.
#include "Lab/Study/StudyPlan.h"
#include "Lab/Study/StudyOrder.h"
#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <utility>

namespace physvib {
namespace {

/// Maximum level of an alternative in a session, summed as Experiment does. An adjusted alternative is played
/// at the adjusted level.
double highestOf(const Protocol& protocol, const SessionPlan& session, const Alternative& alternative) {
    const auto moves = [&](const auto& plan) { return plan && plan->alternative == alternative.name; };
    if (moves(session.adjustment)) return session.adjustment->mostDb;
    const auto from = std::ranges::find(protocol.sessions, session.levelsFrom, &SessionPlan::name);
    double added = 0.0;
    if (!session.levelsFrom.empty() && from != protocol.sessions.end() && moves(from->adjustment))
        added = from->adjustment->mostDb;
    else if (moves(session.staircase))
        added = session.staircase->mostDb;
    else if (moves(session.quest))
        added = session.quest->mostDb;
    else if (!session.levelsFile.empty())
        for (const StimulusLevel& level : protocol.levels)
            if (level.alternative == alternative.name) added = std::max(added, level.levelDb);
    return alternative.levelDb + added;
}

/// Parts of a session's trials, each with its maximum level; one part without a name if trials have none.
std::map<std::string, double> partsOf(const Protocol& protocol, const SessionPlan& session) {
    std::map<std::string, double> parts;
    for (const Alternative& alternative : session.alternatives)
        parts[alternative.name] = highestOf(protocol, session, alternative);
    for (const std::string& object : session.objects) parts[object] = 0.0;
    if (parts.empty()) parts[{}] = 0.0;
    return parts;
}

int trialsOf(const SessionPlan& session, std::size_t stimuli) {
    const auto count = static_cast<int>(stimuli);
    if (session.answer() == AnswerKind::wish)
        return session.fewestTouches > 0 ? session.fewestTouches : count;
    if (session.quest) return session.quest->trials * count;
    if (session.staircase) return session.staircase->mostTrials * count;
    return count * session.repetitions * (session.bothOrders ? 2 : 1);
}

/// One session in one condition.
struct PlannedSession {
    std::size_t session = 0, condition = 0;
    int trials = 0;
    std::vector<PlannedTrials> felt; ///< every part of every stimulus, with its number of plays
};

/// In protocol order, as for one participant.
std::vector<PlannedSession> plannedSessions(const Protocol& protocol) {
    std::vector<PlannedSession> all;
    for (std::size_t c = 0; c < protocol.conditions.size(); ++c) {
        const auto items = stimuliOf(protocol.conditions[c]);
        for (std::size_t s = 0; s < protocol.sessions.size(); ++s) {
            PlannedSession& planned =
                all.emplace_back(PlannedSession{s, c, trialsOf(protocol.sessions[s], items.size()), {}});
            const double each = static_cast<double>(planned.trials) / static_cast<double>(items.size());
            for (const StimulusItem& item : items)
                for (const auto& [part, db] : partsOf(protocol, protocol.sessions[s]))
                    planned.felt.push_back({c, item.label, part, each});
        }
    }
    return all;
}

} // namespace

TrialJob PlannedStimulus::job(const Protocol& protocol) const {
    TrialRecord record;
    record.trial.condition = condition;
    record.trial.session = session;
    record.trial.stimulus = label;
    if (!part.empty()) {
        record.trial.parts = {part};
        record.trial.partLevelsDb = {highestDb};
        record.answer.value = highestDb; // an adjustment plays its answered level
    }
    return jobsOf(protocol, record).front();
}

std::vector<PlannedStimulus> plannedStimuli(const Protocol& protocol) {
    // maximum level, and the session that sets it
    std::map<std::string, std::pair<double, std::size_t>> parts;
    for (std::size_t s = 0; s < protocol.sessions.size(); ++s)
        for (const auto& [name, db] : partsOf(protocol, protocol.sessions[s]))
            if (const auto [at, isNew] = parts.try_emplace(name, db, s); !isNew && db > at->second.first)
                at->second = {db, s};
    // sessions without alternatives play the same stimuli
    if (parts.size() > 1) parts.erase(std::string{});
    std::vector<PlannedStimulus> planned;
    for (std::size_t c = 0; c < protocol.conditions.size(); ++c)
        for (const StimulusItem& item : stimuliOf(protocol.conditions[c]))
            for (const auto& [name, of] : parts)
                planned.push_back({c, of.second, item.label, name, of.first});
    return planned;
}

std::vector<PlannedTrials> plannedTrials(const Protocol& protocol) {
    std::vector<PlannedTrials> all;
    for (PlannedSession& session : plannedSessions(protocol))
        std::ranges::move(session.felt, std::back_inserter(all));
    return all;
}

PlannedTime
plannedTime(const Protocol& protocol,
            const std::function<double(std::size_t, const std::string&, const std::string&)>& secondsOf) {
    PlannedTime time;
    double stretch = 0.0;
    std::size_t condition = 0;
    const auto work = [&](double seconds) {
        time.seconds += seconds,
            time.longestStretchSeconds = std::max(time.longestStretchSeconds, stretch += seconds);
    };
    const auto rest = [&](double seconds) {
        if (seconds > 0.0) time.seconds += seconds, stretch = 0.0;
    };
    for (const PlannedSession& planned : plannedSessions(protocol)) {
        const SessionPlan& session = protocol.sessions[planned.session];
        if (std::exchange(condition, planned.condition) != planned.condition)
            rest(protocol.conditionBreakSeconds);
        rest(session.breakBeforeSeconds);
        double felt = 0.0; // sum over all trials of the session
        for (const PlannedTrials& one : planned.felt)
            felt += one.count * std::max(session.leastSeconds, secondsOf(one.condition, one.label, one.part));
        for (int t = 0; t < planned.trials; ++t) {
            if (session.breakEvery > 0 && t > 0 && t % session.breakEvery == 0) rest(session.breakSeconds);
            work(felt / planned.trials +
                 (session.answer() == AnswerKind::wish ? 0.0 : PlannedTime::answerSeconds));
        }
        time.trials += planned.trials;
    }
    return time;
}

OrderBalance orderBalance(const Protocol& protocol, int participants) {
    const std::size_t count = protocol.conditions.size();
    std::vector<int> atPlace(count * count);
    std::set<std::pair<std::size_t, std::size_t>> successions;
    for (int number = 1; number <= participants; ++number) {
        const auto order = conditionOrder(protocol, number);
        for (std::size_t place = 0; place < count; ++place) {
            ++atPlace[order[place] * count + place];
            if (place > 0) successions.emplace(order[place - 1], order[place]);
        }
    }
    const auto [fewest, most] = std::ranges::minmax(atPlace);
    return {fewest, most, static_cast<int>(successions.size()), static_cast<int>(count * (count - 1))};
}

} // namespace physvib
