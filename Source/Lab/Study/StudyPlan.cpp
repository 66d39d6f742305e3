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

using Levels = std::set<double>; // levels in dB

/// maxPlannedLevels + 1 levels from `minDb` to `maxDb`, evenly spread.
Levels evenLevels(double minDb, double maxDb) {
    Levels levels{maxDb};
    for (std::size_t i = 0; i < maxPlannedLevels; ++i)
        levels.insert(minDb + (maxDb - minDb) * static_cast<double>(i) / maxPlannedLevels);
    return levels;
}

/// All levels within the range that `steps` up and down reach from `start`. If they are more than
/// maxPlannedLevels, as with steps that do not divide one another, levels spread over the range.
Levels reachableLevels(double start, std::vector<double> steps, double minDb, double maxDb) {
    Levels reached{start};
    for (std::vector<double> next{start}; !next.empty();) {
        if (reached.size() > maxPlannedLevels) return evenLevels(minDb, maxDb);
        const double level = next.back();
        next.pop_back();
        for (const double step : steps)
            for (const double neighbour : {level - step, level + step})
                if (const double rounded = std::round(std::clamp(neighbour, minDb, maxDb) * 1e6) * 1e-6;
                    reached.insert(rounded).second)
                    next.push_back(rounded);
    }
    return reached;
}

Levels possibleLevels(const Adjustment& a) {
    Levels levels = reachableLevels(a.startDb, {a.stepDb}, a.minDb, a.maxDb);
    if (a.hasRandomStart) levels.merge(reachableLevels(a.minDb, {a.stepDb}, a.minDb, a.maxDb));
    return levels;
}

Levels possibleLevels(const StaircasePlan& s) {
    std::vector<double> steps{s.stepDb};
    while (steps.back() > s.minStepDb) steps.push_back(std::max(s.minStepDb, 0.5 * steps.back()));
    if (s.upRatio != 1.0)
        for (std::size_t i = steps.size(); i-- > 0;) steps.push_back(s.upRatio * steps[i]);
    Levels levels;
    for (const double start : s.starts()) levels.merge(reachableLevels(start, steps, s.minDb, s.maxDb));
    return levels;
}

Levels possibleLevels(const QuestMethod& q) {
    const auto levels = questPlan(q, 0.5).levels;
    return {levels.begin(), levels.end()};
}

/// Levels that an alternative can have in a session, summed as Experiment does. An adjusted alternative is
/// played at the adjusted level.
Levels possibleLevels(const Protocol& protocol, const SessionPlan& session, const Alternative& alternative) {
    const auto varies = [&](const auto& plan) { return plan && plan->alternative == alternative.name; };
    if (varies(session.adjustment)) return possibleLevels(*session.adjustment);
    const auto from = std::ranges::find(protocol.sessions, session.levelsFrom, &SessionPlan::name);
    Levels added;
    if (!session.levelsFrom.empty() && from != protocol.sessions.end() && varies(from->adjustment))
        added = evenLevels(from->adjustment->minDb, from->adjustment->maxDb); // means of adjusted levels
    else if (varies(session.staircase))
        added = possibleLevels(*session.staircase);
    else if (varies(session.quest))
        added = possibleLevels(*session.quest);
    else if (!session.levelsFile.empty())
        for (const StimulusLevel& level : protocol.levels)
            if (level.alternative == alternative.name) added.insert(level.levelDb);
    if (added.empty()) added = {0.0};
    Levels levels;
    for (const double db : added) levels.insert(alternative.levelDb + db);
    return levels;
}

