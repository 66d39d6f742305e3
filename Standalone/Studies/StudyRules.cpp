// SPDX-License-Identifier: GPL-3.0-or-later
// Reports stimuli with the same samples, which nobody can tell apart, and settings that cannot take effect.
#include "Core/Units.h"
#include "Io/Text/CleanText.h"
#include "Io/Text/NameList.h"
#include "Io/Text/NumberText.h"
#include "Lab/Files/ProtocolFile.h"
#include "Lab/Study/StudyPlan.h"
#include "Scene/LayoutFile.h"
#include "Studies/StudyCheck.h"
#include <algorithm>
#include <map>
#include <set>
#include <tuple>

namespace physvib {
namespace {

using SamplesHash = std::uint64_t;

/// Applies the rules of checkRules() to a check, and adds their errors and warnings to it.
class RuleChecker {
public:
    RuleChecker(const Protocol& protocol, StudyCheck& check)
        : protocol_{protocol}
        , check_{check} {
        for (const CheckedStimulus& s : check.stimuli) {
            byLevel_[{s.condition, s.label, s.part}][s.levelDb] = &s;
            if (!s.error.empty()) conditionsWithErrors_.insert(s.condition);
        }
    }

    void checkAll() {
        for (std::size_t c = 0; c < protocol_.conditions.size(); ++c) {
            if (conditionsWithErrors_.contains(c)) continue; // its error is reported already
            checkLevels(c);
            checkStimuli(c);
            checkForTwinCondition(c);
        }
        for (const SessionPlan& s : protocol_.sessions) checkSession(s);
        if (std::ranges::all_of(protocol_.sessions, &SessionPlan::isTraining))
            addWarning("sessions: expected one that is no training, found none: nothing is analysed");
    }

private:
    using Levels = std::map<double, const CheckedStimulus*>;

    void addError(std::string message) { check_.errors.push_back(std::move(message)); }
    void addWarning(std::string message) { check_.warnings.push_back(std::move(message)); }
    std::string conditionText(std::size_t c) const {
        return "condition " + printable(protocol_.conditions[c].name);
    }
    const Levels& findLevels(std::size_t c, const std::string& label, const std::string& part) const {
        static const Levels noLevels;
        const auto entry = byLevel_.find({c, label, part});
        return entry != byLevel_.end() ? entry->second : noLevels;
    }
    /// Hashes of the samples of every part of a stimulus, at its highest levels.
    std::vector<SamplesHash> collectHashes(std::size_t c, const std::string& label) const {
        std::vector<SamplesHash> hashes;
        for (auto row = byLevel_.lower_bound({c, label, {}});
             row != byLevel_.end() && std::get<0>(row->first) == c && std::get<1>(row->first) == label; ++row)
            for (const auto& [db, checked] : row->second)
                if (checked->isHighest) hashes.push_back(checked->samplesHash);
        return hashes;
    }
    /// Hash of the samples of a part at that level, or of its call if the check has not rendered it there.
    SamplesHash findHash(std::size_t c, std::size_t session, const std::string& label,
                         const std::string& part, double db) const {
        const Levels& levels = findLevels(c, label, part);
        if (const auto level = levels.find(db); level != levels.end()) return level->second->samplesHash;
        return callHash(PlannedStimulus{c, session, label, part, db}.job(protocol_));
    }

    void checkLevels(std::size_t c) {
        std::set<std::string> reportedParts;
        for (const auto& [key, levels] : byLevel_) {
            const auto& [condition, label, part] = key;
            if (condition != c || levels.size() < 2 || levels.rbegin()->first <= -limits::maxLevelDb)
                continue;
            const SamplesHash firstHash = levels.begin()->second->samplesHash;
            if (std::ranges::all_of(
                    levels, [=](const auto& level) { return level.second->samplesHash == firstHash; }) &&
                reportedParts.insert(part).second)
                addError(conditionText(c) + ", " + cleanLine(label) + ", " + printable(part) +
                         ": its level changes nothing: the same samples from " +
                         fixedNumber(levels.begin()->first, 1) + " to " +
                         fixedNumber(levels.rbegin()->first, 1) +
                         " dB; expected {level_db} or a variable in the call");
        }
    }

    void checkStimuli(std::size_t c) {
        const auto items = conditionStimuli(protocol_.conditions[c]);
        std::map<std::vector<SamplesHash>, std::string> labelsByHash; // the first stimulus with these samples
        std::string twinLabels;
        for (const StimulusItem& item : items)
            if (const auto [twin, isNew] = labelsByHash.try_emplace(collectHashes(c, item.label), item.label);
                !isNew && twinLabels.empty())
                twinLabels = cleanLine(twin->second) + " and " + cleanLine(item.label);
        if (items.size() < 2 || twinLabels.empty()) return;
        bool hasError = false;
        if (const CallSet* const calls = findCalls(protocol_.conditions[c].stimuli))
            for (std::size_t f = 0; f < calls->factors.size(); ++f)
                if (calls->factors[f].values.size() > 1 && hasNoEffect(c, items, f)) {
                    hasError = true;
                    addError(conditionText(c) + ": factor " + printable(calls->factors[f].name) +
                             " changes nothing: the same samples whatever its value; expected {" +
                             printable(calls->factors[f].name) +
                             "} in the call, and values that differ there");
                }
        if (hasError) return;
        const std::string message = conditionText(c) + ": stimuli " + twinLabels + " are the same samples";
        labelsByHash.size() == 1 ? addError(message + ", as all others") : addWarning(message);
    }

