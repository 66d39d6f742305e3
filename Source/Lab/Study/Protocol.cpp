// SPDX-License-Identifier: MIT
// Validates a protocol as a whole, and lists the stimuli of its conditions.
#include "Lab/Study/Protocol.h"
#include "Io/Text/NumberText.h"
#include "Lab/Study/Experiment.h"
#include <tuple>

namespace physvib {
namespace {

constexpr double maxStimuli = 4096;     // per condition; a session of this size takes a day
constexpr double maxTrials = 100'000.0; // per session and condition; this number takes a week

template <class NameOf = std::identity>
bool hasDuplicates(const auto& items, NameOf nameOf = {}) {
    std::set<std::string> names;
    return !std::ranges::all_of(
        items, [&](const auto& item) { return names.insert(std::invoke(nameOf, item)).second; });
}

bool hasAlternative(const SessionPlan& s, const std::string& name) {
    return std::ranges::find(s.alternatives, name, &Alternative::name) != s.alternatives.end();
}

bool isAdjustmentBefore(const Protocol& p, const SessionPlan& session) {
    return std::ranges::any_of(p.sessions.data(), &session, [&](const SessionPlan& s) {
        return s.name == session.levelsFrom && s.adjustment;
    });
}

/// True if an adjustment or staircase starts within its range.
bool startsInside(const auto& plan, const std::vector<double>& starts) {
    return std::ranges::all_of(starts, [&](double db) { return plan.minDb <= db && db <= plan.maxDb; });
}

/// Checks the fields that only some tasks use.
std::string taskError(const SessionPlan& s) {
    using Kind = AnswerKind;
    const Kind answer = s.answerKind();
    const bool compares = answer == Kind::choice || answer == Kind::level;
    if (!s.answers.empty() && (answer != Kind::choice || s.answers.size() < 2 || !s.alternatives.empty() ||
                               s.adaptedAlternative() || s.roveDb > 0.0))
        return "answers: expected two or more of the task choose, in place of alternatives";
    if (hasDuplicates(s.answers)) return "answers: expected no two alike";
    if (compares && s.answers.empty() && s.alternatives.size() < 2)
        return "alternatives: expected two or more, found " + std::to_string(s.alternatives.size());
    if (!compares && !s.alternatives.empty())
        return "alternatives: expected them of " + taskNames({Kind::choice, Kind::level}) + " only";
    if (hasDuplicates(s.alternatives, &Alternative::name))
        return "alternatives: expected a name of its own for each";
    if (hasDuplicates(s.objects)) return "objects: expected a name of its own for each";
    const auto hasBar = [](const std::string& name) { return name.find('|') != std::string::npos; };
    for (const auto& [field, has] :
         {std::pair{"alternatives", std::ranges::any_of(s.alternatives, hasBar, &Alternative::name)},
          {"objects", std::ranges::any_of(s.objects, hasBar)}})
        if (has) return field + std::string{": expected names without |, which parts them in trial files"};
    if (s.bothOrders && !s.comparesPairs && (answer != Kind::choice || s.alternatives.size() != 2))
        return "both_orders: expected it of two alternatives to choose from, or of pairs";
    if ((answer == Kind::scores) == s.scales.empty() && !(answer == Kind::scores && s.objects.size() > 1))
        return "scales: expected them of " + taskNames({Kind::scores}) + ", and of no other";
    if (!s.definitions.empty() && s.definitions.size() != s.scales.size())
        return "definitions: expected one of each scale";
    if (!s.anchors.empty() && s.anchors.size() != 2)
        return "anchors: expected two, of the left end and of the right";
    if (hasDuplicates(s.scales)) return "scales: expected a name of its own for each";
    if (answer != Kind::scores && (!s.objects.empty() || s.points > 0 || s.comparesPairs))
        return "objects, points, pairs: expected them of " + taskNames({Kind::scores}) + " only";
    if (s.points == 1) return "points: expected 2 or more, found 1";
    if (s.comparesPairs && !s.objects.empty()) return "pairs: expected them without objects";
    if (!s.reference.empty() &&
        (!s.ratesSideBySide() || std::ranges::find(s.objects, s.reference) == s.objects.end()))
        return "reference: expected one of the objects, which are rated side by side, without scales";
    if (s.isQuestionnaire && ((answer != Kind::scores && answer != Kind::words) || !s.objects.empty() ||
                              s.comparesPairs || s.maxPlays > 0 || s.minSeconds > 0.0))
        return "once: expected it of " + taskNames({Kind::scores, Kind::words}) + ", where nothing is felt";
    if (s.answerSeconds > 0.0 && (answer == Kind::request || answer == Kind::level))
        return "answer_within_s: expected it of other tasks than explore and adjust";
    if ((answer == Kind::level) != s.adjustment.has_value())
        return "adjustment: expected it of " + taskNames({Kind::level}) + ", and of no other";
    if (s.adjustment && !hasAlternative(s, s.adjustment->alternative))
        return "adjustment.alternative: expected the name of an alternative";
    if (s.adjustment && !startsInside(*s.adjustment, {s.adjustment->startDb}))
        return "adjustment: expected least_db <= start_db <= most_db";
    if (s.staircase && !startsInside(*s.staircase, s.staircase->starts()))
        return "staircase: expected least_db <= start_db <= most_db";
    if (s.staircase && s.quest) return "quest: expected it or a staircase, found both";
    if (const std::string* const adapted = s.adaptedAlternative()) {
        const std::string method = s.staircase ? "staircase" : "quest";
        if (answer != Kind::choice) return method + ": expected it of " + taskNames({Kind::choice}) + " only";
        if (s.bothOrders) return method + ": expected alternatives in random order";
        if (!hasAlternative(s, *adapted)) return method + ".alternative: expected the name of an alternative";
    }
    if (s.quest)
        if (std::string error = questError(*s.quest); !error.empty()) return "quest" + error;
    if (answer == Kind::request && !s.isTraining)
        return "task: expected " + std::string{taskDescription(s.task).name} + " in a training session only";
    if (s.givesFeedback && !s.hasCorrectAnswers())
        return "feedback: expected it where answers are right or wrong: of a label, a staircase or QUEST+";
    if (s.intervalSeconds > 0.0 && s.alternatives.size() < 2 && s.objects.size() < 2 && s.modulus.empty() &&
        !s.comparesPairs)
        return "interval_s: expected two or more alternatives or objects, or a modulus, which follow one "
               "another";
    if (!s.correct.empty() &&
        (answer != Kind::choice || s.adaptedAlternative() || !hasAlternative(s, s.correct)))
        return "correct: expected the name of an alternative to choose, without a staircase or QUEST+";
    if (s.untilCorrect > 0 && (s.adaptedAlternative() || !s.hasCorrectAnswers()))
        return "until_correct: expected it where answers are right or wrong, without a staircase or QUEST+";
    for (const auto& [isUsed, field, kind] : {std::tuple{s.roveDb > 0.0, "rove_db", Kind::choice},
                                              {!s.modulus.empty(), "modulus", Kind::number},
                                              {s.mayBeEmpty, "may_be_empty", Kind::words},
                                              {s.minTouches > 0, "fewest_touches", Kind::request}})
        if (isUsed && answer != kind)
            return field + std::string{": expected it of "} + taskNames({kind}) + " only";
    return {};
}

void replaceAll(std::string& words, const std::string& from, const std::string& to) {
    for (std::size_t at = words.find(from); at != std::string::npos; at = words.find(from, at + to.size()))
        words.replace(at, from.size(), to);
}

/// True if a value for a call contains no further placeholder.
bool hasNoBraces(const std::string& value) { return value.find_first_of("{}") == std::string::npos; }

std::string placeholderError(const CallSet& calls) {
    for (const StudyFactor& factor : calls.factors)
        if (!hasNoBraces(factor.name) || !std::ranges::all_of(factor.values, hasNoBraces))
            return "factors: expected names and values without braces";
        else if (!factor.labels.empty() && factor.labels.size() != factor.values.size())
            return "factors: expected a label of each value, or none";
        else if (!hasNoBraces(factor.otherValue) || factor.alternative.empty() != factor.otherValue.empty())
            return "factors: expected alternative and otherwise together, or neither";
    std::set<std::string> names{"alternative", "object", "level_db"};
    for (const StudyFactor& factor : calls.factors) names.insert(factor.name);
    for (const StudyVariable& variable : calls.variables)
        if (!hasNoBraces(variable.name) || !names.insert(variable.name).second)
            return "variables: expected a name of its own for each, without braces, found " + variable.name;
    return {};
}

bool callHasPartPlaceholders(const CallSet& calls) {
    return calls.call.find("{alternative}") != std::string::npos ||
           calls.call.find("{object}") != std::string::npos ||
           std::ranges::any_of(calls.factors, [](const auto& f) { return !f.alternative.empty(); });
}

/// Possible values of {alternative} and {object} in a call.
std::set<std::string> placeholderValues(const Protocol& p, const CallSet& calls) {
    return callHasPartPlaceholders(calls) ? callPartNames(p) : std::set<std::string>{""};
}

std::size_t occurrences(std::string_view words, std::string_view text) {
    std::size_t count = 0;
    for (std::size_t at = text.find(words); at != std::string_view::npos; at = text.find(words, at + 1))
        ++count;
    return count;
}

/// Empty, or the error of the first invalid call that a condition can make.
std::string callSetError(const Protocol& p, const ConditionPlan& c, const CallSet& calls) {
    if (std::string error = placeholderError(calls); !error.empty()) return error;
    if (!std::ranges::all_of(placeholderValues(p, calls), hasNoBraces))
        return "call: expected alternatives and objects without braces";
    return firstCallError(p, c, [&p](const std::string& call) -> std::string {
        if (std::string error = callError(call); !error.empty()) return "call: " + error;
        const auto bytes = addSoundOptions(p, call).size();
        return bytes <= maxCallBytes ? std::string{}
                                     : "call: expected at most " + std::to_string(maxCallBytes) +
                                           " bytes with its recordings, found " + std::to_string(bytes);
    });
}

std::string stimuliError(const ConditionPlan& c, const SessionPlan& s) {
    const bool isGrid = std::holds_alternative<GridSet>(c.stimuli);
    if (stimulusCount(c) * s.repetitions > maxTrials)
        return "stimuli: expected at most " + std::to_string(static_cast<int>(maxTrials)) +
               " trials in session " + s.name;
    if (s.answerKind() == AnswerKind::place && !isGrid)
        return "stimuli: expected a grid, which the task " + std::string{taskDescription(s.task).name} +
               " needs";
    if (s.minTouches > 0 && !isGrid) return "stimuli: expected a grid, which free touches need";
    if (const CallSet* const calls = findCalls(c.stimuli);
        s.roveDb > 0.0 && calls != nullptr && calls->variables.empty() &&
        calls->call.find("{level_db}") == std::string::npos)
        return "call: expected {level_db} or a variable in it, which rove_db moves";
    if (s.comparesPairs && (stimulusCount(c) < 2 || std::holds_alternative<WorldSet>(c.stimuli)))
        return "stimuli: expected two or more to compare, and no world";
    const auto items = conditionStimuli(c);
    if (!s.modulus.empty() && std::ranges::find(items, s.modulus, &StimulusItem::label) == items.end())
        return "stimuli: expected the modulus of session " + s.name + " among them, " + s.modulus;
    return {};
}

std::string conditionError(const Protocol& p, const ConditionPlan& c) {
    if (!isPlainPath(c.layout)) return "layout: expected a name, or a file in the folder or below";
    if (stimulusCount(c) > maxStimuli)
        return "stimuli: expected at most " + std::to_string(static_cast<int>(maxStimuli)) + " of them";
    for (const auto& s : p.sessions)
        if (std::string error = stimuliError(c, s); !error.empty()) return error;
    if (const auto* patterns = std::get_if<PatternSet>(&c.stimuli))
        for (const double seconds : patterns->pulseSeconds)
            if (parsePatternLabel(patternLabel({seconds, 1, {}}))->pulseSeconds != seconds)
                return "pulse_s: expected whole milliseconds";
    if (const CallSet* calls = findCalls(c.stimuli)) {
        if (hasDuplicates(calls->factors, &StudyFactor::name))
            return "factors: expected a name of its own for each";
        if (std::string error = callSetError(p, c, *calls); !error.empty()) return error;
        if (std::holds_alternative<WorldSet>(c.stimuli) && !calls->call.starts_with("render "))
            return "call: expected render and a scene, which a world needs";
    }
    if (hasDuplicates(conditionStimuli(c), &StimulusItem::label))
        return "stimuli: expected no two of the same label";
    return {};
}

std::vector<StimulusItem> stimulusItems(const PatternSet& set) {
    std::vector<StimulusItem> items;
    for (const double seconds : set.pulseSeconds)
        for (PulsePattern pattern : allPulsePatterns(set.enchanters)) {
            // allPulsePatterns() has each combination once per built-in duration; use one of these
            if (pattern.pulseSeconds != pulseDurationsSeconds.front()) continue;
            pattern.pulseSeconds = seconds;
            items.push_back({patternLabel(pattern), {}});
        }
    return items;
}

std::vector<StimulusItem> stimulusItems(const GridSet& set) {
    std::vector<StimulusItem> items;
    for (const GridCell& cell : set.grid().cells()) items.push_back({gridLabel(cell), {}});
    return items;
}

std::vector<StimulusItem> stimulusItems(const CallSet& set) {
    if (set.factors.empty()) return {StimulusItem{"stimulus", {}}};
    std::vector<StimulusItem> items{{}};
    for (const StudyFactor& factor : set.factors) {
        std::vector<StimulusItem> extended;
        for (const StimulusItem& item : items)
            for (std::size_t i = 0; i < factor.values.size(); ++i) {
                StimulusItem& next = extended.emplace_back(item);
                next.values.emplace_back(factor.name, factor.values[i]);
                // "pair=wood size=small"; the label alone if there is one factor
                if (set.factors.size() > 1) next.label += (item.label.empty() ? "" : " ") + factor.name + "=";
                next.label += i < factor.labels.size() ? factor.labels[i] : factor.values[i];
            }
        items = std::move(extended);
    }
    return items;
}

double countStimuli(const PatternSet& set) noexcept {
    const double e = set.enchanters;
    return static_cast<double>(set.pulseSeconds.size()) * (e + e * e + e * e * e);
}
double countStimuli(const GridSet& set) noexcept { return static_cast<double>(set.columns) * set.rows; }
double countStimuli(const CallSet& set) noexcept {
    double count = 1.0;
    for (const auto& factor : set.factors) count *= static_cast<double>(factor.values.size());
    return count;
}

/// That every stimulus of a session with a levels file has a level there, of one of its alternatives.
std::string levelsError(const Protocol& p, const SessionPlan& s) {
    for (const ConditionPlan& c : p.conditions)
        for (const StimulusItem& item : conditionStimuli(c)) {
            const StimulusLevel* const level = findLevel(p.levels, c.name, item.label);
            if (level == nullptr)
                return s.levelsFile + ": expected a level of " + c.name + ", " + item.label + ", found none";
            if (!hasAlternative(s, level->alternative))
                return s.levelsFile + ": expected levels of an alternative of session " + s.name +
                       ", found " + level->alternative;
        }
    return {};
}

} // namespace

std::string firstCallError(const Protocol& p, const ConditionPlan& c,
                           const std::function<std::string(const std::string& call)>& check) {
    const CallSet* const calls = findCalls(c.stimuli);
    if (calls == nullptr) return {};
    const auto parts = placeholderValues(p, *calls);
    for (const StimulusItem& item : conditionStimuli(c))
        for (const std::string& part : parts)
            if (std::string error = check(resolveCall(*calls, item, part, 0.0)); !error.empty()) return error;
    return {};
}

bool hasPartPlaceholders(const ConditionPlan& condition) {
    const CallSet* const calls = findCalls(condition.stimuli);
    return calls != nullptr && callHasPartPlaceholders(*calls);
}

std::vector<std::string> nonGainVariables(const ConditionPlan& condition, bool byRove) {
    std::vector<std::string> changed;
    const CallSet* const calls = findCalls(condition.stimuli);
    if (calls == nullptr) return changed;
    const auto addIfUsedElsewhere = [&](const std::string& name, const std::string& option) {
        const std::string word = "{" + name + "}";
        if (occurrences(option + word, calls->call) < occurrences(word, calls->call)) changed.push_back(name);
    };
    const bool hasRoving = hasRovingVariable(condition);
    if (!byRove || !hasRoving) addIfUsedElsewhere("level_db", "--level-db ");
    for (const StudyVariable& variable : calls->variables)
        if (variable.isRoving == (byRove && hasRoving)) addIfUsedElsewhere(variable.name, "--level-g ");
    return changed;
}

bool hasRovingVariable(const ConditionPlan& condition) noexcept {
    const CallSet* const calls = findCalls(condition.stimuli);
    return calls != nullptr && std::ranges::any_of(calls->variables, &StudyVariable::isRoving);
}

std::string levelsError(const Protocol& p) {
    for (const SessionPlan& s : p.sessions)
        if (std::string error = s.levelsFile.empty() ? "" : levelsError(p, s); !error.empty()) return error;
    return {};
}

std::string validate(const Protocol& p) {
    const auto errorAt = [](const char* list, std::size_t index, const std::string& error) {
        return std::string(list) + "[" + std::to_string(index) + "]." + error;
    };
    if (!isPlainPath(p.translation)) return "words: expected a name, or a file in the folder or below";
    for (std::size_t i = 0; i < p.sounds.size(); ++i)
        if (!isPlainPath(p.sounds[i].file))
            return errorAt(
                "sounds", i,
                "file: expected a file in the folder or below, of plain characters; others are given "
                "with --sound");
    for (std::size_t i = 0; i < p.pictures.size(); ++i) {
        if (p.pictures[i].material.empty())
            return errorAt("pictures", i, "material: expected a word in a material's name, found none");
        if (const auto path = picturePath(p.pictures[i], "P01");
            !isPlainPath(path) || !path.ends_with(".png"))
            return errorAt("pictures", i,
                           "file: expected a PNG file in the folder or below, of plain characters");
    }
    if (hasDuplicates(p.pictures, &MaterialPictureFile::material))
        return "pictures: expected a material of its own for each";
    if (p.conditions.empty()) return "conditions: expected one or more, found none";
    if (p.sessions.empty()) return "sessions: expected one or more, found none";
    if (hasDuplicates(p.conditions, &ConditionPlan::name))
        return "conditions: expected a name of its own for each";
    if (hasDuplicates(p.sessions, &SessionPlan::name)) return "sessions: expected a name of its own for each";
    for (std::size_t i = 0; i < p.sessions.size(); ++i) {
        const SessionPlan& s = p.sessions[i];
        if (std::string error = taskError(s); !error.empty()) return errorAt("sessions", i, error);
        if (!s.levelsFile.empty()) {
            if (!isPlainPath(s.levelsFile))
                return errorAt("sessions", i,
                               "levels_file: expected a file in the folder or below, of plain characters");
            if (s.answerKind() != AnswerKind::choice || s.adaptedAlternative() || !s.levelsFrom.empty())
                return errorAt("sessions", i,
                               "levels_file: expected it of " + taskNames({AnswerKind::choice}) +
                                   ", without another level");
            if (std::ranges::any_of(p.sessions, [&](const SessionPlan& o) {
                    return !o.levelsFile.empty() && o.levelsFile != s.levelsFile;
                }))
                return errorAt("sessions", i, "levels_file: expected one file for all sessions");
        }
        if (!s.levelsFrom.empty() && !isAdjustmentBefore(p, s))
            return errorAt("sessions", i, "levels_from: expected an earlier session of the task adjust");
    }
    for (std::size_t i = 0; i < p.conditions.size(); ++i)
        if (std::string error = conditionError(p, p.conditions[i]); !error.empty())
            return errorAt("conditions", i, error);
    const auto rovingCount = std::ranges::count_if(p.conditions, hasRovingVariable);
    if (rovingCount != 0 && rovingCount != std::ssize(p.conditions))
        return "conditions: expected a variable that roves in each of them, or in none";
    return {};
}

std::string picturePath(const MaterialPictureFile& picture, const std::string& participant) {
    std::string path = picture.file;
    replaceAll(path, "{participant}", participant);
    return path;
}

std::vector<std::string> protocolScales(const Protocol& protocol) {
    std::vector<std::string> scales;
    for (const auto& session : protocol.sessions)
        for (const auto& scale : session.scores())
            if (std::ranges::find(scales, scale) == scales.end()) scales.push_back(scale);
    return scales;
}

std::set<std::string> callPartNames(const Protocol& p) {
    std::set<std::string> parts;
    for (const SessionPlan& s : p.sessions) {
        for (const Alternative& a : s.alternatives) parts.insert(a.name);
        parts.insert(s.objects.begin(), s.objects.end());
    }
    if (parts.empty()) parts.emplace();
    return parts;
}

std::string resolveCall(const CallSet& set, const StimulusItem& item, const std::string& part, double levelDb,
                        double roveDb) {
    std::string words = set.call;
    for (const auto& [name, value] : item.values) {
        const StudyFactor& factor = *std::ranges::find(set.factors, name, &StudyFactor::name);
        const bool isOfPart = factor.alternative.empty() || factor.alternative == part;
        replaceAll(words, "{" + name + "}", isOfPart ? value : factor.otherValue);
    }
    replaceAll(words, "{alternative}", part);
    replaceAll(words, "{object}", part);
    replaceAll(words, "{level_db}", numberText(levelDb));
    for (const StudyVariable& variable : set.variables)
        replaceAll(words, "{" + variable.name + "}",
                   numberText(variable.valueAt(variable.isRoving ? roveDb : levelDb)));
    return words;
}

std::vector<StimulusItem> conditionStimuli(const ConditionPlan& condition) {
    return std::visit([](const auto& set) { return stimulusItems(set); }, condition.stimuli);
}

std::vector<StimulusItem> stimulusItems(const SessionPlan& session, const ConditionPlan& condition) {
    if (session.isQuestionnaire) return {{}};
    auto items = conditionStimuli(condition);
    if (!session.comparesPairs) return items;
    std::vector<StimulusItem> pairs;
    for (std::size_t b = 1; b < items.size(); ++b)
        for (std::size_t a = 0; a < b; ++a)
            pairs.push_back({items[a].label + std::string{pairSeparator} + items[b].label, {}});
    return pairs;
}

double stimulusCount(const ConditionPlan& condition) noexcept {
    return std::visit([](const auto& set) { return countStimuli(set); }, condition.stimuli);
}

} // namespace physvib
