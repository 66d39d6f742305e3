// SPDX-License-Identifier: MIT
// Writes one sentence or clause per protocol field, in the order of Lab/Files/ProtocolFields.h.
#include "Lab/Report/ProtocolWords.h"
#include "Core/EventShaping.h"
#include "Core/Units.h"
#include "Io/Text/NameList.h"
#include "Io/Text/NumberText.h"
#include "Lab/Files/ProtocolFields.h"
#include "Lab/Files/ProtocolFile.h"
#include "Lab/Study/StudyPlan.h"
#include "Scene/ActuatorFile.h"
#include "Scene/LayoutFile.h"
#include <algorithm>
#include <cmath>
#include <set>

namespace physvib {
namespace {

/// "AF-FV-DRV: amplitude fixed, frequency varied, decay varied"; other names unchanged.
std::string inFull(const std::string& name) {
    RenderingMethod method;
    if (name == "SV") return "SV: the recorded contact";
    if (!renderingMethodNamed(name, method)) return name;
    const auto word = [](bool isFixed) { return std::string{isFixed ? "fixed" : "varied"}; };
    return name + ": amplitude " + word(method.fixesAmplitude) + ", frequency " +
           word(method.fixesFrequency) + ", decay " + word(method.fixesDecay);
}

/// Joins the texts of all items with `between`.
template <class Items, class WordsOf>
std::string joinedWords(const Items& items, const char* between, WordsOf wordsOf) {
    std::string words;
    for (std::size_t i = 0; i < items.size(); ++i) words.append(i ? between : "").append(wordsOf(items[i]));
    return words;
}

constexpr const char* inRandomOrder = ", in random order in each trial";

std::string spoken(const std::string& words) { return "\u201c" + words + "\u201d"; }
std::string secondsWords(double seconds) { return numberText(seconds) + " s"; }
std::string dbWords(double db) { return numberText(db) + " dB"; }
std::string rangeWords(double from, double to) { return "from " + numberText(from) + " to " + dbWords(to); }

std::string setWords(const PatternSet& set) {
    return "pulse patterns on " + std::to_string(set.enchanters) +
           (set.enchanters == 1 ? " actuator" : " actuators") + ", pulses of " +
           joinedWords(set.pulseSeconds, ", ", [](double s) { return numberText(s); }) + " s, " +
           secondsWords(set.gapSeconds) + " apart";
}

std::string setWords(const GridSet& set) {
    return "phantoms on a grid of " + std::to_string(set.columns) + " x " + std::to_string(set.rows) +
           " (columns x rows), " +
           (set.points == PhantomGrid::Points::corners ? "the outer points on the actuators"
                                                       : "points in the middles of cells") +
           ", law " + std::string(nameOf(set.law)) +
           (set.exponent != 1.0 ? " with exponent " + numberText(set.exponent) : std::string{}) + ", " +
           secondsWords(set.seconds);
}

std::string setWords(const CallSet& set) {
    return std::string{"calls of physvib"} + (set.call.empty() ? "" : " " + spoken(set.call)) +
           (set.factors.empty() ? "" : " by ") +
           joinedWords(set.factors, ", ",
                       [](const StudyFactor& factor) {
                           return factor.name + " (" + joinedWords(factor.values, "; ", inFull) +
                                  (factor.labels.empty() ? ")"
                                                         : ", called " + joined(factor.labels, "; ") + ")") +
                                  (factor.alternative.empty()
                                       ? std::string{}
                                       : " of " + factor.alternative + ", otherwise " + factor.otherwise);
                       }) +
           joinedWords(set.variables, "", [](const StudyVariable& variable) {
               return "; " + variable.name + " is " + numberText(variable.at0Db) +
                      (variable.roves ? " where rove_db is 0, and follows it alone"
                                      : " at a level of 0 dB, and 10 times as large at 20 dB");
           });
}

std::string setWords(const WorldSet& set) {
    std::string words =
        "a world that is seen and felt" +
        setWords(static_cast<const CallSet&>(set)).substr(std::string_view{"calls of physvib"}.size());
    if (set.hasHands) words += "; the participant drags and tilts it";
    if (set.displayScale > 0.0) words += "; shown at a scale of 1:" + numberText(set.displayScale);
    return words;
}

std::string alternativeWords(const Alternative& one) {
    return inFull(one.name) + (one.levelDb != 0.0 ? " at " + dbWords(one.levelDb) : std::string{});
}

std::string adjustmentWords(const Adjustment& plan) {
    return "; " + plan.alternative + " is set " + rangeWords(plan.leastDb, plan.mostDb) + " in steps of " +
           dbWords(plan.stepDb) + ", " +
           (plan.startsAnywhere ? std::string{"starting anywhere in this range"}
                                : "starting at " + dbWords(plan.startDb));
}

std::string staircaseWords(const StaircasePlan& plan) {
    return "; staircase on " + plan.alternative + ": " + std::to_string(plan.down) + " down, 1 up, " +
           (plan.upRatio != 1.0 ? "steps up " + numberText(plan.upRatio) + " times as large, "
                                : std::string{}) +
           (plan.startsDb.empty()
                ? "starting at " + numberText(plan.startDb)
                : std::to_string(plan.startsDb.size()) +
                      " staircases, each trial of one that is not over, at random, starting at " +
                      joinedWords(plan.startsDb, ", ", numberText)) +
           " dB in steps of " + dbWords(plan.stepDb) + ", halved at each reversal down to " +
           dbWords(plan.leastStepDb) + ", " + rangeWords(plan.leastDb, plan.mostDb) + ", until " +
           std::to_string(plan.reversals) + " reversals (also where a bound holds the level) or " +
           std::to_string(plan.mostTrials) + " trials";
}

std::string questClause(const QuestMethod& plan) {
    return "; QUEST+ on " + plan.alternative + ": psychometric function " +
           std::string(psychometricShapeNames[static_cast<std::size_t>(plan.shape)]) + ", levels " +
           rangeWords(plan.leastDb, plan.mostDb) + " in steps of " + dbWords(plan.stepDb) + ", widths " +
           rangeWords(plan.leastWidthDb, plan.mostWidthDb) + ", lapse rate " + numberText(plan.lapse) +
           ", until " + std::to_string(plan.trials) + " trials" +
           (plan.deviationDb > 0.0
                ? " or a standard deviation of the threshold of " + dbWords(plan.deviationDb)
                : std::string{});
}

std::string roveWords(double db, const Protocol& protocol) {
    const Moved all = movedIn(protocol, true);
    return joinedWords(all, "", [&](const auto& one) {
        const auto& [moved, conditions] = one;
        const std::string where = all.size() > 1 ? " of " + listed(conditions) : std::string{};
        return moved.empty() ? "; each trial" + where + " is stronger or weaker as a whole by up to " +
                                   dbWords(db) + ", at random"
               : isLevelItself(moved)
                   ? "; in each trial" + where + " the call's {level_db} is up to " + numberText(db) +
                         " higher or lower, at random"
                   : "; in each trial" + where + " " + listed(moved) +
                         " is multiplied as a whole by a ratio of up to " + dbWords(db) + " (a factor of " +
                         fixedNumber(fromDecibels(db), 3) + ") up or down, at random";
    });
}

std::string anchorWords(const SessionPlan& session, std::size_t end) {
    return spoken(end < session.anchors.size() ? session.anchors[end] : std::string{usualAnchors[end]});
}

std::string scaleWords(const SessionPlan& session) {
    std::string words = session.points > 0 ? "; scales of " + std::to_string(session.points) + " points: "
                                           : "; scales from 0 to 100: ";
    if (session.scales.empty())
        words += "one of each object, side by side" +
                 (session.reference.empty()
                      ? std::string{}
                      : ", after " + session.reference + " as the reference, which is among them unnamed");
    for (std::size_t i = 0; i < session.scales.size(); ++i)
        words.append(i ? ", " : "")
            .append(session.scales[i])
            .append(i < session.definitions.size() ? " (" + spoken(session.definitions[i]) + ")"
                                                   : std::string{});
    words += ", between " + anchorWords(session, 0) + " and " + anchorWords(session, 1);
    return words + (session.showsNumbers ? ", with their numbers" : "");
}

} // namespace

std::string scoreWords(const SessionPlan& session, const std::string& scale) {
    const auto at =
        static_cast<std::size_t>(std::ranges::find(session.scales, scale) - session.scales.begin());
    return "Rating from " + std::to_string(session.points > 0 ? 1 : 0) + ", " + anchorWords(session, 0) +
           ", to " + std::to_string(session.points > 0 ? session.points : 100) + ", " +
           anchorWords(session, 1) +
           (session.scales.empty()            ? " of " + scale + ", beside others"
            : at < session.definitions.size() ? ": " + session.definitions[at]
                                              : std::string{});
}

std::vector<std::string> protocolSentences(const Protocol& protocol) {
    std::vector<std::string> sentences{
        "Protocol " + protocol.name + (protocol.title.empty() ? std::string{} : ": " + protocol.title) +
            (protocol.title.ends_with('?') ? "" : "."),
        "Every participant is to do each session" +
            (protocol.conditions.size() < 2
                 ? std::string{}
                 : " in each condition; the order of conditions is " +
                       std::string(conditionOrderNames[static_cast<std::size_t>(protocol.conditionOrder)])) +
            "."};
    sentences.push_back(levelChain(protocol, "as planned"));
    if (protocol.hasPinkNoise)
        sentences.push_back("Pink noise of " + dbWords(protocol.pinkNoiseDb) +
                            " of full scale (root mean square) is to mask what can be heard.");
    if (protocol.conditionBreakSeconds > 0.0)
        sentences.push_back("A break of " + secondsWords(protocol.conditionBreakSeconds) +
                            " lies before each condition but the first.");
    sentences.push_back("Limit of a participant's exposure on one day: A(8) of " +
                        numberText(protocol.exposureLimit) + " m/s^2 (ISO 5349-1).");
    if (!protocol.words.empty())
        sentences.push_back(
            "Words of the participant's screens, unless others were chosen: " + protocol.words + ".");
    for (const MaterialPictureFile& picture : protocol.pictures)
        sentences.push_back("Bodies of " + picture.material +
                            " are shown by a picture of the participant's own: " + picture.file + ".");
    if (!protocol.closingQuestion.empty())
        sentences.push_back("In the end, to be answered in one's own words: " +
                            spoken(protocol.closingQuestion));
    return sentences;
}

std::string conditionWords(const ConditionPlan& condition) {
    std::string words = condition.name + (condition.group.empty() ? "" : " (group " + condition.group + ")") +
                        ": " + std::visit([](const auto& set) { return setWords(set); }, condition.stimuli) +
                        "; layout " + condition.layout;
    if (callSetOf(condition.stimuli) == nullptr)
        words += ", " +
                 (condition.isAtResonance ? "the actuators' resonance"
                                          : numberText(condition.frequencyHz) + " Hz") +
                 ", " + numberText(condition.levelG) + " g";
    return words;
}

Moved movedIn(const Protocol& protocol, bool byRove) {
    Moved all;
    for (const ConditionPlan& condition : protocol.conditions) {
        auto names = movedBesideStrength(condition, byRove);
        const auto found = std::ranges::find(all, names, &Moved::value_type::first);
        (found == all.end() ? all.emplace_back(std::move(names), std::vector<std::string>{}) : *found)
            .second.push_back(condition.name);
    }
    return all;
}

bool isLevelItself(const std::vector<std::string>& moved) {
    return std::ranges::find(moved, "level_db") != moved.end();
}

std::string sessionWords(const SessionPlan& session, const Protocol& protocol) {
    const StudyTaskDescription& task = describe(session.task);
    std::string words = session.name;
    const auto isMatch = [](const SessionPlan& s) { return s.answer() == AnswerKind::level; };
    if (session.isTraining) // as takeLevelTrial() has it
        words += isMatch(session) && std::ranges::none_of(
                                         protocol.sessions,
                                         [&](const SessionPlan& s) { return isMatch(s) && !s.isTraining; })
                     ? " (training, counted among levels alone)"
                     : " (training, left out of analyses)";
    words += ": task " + std::string(task.name);
    if (!session.question.empty()) words += ", " + spoken(session.question);
    if (!session.instruction.empty()) words += ", after the page " + spoken(session.instruction);
    words += "; order " + std::string(trialOrderNames[static_cast<std::size_t>(session.order)]);
    if (session.repetitions > 1) words += ", " + std::to_string(session.repetitions) + " repetitions";
    if (session.fewestTouches > 0) words += ", " + std::to_string(session.fewestTouches) + " touches";
    if (session.bothOrders) words += ", both orders of the alternatives";
    if (!session.alternatives.empty())
        words += "; alternatives " + joinedWords(session.alternatives, ", ", alternativeWords) +
                 (session.answer() == AnswerKind::choice && !session.bothOrders ? inRandomOrder : "");
    if (!session.objects.empty()) words += "; objects " + joined(session.objects, ", ") + inRandomOrder;
    if (session.answer() == AnswerKind::scores) words += scaleWords(session);
    if (!session.answers.empty()) words += "; answers " + joined(session.answers, ", ");
    if (session.comparesPairs)
        words += std::string{"; each trial has two of the stimuli, every two of them"} +
                 (session.bothOrders ? "" : inRandomOrder);
    if (session.isOnce) words += "; on the condition as a whole, with nothing felt";
    if (session.adjustment) words += adjustmentWords(*session.adjustment);
    if (session.staircase) words += staircaseWords(*session.staircase);
    if (session.quest) words += questClause(*session.quest);
    if (!session.levelsFrom.empty()) words += "; levels from the session " + session.levelsFrom;
    if (!session.levelsFile.empty()) words += "; levels from the file " + session.levelsFile;
    if (session.leastSeconds > 0.0)
        words += "; at least " + secondsWords(session.leastSeconds) + " with each part before the answer";
    if (session.answerSeconds > 0.0)
        words += "; answers up to " + secondsWords(session.answerSeconds) + " after the last part";
    if (session.intervalSeconds > 0.0)
        words +=
            "; parts are played one after the other, " + secondsWords(session.intervalSeconds) + " apart";
    if (session.givesFeedback) words += "; each answer is followed by whether it was right";
    if (!session.correct.empty()) words += "; " + session.correct + " is right";
    if (session.untilCorrect > 0)
        words += "; until " + std::to_string(session.untilCorrect) + " right answers in a row, or all trials";
    if (session.roveDb > 0.0) words += roveWords(session.roveDb, protocol);
    if (!session.modulus.empty())
        words += "; each trial begins with " + session.modulus + ", which counts as " +
                 numberText(session.modulusNumber);
    if (session.mayBeEmpty) words += "; an answer may be left empty";
    if (session.mostPlays > 0)
        words += "; felt at most " +
                 (session.mostPlays == 1 ? "once" : std::to_string(session.mostPlays) + " times");
    else if (!session.isOnce && session.answer() != AnswerKind::wish)
        words += "; felt as often as one likes";
    if (session.breakBeforeSeconds > 0.0)
        words += "; a break of " + secondsWords(session.breakBeforeSeconds) + " before";
    if (session.breakEvery > 0 && session.breakSeconds > 0.0)
        if (const auto none = withoutBreaks(protocol, session); none.size() < protocol.conditions.size())
            words += "; a break of " + secondsWords(session.breakSeconds) + " every " +
                     std::to_string(session.breakEvery) + " trials" +
                     (none.empty() ? "" : ", none in " + listed(none));
    return words;
}

std::vector<std::string> soundLines(const Protocol& protocol) {
    std::vector<std::string> lines;
    for (const StudySoundFile& sound : protocol.sounds)
        lines.push_back(numberText(sound.frequencyHz) + " Hz: " + sound.file +
                        (sound.file.starts_with("synthetic-") ? " (nobody recorded it)" : ""));
    return lines;
}

// Looks up layouts and their actuator profiles.

namespace {

std::string actuatorWords(const EnchanterDescription& actuator, const std::string& folder) {
    std::string words = numberText(actuator.fullScaleG) + " g, ";
    if (actuator.actuator == "none") return words + "assumed, as it names no actuator profile";
    const auto profile = findActuator(besideProtocol(folder, actuator.actuator));
    const bool isCalibrated = profile && profile.value.fullScaleG &&
                              std::abs(*profile.value.fullScaleG / actuator.fullScaleG - 1.0) < 1e-3;
    return words + (isCalibrated ? "calibrated, as in " : "assumed, as it is not that of ") +
           "the actuator profile " + actuator.actuator;
}

std::string layoutWords(const std::string& name, const std::string& folder) {
    const auto layout = layoutNamed(besideProtocol(folder, name));
    if (!layout) return name + ": not known here";
    std::set<std::string> kinds;
    std::string words;
    for (const EnchanterDescription& actuator : layout.value.enchanters)
        if (const auto [kind, isNew] = kinds.insert(actuatorWords(actuator, folder)); isNew)
            words += (words.empty() ? name + ": " : " and ") + *kind;
    return words;
}

} // namespace

std::string levelChain(const Protocol& protocol, std::string_view samples) {
    std::set<std::string> named;
    std::string words;
    for (const ConditionPlan& condition : protocol.conditions)
        if (named.insert(condition.layout).second)
            words += (words.empty() ? "" : "; ") + layoutWords(condition.layout, protocol.folder);
    return std::string("Levels in g are samples ").append(samples) +
           ", times the full scale that the layout states (" + words +
           "), as if the actuator followed at each frequency: no accelerometer measured them.";
}

} // namespace physvib