/// Parts of a session's trials, each with its levels; one part without a name if trials have none.
std::map<std::string, Levels> partLevels(const Protocol& protocol, const SessionPlan& session) {
    std::map<std::string, Levels> parts;
    for (const Alternative& alternative : session.alternatives)
        for (const double db : possibleLevels(protocol, session, alternative)) {
            Levels& levels = parts[alternative.name];
            levels.insert(db);
            if (std::ranges::any_of(protocol.conditions, hasRovingVariable)) continue;
            for (int tenth = 1; tenth <= std::lround(10.0 * session.roveDb); ++tenth)
                levels.insert(
                    {std::round((db - 0.1 * tenth) * 1e6) / 1e6, std::round((db + 0.1 * tenth) * 1e6) / 1e6});
        }
    for (const std::string& object : session.objects) parts[object] = {0.0};
    if (parts.empty() && !session.isQuestionnaire) parts[{}] = {0.0};
    return parts;
}

/// True if a level only scales the samples of this condition's stimuli.
bool isGain(const ConditionPlan& condition) {
    const CallSet* const calls = findCalls(condition.stimuli);
    return calls == nullptr || (calls->variables.empty() && nonGainVariables(condition).empty());
}

/// One session in one condition.
struct PlannedSession {
    std::size_t session = 0, condition = 0;
    int trials = 0;
    std::vector<PlannedTrials> plays; ///< every part of every stimulus, with its number of plays
};

/// In protocol order, as for one participant.
std::vector<PlannedSession> plannedSessions(const Protocol& protocol) {
    std::vector<PlannedSession> all;
    for (std::size_t c = 0; c < protocol.conditions.size(); ++c) {
        const auto items = conditionStimuli(protocol.conditions[c]);
        for (std::size_t s = 0; s < protocol.sessions.size(); ++s) {
            PlannedSession& planned = all.emplace_back(
                PlannedSession{s, c, maxSessionTrials(protocol.sessions[s], items.size()), {}});
            const double plays = static_cast<double>(planned.trials) / static_cast<double>(items.size()) *
                                 (protocol.sessions[s].comparesPairs ? 2.0 : 1.0);
            for (const StimulusItem& item : items)
                for (const auto& [part, levels] : partLevels(protocol, protocol.sessions[s]))
                    planned.plays.push_back(
                        {c, item.label, part,
                         !part.empty() && part == protocol.sessions[s].reference ? 2.0 * plays : plays});
            if (const std::string& modulus = protocol.sessions[s].modulus; !modulus.empty())
                planned.plays.push_back({c, modulus, {}, static_cast<double>(planned.trials)});
        }
    }
    return all;
}

} // namespace

int maxSessionTrials(const SessionPlan& session, std::size_t stimuli) {
    const auto count = static_cast<int>(session.isQuestionnaire ? 1
                                        : session.comparesPairs ? stimuli * (stimuli - 1) / 2
                                                                : stimuli);
    if (session.answerKind() == AnswerKind::request)
        return session.minTouches > 0 ? session.minTouches : count;
    if (session.quest) return session.quest->trials;
    if (session.staircase)
        return session.staircase->maxTrials * static_cast<int>(session.staircase->starts().size());
    return count * session.repetitions * (session.bothOrders ? 2 : 1);
}

std::vector<std::string> conditionsWithoutBreaks(const Protocol& protocol, const SessionPlan& session) {
    std::vector<std::string> names;
    for (const ConditionPlan& condition : protocol.conditions)
        if (maxSessionTrials(session, static_cast<std::size_t>(stimulusCount(condition))) <=
            session.breakEvery)
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
        if (hasRovingVariable(protocol.conditions[condition]))
            record.trial.roveDb = protocol.sessions[session].roveDb;
    }
    return trialJobs(protocol, record).front();
}

