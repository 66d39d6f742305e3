// SPDX-License-Identifier: MIT
// Counts the rows of every planned session, and plays adaptive ones again.
#include "Lab/Report/UnfinishedRuns.h"
#include "Io/Text/NumberText.h"
#include "Lab/Files/TrialColumns.h"
#include "Lab/Report/ReportCells.h"
#include "Lab/Study/AdaptiveLevel.h"
#include "Lab/Study/StudyPlan.h"
#include <algorithm>
#include <tuple>

namespace physvib {
namespace {

/// The answer of a row of a run, and which of several staircases it is of, from 0.
struct RunAnswer {
    bool isCorrect = false;
    std::size_t staircase = 0;
};
using Answers = std::vector<RunAnswer>;
using RunKey = std::tuple<std::string, std::string, std::string>; // participant, condition, session

bool isUnfinished(const SessionPlan& plan, const Answers& answers, std::size_t planned) {
    if (plan.untilCorrect > 0) { // the last so many are right
        const auto wrong = std::ranges::find(answers.rbegin(), answers.rend(), false, &RunAnswer::isCorrect);
        if (wrong - answers.rbegin() >= plan.untilCorrect) return false;
    }
    if (!plan.adaptedAlternative()) return answers.size() < planned;
    AdaptiveLevel level{plan};
    for (const RunAnswer& answer : answers) {
        level.choose(answer.staircase);
        level.answer(answer.isCorrect);
    }
    return !level.isDone();
}

} // namespace

std::string UnfinishedRun::words() const {
    return "participant " + participant + " did not finish " + session + " in " + condition + ": " +
           std::to_string(trials) + " of " + (isAdaptive ? "up to " : "") + counted(planned, "trial") +
           (isAdaptive ? ", so the threshold is not one of the method" : "");
}

std::vector<UnfinishedRun> unfinishedRuns(const ReportTrials& trials) {
    const Cells cell{trials.all};
    if (!trials.protocol || !cell.has("participant") || !cell.has("session") || !cell.has("correct"))
        return {};
    std::map<RunKey, Answers> runs;
    std::vector<std::string> people;
    for (const CsvRow& row : trials.all.rows) {
        const std::string& who = cell(row, "participant");
        if (std::ranges::find(people, who) == people.end()) people.push_back(who);
        const auto staircase = parseNumber<std::size_t>(cell(row, trialColumns::staircase));
        runs[{who, cell(row, "condition"), cell(row, "session")}].push_back(
            {cell(row, "correct") == "1", staircase.value_or(1) - 1});
    }
    std::map<RunKey, std::size_t> notLeft; // answered, though no evidence
    for (const CsvRow& row : trials.notLeft)
        ++notLeft[{cell(row, "participant"), cell(row, "condition"), cell(row, "session")}];
    std::vector<UnfinishedRun> unfinished;
    for (const std::string& who : people)
        for (const ConditionPlan& planned : trials.protocol->conditions)
            for (const SessionPlan& plan : trials.protocol->sessions) {
                if (plan.answer() == AnswerKind::wish) continue;
                const Answers& answers = runs[{who, planned.name, plan.name}];
                const std::size_t most =
                    static_cast<std::size_t>(mostTrialsOf(plan, stimuliOf(planned).size()));
                if (isUnfinished(plan, answers,
                                 most - std::min(most, notLeft[{who, planned.name, plan.name}])))
                    unfinished.push_back({who, planned.name, plan.name, answers.size(), most,
                                          plan.adaptedAlternative() != nullptr});
            }
    return unfinished;
}

} // namespace physvib
