// SPDX-License-Identifier: MIT
// Rows explain themselves: right or wrong, and how to feel them again.
#include "Study/Trial.h"
#include "Study/NumberWord.h"
#include <algorithm>
#include <cmath>

namespace physvib {
namespace {

/// Level in g; dB are rounded to a thousandth so that the text is short and exact enough.
double raised(double levelG, double db) { return db == 0.0 ? levelG : std::round(levelG * std::pow(10.0, db / 20.0) * 1e6) * 1e-6; }

struct Part {
    std::string name;
    double levelDb = 0.0;
};

struct CallMaker {
    const Protocol& protocol;
    const ConditionPlan& condition;
    const TrialRecord& record;

    std::string common(double db) const {
        return " --layout " + condition.layout + " --frequency " + (condition.isAtResonance ? "resonance" : numberWord(condition.frequencyHz)) + " --level-g " + numberWord(raised(condition.levelG, db));
    }
    const std::string& label() const { return record.trial.stimulus.empty() ? record.answer.response : record.trial.stimulus; }

    std::string call(const PatternSet& set, const Part& part) const { return "stimulus pattern " + label() + common(part.levelDb) + " --gap " + numberWord(set.gapSeconds); }
    std::string call(const GridSet& set, const Part& part) const {
        const bool isTouch = record.trial.stimulus.empty() && record.answer.place;
        const std::string where = isTouch ? "--at " + numberWord(record.answer.place->x) + "," + numberWord(record.answer.place->y)
                                          : "--grid " + std::to_string(set.columns) + "x" + std::to_string(set.rows) + " --cell " + label() +
                                                (set.points == PhantomGrid::Points::middles ? " --points middles" : "");
        return "stimulus phantom " + where + common(part.levelDb) + " --law " + std::string(panningLawNames[static_cast<std::size_t>(set.law)]) + " --exponent " + numberWord(set.exponent) +
               " --seconds " + numberWord(set.seconds);
    }
    std::string call(const CallSet& set, const Part& part) const {
        const auto items = stimuliOf(condition);
        const auto item = std::ranges::find(items, label(), &StimulusItem::label);
        const std::string words = callOf(set, item != items.end() ? *item : StimulusItem{}, part.name, numberWord(part.levelDb));
        return words + soundWords(protocol, words);
    }
};

} // namespace

std::string soundWords(const Protocol& protocol, const std::string& call) {
    std::string words;
    if (call.find("--method SV") == std::string::npos) return words;
    for (const StudySoundFile& sound : protocol.sounds) {
        const std::string quote = sound.file.find(' ') == std::string::npos ? "" : "\"";
        words += " --sound " + quote + numberWord(sound.frequencyHz) + "=" + sound.file + quote;
    }
    return words;
}

std::optional<GridCell> targetOf(const ConditionPlan& condition, const Trial& trial) {
    return std::holds_alternative<GridSet>(condition.stimuli) ? parseGridCell(trial.stimulus) : std::nullopt;
}

std::optional<bool> isCorrect(const Protocol& protocol, const TrialRecord& record) {
    const SessionPlan& session = protocol.sessions[record.trial.session];
    if (session.answer() == AnswerKind::label) return record.answer.response == record.trial.stimulus;
    if (const std::string* const adapted = session.adaptedAlternative()) return record.answer.response == *adapted;
    return std::nullopt;
}

std::vector<std::string> partCallsOf(const Protocol& protocol, const TrialRecord& record) {
    const ConditionPlan& condition = protocol.conditions[record.trial.condition];
    const CallMaker maker{protocol, condition, record};
    const SessionPlan& session = protocol.sessions[record.trial.session];
    std::vector<std::string> calls;
    const auto add = [&](const Part& part) { calls.push_back(std::visit([&](const auto& set) { return maker.call(set, part); }, condition.stimuli)); };
    for (std::size_t i = 0; i < record.trial.parts.size(); ++i) {
        const std::string& name = record.trial.parts[i];
        const bool isAdjusted = session.adjustment && session.adjustment->alternative == name; // felt at the level that was answered
        add({name, isAdjusted ? record.answer.value : i < record.trial.partLevelsDb.size() ? record.trial.partLevelsDb[i] : 0.0});
    }
    if (calls.empty()) add({{}, 0.0});
    return calls;
}

std::string callsOf(const Protocol& protocol, const TrialRecord& record) {
    std::string words;
    for (const std::string& session : record.answer.sessions) words.append(words.empty() ? "" : " ; ").append("render ").append(session);
    if (!words.empty()) return words;
    for (const std::string& call : partCallsOf(protocol, record)) words.append(words.empty() ? "" : " ; ").append(call);
    return words;
}

} // namespace physvib
