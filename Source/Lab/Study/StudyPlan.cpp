// SPDX-License-Identifier: MIT
// Computes trials, levels and times of a study from the protocol alone.
#include "Lab/Study/StudyPlan.h"
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <utility>

namespace physvib {
namespace {

using Levels = std::set<double>; // in dB

/// One more than mostPlannedLevels from `least` to `most`, evenly spread.
Levels spread(double least, double most) {
    Levels levels{most};
    for (std::size_t i = 0; i < mostPlannedLevels; ++i)
        levels.insert(least + (most - least) * static_cast<double>(i) / mostPlannedLevels);
    return levels;
}

/// `start` and all that `steps` lead to within the range, up and down. Steps that do not divide one another
/// reach ever more: then the range is spread.
Levels reachedFrom(double start, std::vector<double> steps, double least, double most) {
    Levels reached{start};
    for (std::vector<double> next{start}; !next.empty();) {
        if (reached.size() > mostPlannedLevels) return spread(least, most);
        const double level = next.back();
        next.pop_back();
        for (const double step : steps)
            for (const double other : {level - step, level + step})
                if (const double at = std::round(std::clamp(other, least, most) * 1e6) * 1e-6;
                    reached.insert(at).second)
                    next.push_back(at);
    }
    return reached;
}

Levels levelsOf(const Adjustment& a) {
    Levels levels = reachedFrom(a.startDb, {a.stepDb}, a.leastDb, a.mostDb);
    if (a.startsAnywhere) levels.merge(reachedFrom(a.leastDb, {a.stepDb}, a.leastDb, a.mostDb));
    return levels;
}

Levels levelsOf(const StaircasePlan& s) {
    std::vector<double> steps{s.stepDb};
    while (steps.back() > s.leastStepDb) steps.push_back(std::max(s.leastStepDb, 0.5 * steps.back()));
    if (s.upRatio != 1.0)
        for (std::size_t i = steps.size(); i-- > 0;) steps.push_back(s.upRatio * steps[i]);
    Levels levels;
    for (const double start : s.starts()) levels.merge(reachedFrom(start, steps, s.leastDb, s.mostDb));
    return levels;
}

Levels levelsOf(const QuestMethod& q) {
    const auto levels = questPlan(q, 0.5).levels;
    return {levels.begin(), levels.end()};
}

/// Levels that an alternative can have in a session, summed as Experiment does. An adjusted alternative is
/// played at the adjusted level.
Levels levelsOf(const Protocol& protocol, const SessionPlan& session, const Alternative& alternative) {
    const auto moves = [&](const auto& plan) { return plan && plan->alternative == alternative.name; };
    if (moves(session.adjustment)) return levelsOf(*session.adjustment);
    const auto from = std::ranges::find(protocol.sessions, session.levelsFrom, &SessionPlan::name);
    Levels added;
    if (!session.levelsFrom.empty() && from != protocol.sessions.end() && moves(from->adjustment))
        added = spread(from->adjustment->leastDb, from->adjustment->mostDb); // means of what was set
    else if (moves(session.staircase))
        added = levelsOf(*session.staircase);
    else if (moves(session.quest))
        added = levelsOf(*session.quest);
    else if (!session.levelsFile.empty())
        for (const StimulusLevel& level : protocol.levels)
            if (level.alternative == alternative.name) added.insert(level.levelDb);
    if (added.empty()) added = {0.0};
    Levels levels;
    for (const double db : added) levels.insert(alternative.levelDb + db);
    return levels;
}

/// Parts of a session's trials, each with its levels; one part without a name if trials have none.
std::map<std::string, Levels> partsOf(const Protocol& protocol, const SessionPlan& session) {
    std::map<std::string, Levels> parts;
    for (const Alternative& alternative : session.alternatives)
        for (const double db : levelsOf(protocol, session, alternative)) {
            Levels& levels = parts[alternative.name];
            levels.insert(db);
            if (std::ranges::any_of(protocol.conditions, rovesApart)) continue;
            for (int tenth = 1; tenth <= std::lround(10.0 * session.roveDb); ++tenth)
                levels.insert(
                    {std::round((db - 0.1 * tenth) * 1e6) / 1e6, std::round((db + 0.1 * tenth) * 1e6) / 1e6});
        }
    for (const std::string& object : session.objects) parts[object] = {0.0};
    if (parts.empty() && !session.isOnce) parts[{}] = {0.0};
    return parts;
}

/// True if a level only scales the samples of this condition's stimuli.
bool isGain(const ConditionPlan& condition) {
    const CallSet* const calls = callSetOf(condition.stimuli);
    return calls == nullptr || (calls->variables.empty() && movedBesideStrength(condition).empty());
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
                all.emplace_back(PlannedSession{s, c, mostTrialsOf(protocol.sessions[s], items.size()), {}});
            const double each = static_cast<double>(planned.trials) / static_cast<double>(items.size()) *
                                (protocol.sessions[s].comparesPairs ? 2.0 : 1.0);
            for (const StimulusItem& item : items)
                for (const auto& [part, levels] : partsOf(protocol, protocol.sessions[s]))
                    planned.felt.push_back(
                        {c, item.label, part,
                         !part.empty() && part == protocol.sessions[s].reference ? 2.0 * each : each});
            if (const std::string& modulus = protocol.sessions[s].modulus; !modulus.empty())
                planned.felt.push_back({c, modulus, {}, static_cast<double>(planned.trials)});
        }
    }
    return all;
}

} // namespace