std::vector<PlannedStimulus> plannedStimuli(const Protocol& protocol) {
    // of each part its levels, each with a session that sets it
    std::map<std::string, std::map<double, std::size_t>> parts;
    for (std::size_t s = 0; s < protocol.sessions.size(); ++s)
        for (const auto& [name, levels] : partLevels(protocol, protocol.sessions[s]))
            for (const double db : levels) parts[name].try_emplace(db, s);
    // sessions without alternatives play the same stimuli
    if (parts.size() > 1) parts.erase(std::string{});
    std::set<std::string> spreadParts;
    for (auto& [name, levels] : parts) {
        if (levels.size() <= maxPlannedLevels) continue;
        spreadParts.insert(name);
        std::map<double, std::size_t> spreadLevels;
        for (const double db : evenLevels(levels.begin()->first, levels.rbegin()->first))
            spreadLevels[db] = std::prev(levels.upper_bound(db))->second;
        levels = std::move(spreadLevels);
    }
    std::vector<PlannedStimulus> planned;
    for (std::size_t c = 0; c < protocol.conditions.size(); ++c) {
        const bool isLevelGain = isGain(protocol.conditions[c]);
        for (const StimulusItem& item : conditionStimuli(protocol.conditions[c]))
            for (const auto& [name, levels] : parts)
                for (const auto& [db, session] : levels) {
                    const bool isHighest = db == levels.rbegin()->first;
                    if (!isLevelGain)
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
        std::ranges::move(session.plays, std::back_inserter(all));
    return all;
}

PlannedTime
plannedTime(const Protocol& protocol,
            const std::function<double(std::size_t, const std::string&, const std::string&)>& secondsOf) {
    PlannedTime time;
    double stretchSeconds = 0.0;
    std::size_t condition = 0;
    const auto addWork = [&](double seconds) {
        time.seconds += seconds,
            time.maxStretchSeconds = std::max(time.maxStretchSeconds, stretchSeconds += seconds);
    };
    const auto addBreak = [&](double seconds) {
        if (seconds > 0.0) time.seconds += seconds, stretchSeconds = 0.0;
    };
    for (const PlannedSession& planned : plannedSessions(protocol)) {
        const SessionPlan& session = protocol.sessions[planned.session];
        if (std::exchange(condition, planned.condition) != planned.condition)
            addBreak(protocol.conditionBreakSeconds);
        addBreak(session.breakBeforeSeconds);
        double playSeconds = 0.0; // sum over all trials of the session
        for (const PlannedTrials& play : planned.plays)
            playSeconds +=
                play.count * std::max(session.minSeconds, secondsOf(play.condition, play.label, play.part));
        for (int t = 0; t < planned.trials; ++t) {
            if (session.breakEvery > 0 && t > 0 && t % session.breakEvery == 0)
                addBreak(session.breakSeconds);
            const double limitSeconds =
                session.answerSeconds > 0.0 ? session.answerSeconds : PlannedTime::answerSeconds;
            addWork(playSeconds / planned.trials +
                    (session.answerKind() == AnswerKind::request
                         ? 0.0
                         : std::min(limitSeconds, PlannedTime::answerSeconds)));
        }
        time.trials += planned.trials;
    }
    return time;
}

OrderBalance orderBalance(const Protocol& protocol, int participants) {
    std::map<std::pair<std::size_t, std::size_t>, int> counts; // by condition and position
    std::set<std::pair<std::size_t, std::size_t>> successions;
    for (int number = 1; number <= participants; ++number) {
        const auto order = conditionOrder(protocol, number);
        for (std::size_t position = 0; position < order.size(); ++position) {
            ++counts[{order[position], position}];
            if (position > 0) successions.emplace(order[position - 1], order[position]);
        }
    }
    const std::size_t count = protocol.conditions.size();
    OrderBalance balance{participants, 0, static_cast<int>(successions.size()),
                         static_cast<int>(count * (count - 1))};
    for (std::size_t condition = 0; condition < count; ++condition)
        for (std::size_t position = 0; position < count; ++position) {
            const int occurrences = counts[{condition, position}];
            balance.minAtPosition = std::min(balance.minAtPosition, occurrences);
            balance.maxAtPosition = std::max(balance.maxAtPosition, occurrences);
        }
    return balance;
}

} // namespace physvib
