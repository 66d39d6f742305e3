// SPDX-License-Identifier: MIT
// Scores a trial and creates the jobs that reproduce its stimulus.
#include "Lab/Study/Trial.h"
#include "Core/Units.h"
#include <algorithm>
#include <cmath>
#include <functional>

namespace physvib {
namespace {

/// Level in g, rounded so that its text is short and exact to a thousandth of a dB.
double raised(double levelG, double db) {
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
    StimulusJob job(std::variant<PatternJob, PhantomJob> what, double db) const {
        return {std::move(what), condition.layout,
                condition.isAtResonance ? std::nullopt : std::optional{condition.frequencyHz},
                raised(condition.levelG, db)};
    }

    TrialJob operator()(const PatternSet& set, const Part& part) const {
        return job(PatternJob{label(), set.gapSeconds}, part.levelDb);
    }
    TrialJob operator()(const GridSet& set, const Part& part) const {
        PhantomJob phantom{GridPlace{set.grid(), parseGridCell(label()).value_or(GridCell{})}, set.law,
                           set.exponent, set.seconds};
        if (record.trial.stimulus.empty() && record.answer.place) phantom.at = *record.answer.place;
        return job(std::move(phantom), part.levelDb);
    }
    TrialJob operator()(const CallSet& set, const Part& part) const {
        const auto items = stimuliOf(condition);
        const auto item = std::ranges::find(items, label(), &StimulusItem::label);
        return WrittenCall{withSounds(
            protocol, callOf(set, item != items.end() ? *item : StimulusItem{}, part.name, part.levelDb))};
    }
};

} // namespace

std::optional<GridCell> targetOf(const ConditionPlan& condition, const Trial& trial) {
    return std::holds_alternative<GridSet>(condition.stimuli) ? parseGridCell(trial.stimulus) : std::nullopt;
}

std::optional<bool> isCorrect(const Protocol& protocol, const TrialRecord& record) {
    const SessionPlan& session = protocol.sessions[record.trial.session];
    if (!session.hasCorrectAnswers()) return std::nullopt;
    const std::string* const adapted = session.adaptedAlternative();
    return record.answer.response == (adapted != nullptr         ? *adapted
                                      : !session.correct.empty() ? session.correct
                                                                 : record.trial.stimulus);
}

std::vector<TrialJob> jobsOf(const Protocol& protocol, const TrialRecord& record) {
    const ConditionPlan& condition = protocol.conditions[record.trial.condition];
    const JobMaker maker{protocol, condition, record};
    const SessionPlan& session = protocol.sessions[record.trial.session];
    std::vector<TrialJob> jobs;
    TrialRecord first = record;
    first.trial.stimulus = session.modulus;
    if (!session.modulus.empty() && record.trial.parts.size() == 2) // the modulus, and the stimulus
        for (const TrialRecord& one : {std::cref(first), std::cref(record)})
            jobs.push_back(std::visit(
                [&](const auto& set) {
                    return JobMaker{protocol, condition, one}(set, Part{});
                },
                condition.stimuli));
    if (!jobs.empty()) return jobs;
    const auto add = [&](const Part& part) {
        jobs.push_back(std::visit([&](const auto& set) { return maker(set, part); }, condition.stimuli));
    };
    for (std::size_t i = 0; i < record.trial.parts.size(); ++i) {
        const std::string& name = record.trial.parts[i];
        // an adjusted alternative is played at the answered level
        const bool isAdjusted = session.adjustment && session.adjustment->alternative == name;
        add({name, isAdjusted                             ? record.answer.value
                   : i < record.trial.partLevelsDb.size() ? record.trial.partLevelsDb[i]
                                                          : 0.0});
    }
    if (jobs.empty()) add({{}, 0.0});
    return jobs;
}

} // namespace physvib