int mostTrialsOf(const SessionPlan& session, std::size_t stimuli) {
    const auto count = static_cast<int>(session.isOnce          ? 1
                                        : session.comparesPairs ? stimuli * (stimuli - 1) / 2
                                                                : stimuli);
    if (session.answer() == AnswerKind::wish)
        return session.fewestTouches > 0 ? session.fewestTouches : count;
    if (session.quest) return session.quest->trials;
    if (session.staircase)
        return session.staircase->mostTrials * static_cast<int>(session.staircase->starts().size());
    return count * session.repetitions * (session.bothOrders ? 2 : 1);
}

std::vector<std::string> withoutBreaks(const Protocol& protocol, const SessionPlan& session) {
    std::vector<std::string> names;
    for (const ConditionPlan& condition : protocol.conditions)
        if (mostTrialsOf(session, static_cast<std::size_t>(stimulusCount(condition))) <= session.breakEvery)
            names.push_back(condition.name);
    return names;
}

TrialJob PlannedStimulus::job(const Protocol& protocol) const {
    TrialRecord record;
    record.trial.condition = condition;
    record.trial.session = session;
    record.trial.stimulus = label;
    if (!part.empty()) {
        record.trial.parts = {part};
        record.trial.partLevelsDb = {levelDb};
        record.answer.value = levelDb; // an adjustment plays its answered level
        if (rovesApart(protocol.conditions[condition]))
            record.trial.roveDb = protocol.sessions[session].roveDb;
    }
    return jobsOf(protocol, record).front();
}

std::vector<PlannedStimulus> plannedStimuli(const Protocol& protocol) {
    // of each part its levels, each with a session that sets it
    std::map<std::string, std::map<double, std::size_t>> parts;
    for (std::size_t s = 0; s < protocol.sessions.size(); ++s)
        for (const auto& [name, levels] : partsOf(protocol, protocol.sessions[s]))
            for (const double db : levels) parts[name].try_emplace(db, s);
    // sessions without alternatives play the same stimuli
    if (parts.size() > 1) parts.erase(std::string{});
    std::set<std::string> spreadParts;
    for (auto& [name, levels] : parts) {
        if (levels.size() <= mostPlannedLevels) continue;
        spreadParts.insert(name);
        std::map<double, std::size_t> even;
        for (const double db : spread(levels.begin()->first, levels.rbegin()->first))
            even[db] = std::prev(levels.upper_bound(db))->second;
        levels = std::move(even);
    }
    std::vector<PlannedStimulus> planned;
    for (std::size_t c = 0; c < protocol.conditions.size(); ++c) {
        const bool scales = isGain(protocol.conditions[c]);
        for (const StimulusItem& item : stimuliOf(protocol.conditions[c]))
            for (const auto& [name, levels] : parts)
                for (const auto& [db, session] : levels) {
                    const bool isHighest = db == levels.rbegin()->first;
                    if (!scales)
                        planned.push_back(
                            {c, session, item.label, name, db, true, spreadParts.contains(name)});
                    else if (isHighest || db == levels.begin()->first)
                        planned.push_back({c, session, item.label, name, db, isHighest});
                }
    }
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
            const double most =
                session.answerSeconds > 0.0 ? session.answerSeconds : PlannedTime::answerSeconds;
            work(felt / planned.trials +
                 (session.answer() == AnswerKind::wish ? 0.0 : std::min(most, PlannedTime::answerSeconds)));
        }
        time.trials += planned.trials;
    }
    return time;
}

OrderBalance orderBalance(const Protocol& protocol, int participants) {
    std::map<std::pair<std::size_t, std::size_t>, int> atPlace; // by condition and place
    std::set<std::pair<std::size_t, std::size_t>> successions;
    for (int number = 1; number <= participants; ++number) {
        const auto order = conditionOrder(protocol, number);
        for (std::size_t place = 0; place < order.size(); ++place) {
            ++atPlace[{order[place], place}];
            if (place > 0) successions.emplace(order[place - 1], order[place]);
        }
    }
    const std::size_t count = protocol.conditions.size();
    OrderBalance balance{participants, 0, static_cast<int>(successions.size()),
                         static_cast<int>(count * (count - 1))};
    for (std::size_t condition = 0; condition < count; ++condition)
        for (std::size_t place = 0; place < count; ++place) {
            const int times = atPlace[{condition, place}];
            balance.fewestAtPlace = std::min(balance.fewestAtPlace, times);
            balance.mostAtPlace = std::max(balance.mostAtPlace, times);
        }
    return balance;
}

} // namespace physvib