    /// True if stimuli that differ in this factor alone have the same samples.
    bool hasNoEffect(std::size_t c, const std::vector<StimulusItem>& items, std::size_t factor) const {
        std::map<std::vector<std::pair<std::string, std::string>>, std::vector<SamplesHash>> others;
        return std::ranges::all_of(items, [&](const StimulusItem& item) {
            auto otherValues = item.values;
            otherValues.erase(otherValues.begin() + static_cast<std::ptrdiff_t>(factor));
            const auto hashes = collectHashes(c, item.label);
            return others.try_emplace(otherValues, hashes).first->second == hashes;
        });
    }

    /// Warns of conditions with the same samples: they may differ in what is not rendered, such as a posture.
    void checkForTwinCondition(std::size_t c) {
        const auto sortedHashes = [this](std::size_t condition) {
            std::vector<std::vector<SamplesHash>> all;
            for (const StimulusItem& item : conditionStimuli(protocol_.conditions[condition]))
                all.push_back(collectHashes(condition, item.label));
            std::ranges::sort(all);
            return all;
        };
        const auto layoutText = [this](std::size_t condition) {
            auto layout =
                resolveLayout(resolveProtocolPath(protocol_.folder, protocol_.conditions[condition].layout));
            layout.value.name.clear();
            return layoutJson(layout.value);
        };
        for (std::size_t earlier = 0; earlier < c; ++earlier)
            if (sortedHashes(earlier) == sortedHashes(c) && layoutText(earlier) == layoutText(c))
                return addWarning(
                    "conditions " + printable(protocol_.conditions[earlier].name) + " and " +
                    printable(protocol_.conditions[c].name) +
                    " are the same samples on the same layout: expected a difference that is not "
                    "rendered, such as a posture");
    }

    /// True if both parts are the same samples in every stimulus of every condition.
    bool areAlike(std::size_t session, const Alternative& a, const Alternative& b) const {
        const auto isAlike = [&](std::size_t c, const std::string& label) {
            const Levels &levelsA = findLevels(c, label, a.name), &levelsB = findLevels(c, label, b.name);
            if (a.levelDb == b.levelDb && !levelsA.empty() && !levelsB.empty() && // rendered at their highest
                levelsA.rbegin()->first == levelsB.rbegin()->first)
                return levelsA.rbegin()->second->samplesHash == levelsB.rbegin()->second->samplesHash;
            return findHash(c, session, label, a.name, a.levelDb) ==
                   findHash(c, session, label, b.name, b.levelDb);
        };
        for (std::size_t c = 0; c < protocol_.conditions.size(); ++c)
            for (const StimulusItem& item : conditionStimuli(protocol_.conditions[c]))
                if (conditionsWithErrors_.contains(c) || !isAlike(c, item.label)) return false;
        return true;
    }

    /// Refuses parts that are the same samples: all of them, or the right one and another.
    void checkParts(std::size_t session, const std::string& prefix, std::vector<Alternative> parts,
                    const std::string& correctPart) {
        if (parts.size() < 2) return;
        if (const auto part = std::ranges::find(parts, correctPart, &Alternative::name); part != parts.end())
            std::iter_swap(parts.begin(), part);
        std::vector<std::string> alikeParts{parts.front().name};
        for (std::size_t i = 1; i < parts.size(); ++i)
            if (areAlike(session, parts.front(), parts[i])) alikeParts.push_back(parts[i].name);
        if (alikeParts.size() < 2) return;
        const std::string message =
            prefix + nameList(alikeParts) + " are the same samples in every condition";
        alikeParts.size() == parts.size() || !correctPart.empty() ? addError(message) : addWarning(message);
    }

