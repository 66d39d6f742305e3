// SPDX-License-Identifier: MIT
// Counts the rows of every planned session, and plays adaptive ones again.
#include "Lab/Report/UnfinishedRuns.h"
#include "Io/Text/NumberText.h"
#include "Lab/Files/TrialColumns.h"
#include "Lab/Study/AdaptiveLevel.h"
#include "Lab/Study/StudyOrder.h"
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
        if (Staircases* const mixed = level.mixed()) mixed->choose(answer.staircase);
        level.answer(answer.isCorrect);
    }
    return !level.isDone();
}

std::size_t plannedOf(const SessionPlan& plan, std::size_t stimuli) {
    if (plan.quest) return static_cast<std::size_t>(plan.quest->trials);
    if (plan.staircase)
        return static_cast<std::size_t>(plan.staircase->mostTrials) * plan.staircase->starts().size();
    SeededRandom anyOrder{1};
    return sessionOrder(plan, stimuli, anyOrder).size();
}

} // namespace

std::string UnfinishedRun::words() const {
    return "participant " + participant + " did not finish " + session + " in " + condition + ": " +
           std::to_string(trials) + " of " + (isAdaptive ? "up to " : "") + counted(planned, "trial") +
           (isAdaptive ? ", so the threshold is not one of the method" : "");
}

std::vector<UnfinishedRun> unfinishedRuns(const ReportTrials& trials) {
    const auto participant = trials.all.column("participant"), condition = trials.all.column("condition"),
               session = trials.all.column("session"), correct = trials.all.column("correct"),
               staircase = trials.all.column(trialColumns::staircase);
    if (!trials.protocol || !participant || !condition || !session || !correct) return {};
    std::map<RunKey, Answers> runs;
    std::vector<std::string> people;
    for (const CsvRow& row : trials.all.rows) {
        const std::string& who = row.cells[*participant];
        if (std::ranges::find(people, who) == people.end()) people.push_back(who);
        runs[{who, row.cells[*condition], row.cells[*session]}].push_back(
            {row.cells[*correct] == "1",
             staircase ? parseNumber<std::size_t>(row.cells[*staircase]).value_or(1) - 1 : 0});
    }
    std::vector<UnfinishedRun> unfinished;
    for (const std::string& who : people)
        for (const ConditionPlan& planned : trials.protocol->conditions)
            for (const SessionPlan& plan : trials.protocol->sessions) {
                if (plan.answer() == AnswerKind::wish) continue;
                const Answers& answers = runs[{who, planned.name, plan.name}];
                const std::size_t most = plannedOf(plan, stimuliOf(planned).size());
                if (isUnfinished(plan, answers, most))
                    unfinished.push_back({who, planned.name, plan.name, answers.size(), most,
                                          plan.adaptedAlternative() != nullptr});
            }
    return unfinished;
}

} // namespace physvib
