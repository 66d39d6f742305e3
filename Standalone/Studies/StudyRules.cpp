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

using Print = std::uint64_t;

class Rules {
public:
    Rules(const Protocol& protocol, StudyCheck& check)
        : protocol_{protocol}
        , check_{check} {
        for (const CheckedStimulus& s : check.stimuli) {
            byLevel_[{s.condition, s.label, s.part}][s.levelDb] = &s;
            if (!s.error.empty()) broken_.insert(s.condition);
        }
    }

    void judge() {
        for (std::size_t c = 0; c < protocol_.conditions.size(); ++c) {
            if (broken_.contains(c)) continue; // its error is reported already
            judgeLevels(c);
            judgeStimuli(c);
            judgeTwin(c);
        }
        for (const SessionPlan& s : protocol_.sessions) judgeSession(s);
        if (std::ranges::all_of(protocol_.sessions, &SessionPlan::isTraining))
            warn("sessions: expected one that is no training, found none: nothing is analysed");
    }

private:
    using Levels = std::map<double, const CheckedStimulus*>;

    void refuse(std::string words) { check_.errors.push_back(std::move(words)); }
    void warn(std::string words) { check_.warnings.push_back(std::move(words)); }
    std::string conditionWords(std::size_t c) const {
        return "condition " + printable(protocol_.conditions[c].name);
    }
    const Levels& levelsOf(std::size_t c, const std::string& label, const std::string& part) const {
        static const Levels none;
        const auto found = byLevel_.find({c, label, part});
        return found != byLevel_.end() ? found->second : none;
    }
    /// Hashes of the samples of every part of a stimulus, at its highest levels.
    std::vector<Print> printsOf(std::size_t c, const std::string& label) const {
        std::vector<Print> prints;
        for (auto at = byLevel_.lower_bound({c, label, {}});
             at != byLevel_.end() && std::get<0>(at->first) == c && std::get<1>(at->first) == label; ++at)
            for (const auto& [db, one] : at->second)
                if (one->isHighest) prints.push_back(one->print);
        return prints;
    }
    /// Hash of the samples of a part at that level, or of its call if the check has not rendered it there.
    Print printOf(std::size_t c, std::size_t session, const std::string& label, const std::string& part,
                  double db) const {
        const Levels& levels = levelsOf(c, label, part);
        if (const auto found = levels.find(db); found != levels.end()) return found->second->print;
        return printOfCall(PlannedStimulus{c, session, label, part, db}.job(protocol_));
    }

    void judgeLevels(std::size_t c) {
        std::set<std::string> told;
        for (const auto& [key, levels] : byLevel_) {
            const auto& [condition, label, part] = key;
            if (condition != c || levels.size() < 2 || levels.rbegin()->first <= -limits::maxLevelDb)
                continue;
            const Print first = levels.begin()->second->print;
            if (std::ranges::all_of(levels,
                                    [=](const auto& level) { return level.second->print == first; }) &&
                told.insert(part).second)
                refuse(conditionWords(c) + ", " + cleanLine(label) + ", " + printable(part) +
                       ": its level changes nothing: the same samples from " +
                       fixedNumber(levels.begin()->first, 1) + " to " +
                       fixedNumber(levels.rbegin()->first, 1) +
                       " dB; expected {level_db} or a variable in the call");
        }
    }

    void judgeStimuli(std::size_t c) {
        const auto items = stimuliOf(protocol_.conditions[c]);
        std::map<std::vector<Print>, std::string> first; // the first stimulus with these samples
        std::string twins;
        for (const StimulusItem& item : items)
            if (const auto [at, isNew] = first.try_emplace(printsOf(c, item.label), item.label);
                !isNew && twins.empty())
                twins = cleanLine(at->second) + " and " + cleanLine(item.label);
        if (items.size() < 2 || twins.empty()) return;
        bool isRefused = false;
        if (const CallSet* const calls = callSetOf(protocol_.conditions[c].stimuli))
            for (std::size_t f = 0; f < calls->factors.size(); ++f)
                if (calls->factors[f].values.size() > 1 && isDead(c, items, f)) {
                    isRefused = true;
                    refuse(conditionWords(c) + ": factor " + printable(calls->factors[f].name) +
                           " changes nothing: the same samples whatever its value; expected {" +
                           printable(calls->factors[f].name) + "} in the call, and values that differ there");
                }
        if (isRefused) return;
        const std::string words = conditionWords(c) + ": stimuli " + twins + " are the same samples";
        first.size() == 1 ? refuse(words + ", as all others") : warn(words);
    }