    void checkSession(const SessionPlan& s) {
        const std::string prefix = "session " + printable(s.name) + ": ";
        const auto index = static_cast<std::size_t>(&s - protocol_.sessions.data());
        std::vector<Alternative> objects, alternatives = s.alternatives;
        for (const std::string& object : s.objects) objects.push_back({object});
        checkParts(index, prefix + "objects ", objects, {});
        if (!s.levelsFrom.empty() || !s.levelsFile.empty()) // their own levels are not used
            for (Alternative& part : alternatives) part.levelDb = 0.0;
        if (s.answerKind() == AnswerKind::choice && !s.adaptedAlternative())
            checkParts(index, prefix + "alternatives ", alternatives, s.correct);
        if (s.staircase) checkStaircase(prefix + "staircase: ", *s.staircase);
        if (s.adjustment) checkStep(prefix + "adjustment: ", *s.adjustment);
        if (s.staircase)
            checkReference(prefix + "staircase: ", s, *s.staircase, std::ranges::min(s.staircase->starts()));
        if (s.quest) checkReference(prefix + "quest: ", s, *s.quest, s.quest->maxDb);
        if (s.roveDb > 0.0)
            for (const ConditionPlan& c : protocol_.conditions)
                if (const auto movedVariables = nonGainVariables(c, true); !movedVariables.empty()) {
                    addWarning(prefix + "rove_db moves " + nameList(movedVariables) + " of condition " +
                               printable(c.name) + " by a factor of up to " +
                               fixedNumber(fromDecibels(s.roveDb), 2) + ", and not how strong it is alone");
                    break;
                }
        std::size_t minTrials = maxTrials;
        for (const ConditionPlan& c : protocol_.conditions)
            minTrials = std::min(minTrials, static_cast<std::size_t>(maxSessionTrials(
                                                s, static_cast<std::size_t>(stimulusCount(c)))));
        if (s.untilCorrect > static_cast<int>(minTrials))
            addWarning(prefix + "until_correct: " + std::to_string(s.untilCorrect) +
                       " in a row cannot be reached in " + std::to_string(minTrials) + " trials");
        if (s.breakEvery > 0 && s.breakSeconds > 0.0)
            if (const auto withoutBreaks = conditionsWithoutBreaks(protocol_, s); !withoutBreaks.empty())
                addWarning(prefix + "break_every: " + std::to_string(s.breakEvery) +
                           " trials are never over before the last of " + std::to_string(minTrials) +
                           ": there is no break" +
                           (withoutBreaks.size() < protocol_.conditions.size()
                                ? " in " + nameList(withoutBreaks)
                                : ""));
        if (s.minSeconds > 0.0 && s.maxPlays > 0) checkMinSeconds(prefix, s);
    }

    /// Refuses a minimum duration that the allowed number of plays cannot reach.
    void checkMinSeconds(const std::string& prefix, const SessionPlan& s) {
        double maxPlayedSeconds = s.minSeconds;
        for (const CheckedStimulus& checked : check_.stimuli)
            if (!checked.isOpenEnded && checked.error.empty() && checked.seconds > 0.0)
                maxPlayedSeconds = std::min(maxPlayedSeconds, s.maxPlays * checked.seconds);
        if (maxPlayedSeconds < s.minSeconds)
            addError(prefix + "least_s: " + numberText(s.minSeconds) + " s cannot be reached by most_plays " +
                     std::to_string(s.maxPlays) + ", which last " + fixedNumber(maxPlayedSeconds, 2) + " s");
    }

    void checkStep(const std::string& prefix, const auto& plan) {
        if (plan.stepDb > plan.maxDb - plan.minDb)
            addError(prefix + "step_db " + numberText(plan.stepDb) + " is larger than the range from " +
                     numberText(plan.minDb) + " to " + numberText(plan.maxDb) + " dB");
    }

    void checkStaircase(const std::string& prefix, const StaircasePlan& plan) {
        checkStep(prefix, plan);
        const int moveCount = plan.reversals + 1, // a move up takes one answer, a move down `down` answers
            minTrials = (moveCount + 1) / 2 + moveCount / 2 * plan.down;
        if (plan.maxTrials < minTrials)
            addWarning(prefix + "reversals: " + std::to_string(plan.reversals) + " need " +
                       std::to_string(minTrials) + " trials at least, and most_trials is " +
                       std::to_string(plan.maxTrials));
    }

    /// Refuses a stimulus that differs from the others only in level and lies below them: another one is then
    /// the right choice, and right answers lead away from the threshold.
    void checkReference(const std::string& prefix, const SessionPlan& s, const auto& plan, double startDb) {
        const auto isOneSound = [](const ConditionPlan& c) { return !hasPartPlaceholders(c); };
        if (std::ranges::none_of(protocol_.conditions, isOneSound)) return;
        double ownDb = 0.0, otherDb = -limits::maxLevelDb;
        for (const Alternative& part : s.alternatives)
            part.name == plan.alternative ? ownDb = part.levelDb : otherDb = std::max(otherDb, part.levelDb);
        const std::string message = printable(plan.alternative) + " is at " + numberText(ownDb + startDb) +
                                    " dB, the others at up to " + numberText(otherDb) + " dB: ";
        if (ownDb + startDb < otherDb || ownDb + plan.maxDb <= otherDb)
            addError(prefix + message + "expected it to begin above them, as right answers lower it");
        else if (ownDb + plan.minDb < otherDb)
            addWarning(prefix + "least_db " + numberText(plan.minDb) + ": there " +
                       printable(plan.alternative) +
                       " is below the others, and choosing it still counts as right");
    }

    static constexpr std::size_t maxTrials = 1'000'000;
    const Protocol& protocol_;
    StudyCheck& check_;
    std::map<std::tuple<std::size_t, std::string, std::string>, Levels> byLevel_;
    std::set<std::size_t> conditionsWithErrors_; // conditions that cannot be played
};

} // namespace

void checkRules(const Protocol& protocol, StudyCheck& check) { RuleChecker{protocol, check}.checkAll(); }

} // namespace physvib