    /// True if no two stimuli that differ in this factor alone differ in a sample.
    bool isDead(std::size_t c, const std::vector<StimulusItem>& items, std::size_t factor) const {
        std::map<std::vector<std::pair<std::string, std::string>>, std::vector<Print>> others;
        return std::ranges::all_of(items, [&](const StimulusItem& item) {
            auto rest = item.values;
            rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(factor));
            const auto prints = printsOf(c, item.label);
            return others.try_emplace(rest, prints).first->second == prints;
        });
    }

    /// Warns of conditions with the same samples: they may differ in what is not rendered, such as a posture.
    void judgeTwin(std::size_t c) {
        const auto whole = [this](std::size_t condition) {
            std::vector<std::vector<Print>> all;
            for (const StimulusItem& item : stimuliOf(protocol_.conditions[condition]))
                all.push_back(printsOf(condition, item.label));
            std::ranges::sort(all);
            return all;
        };
        const auto layoutOf = [this](std::size_t condition) {
            auto layout =
                layoutNamed(besideProtocol(protocol_.folder, protocol_.conditions[condition].layout));
            layout.value.name.clear();
            return layoutJson(layout.value);
        };
        for (std::size_t before = 0; before < c; ++before)
            if (whole(before) == whole(c) && layoutOf(before) == layoutOf(c))
                return warn("conditions " + printable(protocol_.conditions[before].name) + " and " +
                            printable(protocol_.conditions[c].name) +
                            " are the same samples on the same layout: expected a difference that is not "
                            "rendered, such as a posture");
    }

    /// True if both parts are the same samples in every stimulus of every condition.
    bool areAlike(std::size_t session, const Alternative& a, const Alternative& b) const {
        const auto isAlike = [&](std::size_t c, const std::string& label) {
            const Levels &ofA = levelsOf(c, label, a.name), &ofB = levelsOf(c, label, b.name);
            if (a.levelDb == b.levelDb && !ofA.empty() && !ofB.empty() && // rendered at their highest levels
                ofA.rbegin()->first == ofB.rbegin()->first)
                return ofA.rbegin()->second->print == ofB.rbegin()->second->print;
            return printOf(c, session, label, a.name, a.levelDb) ==
                   printOf(c, session, label, b.name, b.levelDb);
        };
        for (std::size_t c = 0; c < protocol_.conditions.size(); ++c)
            for (const StimulusItem& item : stimuliOf(protocol_.conditions[c]))
                if (broken_.contains(c) || !isAlike(c, item.label)) return false;
        return true;
    }

    /// Refuses parts that are the same samples: all of them, or the right one and another.
    void judgeParts(std::size_t session, const std::string& what, std::vector<Alternative> parts,
                    const std::string& right) {
        if (parts.size() < 2) return;
        if (const auto at = std::ranges::find(parts, right, &Alternative::name); at != parts.end())
            std::iter_swap(parts.begin(), at);
        std::vector<std::string> alike{parts.front().name};
        for (std::size_t i = 1; i < parts.size(); ++i)
            if (areAlike(session, parts.front(), parts[i])) alike.push_back(parts[i].name);
        if (alike.size() < 2) return;
        const std::string words = what + listed(alike) + " are the same samples in every condition";
        alike.size() == parts.size() || !right.empty() ? refuse(words) : warn(words);
    }

    void judgeSession(const SessionPlan& s) {
        const std::string at = "session " + printable(s.name) + ": ";
        const auto index = static_cast<std::size_t>(&s - protocol_.sessions.data());
        std::vector<Alternative> objects, alternatives = s.alternatives;
        for (const std::string& object : s.objects) objects.push_back({object});
        judgeParts(index, at + "objects ", objects, {});
        if (!s.levelsFrom.empty() || !s.levelsFile.empty()) // matched: their levels make no difference
            for (Alternative& one : alternatives) one.levelDb = 0.0;
        if (s.answer() == AnswerKind::choice && !s.adaptedAlternative())
            judgeParts(index, at + "alternatives ", alternatives, s.correct);
        if (s.staircase) judgeStaircase(at + "staircase: ", *s.staircase);
        if (s.adjustment) judgeStep(at + "adjustment: ", *s.adjustment);
        if (s.staircase)
            judgeReference(at + "staircase: ", s, *s.staircase, std::ranges::min(s.staircase->starts()));
        if (s.quest) judgeReference(at + "quest: ", s, *s.quest, s.quest->mostDb);
        if (s.roveDb > 0.0)
            for (const ConditionPlan& c : protocol_.conditions)
                if (const auto moved = movedBesideStrength(c, true); !moved.empty()) {
                    warn(at + "rove_db moves " + listed(moved) + " of condition " + printable(c.name) +
                         " by a factor of up to " + fixedNumber(fromDecibels(s.roveDb), 2) +
                         ", and not how strong it is alone");
                    break;
                }
        std::size_t fewest = mostFewTrials;
        for (const ConditionPlan& c : protocol_.conditions)
            fewest = std::min(fewest, static_cast<std::size_t>(
                                          mostTrialsOf(s, static_cast<std::size_t>(stimulusCount(c)))));
        if (s.untilCorrect > static_cast<int>(fewest))
            warn(at + "until_correct: " + std::to_string(s.untilCorrect) + " in a row cannot be reached in " +
                 std::to_string(fewest) + " trials");
        if (s.breakEvery > 0 && s.breakSeconds > 0.0)
            if (const auto none = withoutBreaks(protocol_, s); !none.empty())
                warn(at + "break_every: " + std::to_string(s.breakEvery) +
                     " trials are never over before the last of " + std::to_string(fewest) +
                     ": there is no break" +
                     (none.size() < protocol_.conditions.size() ? " in " + listed(none) : ""));
        if (s.leastSeconds > 0.0 && s.mostPlays > 0) judgeLeast(at, s);
    }

    /// Refuses a minimum duration that the allowed number of plays cannot reach.
    void judgeLeast(const std::string& at, const SessionPlan& s) {
        double shortest = s.leastSeconds;
        for (const CheckedStimulus& one : check_.stimuli)
            if (!one.isOpenEnded && one.error.empty() && one.seconds > 0.0)
                shortest = std::min(shortest, s.mostPlays * one.seconds);
        if (shortest < s.leastSeconds)
            refuse(at + "least_s: " + numberText(s.leastSeconds) + " s cannot be reached by most_plays " +
                   std::to_string(s.mostPlays) + ", which last " + fixedNumber(shortest, 2) + " s");
    }

    void judgeStep(const std::string& at, const auto& plan) {
        if (plan.stepDb > plan.mostDb - plan.leastDb)
            refuse(at + "step_db " + numberText(plan.stepDb) + " is larger than the range from " +
                   numberText(plan.leastDb) + " to " + numberText(plan.mostDb) + " dB");
    }

    void judgeStaircase(const std::string& at, const StaircasePlan& plan) {
        judgeStep(at, plan);
        const int moves = plan.reversals + 1, // up by one answer, down by `down` of them
            fewest = (moves + 1) / 2 + moves / 2 * plan.down;
        if (plan.mostTrials < fewest)
            warn(at + "reversals: " + std::to_string(plan.reversals) + " need " + std::to_string(fewest) +
                 " trials at least, and most_trials is " + std::to_string(plan.mostTrials));
    }

    /// Refuses a stimulus that differs from the others only in level and lies below them: another one is then
    /// the right choice, and right answers lead away from the threshold.
    void judgeReference(const std::string& at, const SessionPlan& s, const auto& plan, double startDb) {
        const auto isOneSound = [](const ConditionPlan& c) { return !namesParts(c); };
        if (std::ranges::none_of(protocol_.conditions, isOneSound)) return;
        double ownDb = 0.0, otherDb = -limits::maxLevelDb;
        for (const Alternative& one : s.alternatives)
            one.name == plan.alternative ? ownDb = one.levelDb : otherDb = std::max(otherDb, one.levelDb);
        const std::string words = printable(plan.alternative) + " is at " + numberText(ownDb + startDb) +
                                  " dB, the others at up to " + numberText(otherDb) + " dB: ";
        if (ownDb + startDb < otherDb || ownDb + plan.mostDb <= otherDb)
            refuse(at + words + "expected it to begin above them, as right answers lower it");
        else if (ownDb + plan.leastDb < otherDb)
            warn(at + "least_db " + numberText(plan.leastDb) + ": there " + printable(plan.alternative) +
                 " is below the others, and choosing it still counts as right");
    }

    static constexpr std::size_t mostFewTrials = 1'000'000;
    const Protocol& protocol_;
    StudyCheck& check_;
    std::map<std::tuple<std::size_t, std::string, std::string>, Levels> byLevel_;
    std::set<std::size_t> broken_; // conditions that cannot be played
};

} // namespace

void judgeRules(const Protocol& protocol, StudyCheck& check) { Rules{protocol, check}.judge(); }

} // namespace physvib
