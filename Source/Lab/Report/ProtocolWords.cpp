// SPDX-License-Identifier: MIT
// Writes the fields of a protocol by the table of Lab/Files/ProtocolFields.h, with their defaults.
#include "Io/Text/NumberText.h"
#include "Lab/Files/ProtocolFields.h"
#include "Lab/Files/ProtocolFile.h"
#include "Lab/Report/ReportBuilder.h"
#include "Scene/ActuatorFile.h"
#include "Scene/LayoutFile.h"
#include <cmath>
#include <set>
#include <type_traits>

namespace physvib {
namespace {

std::string typographicQuotes(const std::string& words) { return "\u201c" + words + "\u201d"; }

// Fields that are omitted: without information, or shown elsewhere on the page.
bool isOmitted(const auto&, std::string_view) { return false; }
bool isOmitted(const Protocol& p, std::string_view name) {
    return name == "seed" || name == "conditions" || name == "sessions" ||
           (name == "pink_noise_db" && !p.hasPinkNoise);
}
bool isOmitted(const ConditionPlan& c, std::string_view name) {
    const bool isOfStimulus = name == "frequency_hz" || name == "at_resonance" || name == "level_g";
    return name == "name" || name == "observer_blur" || (isOfStimulus && findCalls(c.stimuli) != nullptr) ||
           (name == "frequency_hz" && c.isAtResonance);
}
bool isOmitted(const SessionPlan& s, std::string_view name) {
    return name == "name" || (name == "modulus_number" && s.modulus.empty());
}
bool isOmitted(const StaircasePlan& s, std::string_view name) {
    return name == "start_db" && !s.startsDb.empty();
}
bool isOmitted(const Adjustment& a, std::string_view name) { return name == "start_db" && a.hasRandomStart; }

template <class T>
std::string fieldText(const T& object);

/// Text of a field's value; a field with an empty text is omitted.
std::string valueText(bool value) { return value ? "yes" : ""; }
std::string valueText(const std::string& value) { return value; }
template <class Number>
requires std::is_arithmetic_v<Number> std::string valueText(Number value) {
    return numberText(static_cast<double>(value));
}
template <class T>
requires requires(int visitor) { visitFields(visitor, FieldsOf<T>{}); }
std::string valueText(const T& value) { return "(" + fieldText(value) + ")"; }
template <class T>
std::string valueText(const std::vector<T>& values) {
    std::string words;
    for (const T& value : values) words.append(words.empty() ? "" : " | ").append(valueText(value));
    return words;
}
template <class T>
std::string valueText(const std::optional<T>& value) {
    return value ? valueText(*value) : std::string{};
}
template <class T>
struct FieldTextWriter {
    const T& object;
    std::string words{};
    void add(std::string_view name, const std::string& value) {
        if (!value.empty() && !isOmitted(object, name))
            words.append(words.empty() ? "" : "; ").append(name).append(" ").append(value);
    }
    template <class F>
    void field(std::string_view name, F T::*member, const Bounds&, Need) {
        const F& value = object.*member;
        if constexpr (std::is_arithmetic_v<F>) { // 0 means none, except in methods
            constexpr bool isMethod = std::is_same_v<T, Adjustment> || std::is_same_v<T, StaircasePlan> ||
                                      std::is_same_v<T, QuestMethod>;
            if (!isMethod && value == F{}) return;
        }
        const bool isSentence = name == "question" || name == "instruction" || name == "closing_question";
        if constexpr (std::is_same_v<F, std::string>)
            if (isSentence && !value.empty()) return add(name, typographicQuotes(value));
        add(name, valueText(value));
    }
    template <class E>
    void choice(std::string_view name, E T::*member, const auto& names) {
        add(name, std::string(names[static_cast<std::size_t>(object.*member)]));
    }
    template <class Variant>
    void variant(std::string_view name, Variant T::*member, const auto& names) {
        add(name, std::string(names[(object.*member).index()]) + "; " +
                      std::visit([](const auto& kind) { return fieldText(kind); }, object.*member));
    }
};

template <class T>
std::string fieldText(const T& object) {
    FieldTextWriter<T> writer{object};
    visitFields(writer, FieldsOf<T>{});
    return writer.words;
}

std::string anchorText(const SessionPlan& session, std::size_t end) {
    return typographicQuotes(end < session.anchors.size() ? session.anchors[end]
                                                          : std::string{defaultAnchors[end]});
}

} // namespace

std::string scoreText(const SessionPlan& session, const std::string& scale) {
    const auto at =
        static_cast<std::size_t>(std::ranges::find(session.scales, scale) - session.scales.begin());
    return "Rating from " + std::to_string(session.points > 0 ? 1 : 0) + ", " + anchorText(session, 0) +
           ", to " + std::to_string(session.points > 0 ? session.points : 100) + ", " +
           anchorText(session, 1) +
           (session.scales.empty()            ? " of " + scale + ", beside others"
            : at < session.definitions.size() ? ": " + session.definitions[at]
                                              : std::string{});
}

std::string protocolText(const Protocol& protocol) { return fieldText(protocol); }

std::string conditionText(const ConditionPlan& condition) {
    return condition.name + ": " + fieldText(condition);
}

std::string sessionText(const SessionPlan& session) {
    const bool hasDefaultAnchors = session.answerKind() == AnswerKind::scores && session.anchors.empty();
    return session.name + ": " + fieldText(session) +
           (hasDefaultAnchors
                ? "; anchors " + std::string{defaultAnchors[0]} + " | " + std::string{defaultAnchors[1]}
                : "");
}

// Looks up layouts and their actuator profiles.

namespace {

std::string fullScaleText(const ActuatorDescription& actuator, const std::string& folder) {
    std::string words = numberText(actuator.fullScaleG) + " g, ";
    if (actuator.actuator == "none") return words + "assumed";
    const auto profile = findActuator(resolveProtocolPath(folder, actuator.actuator));
    const bool isCalibrated = profile && profile.value.fullScaleG &&
                              std::abs(*profile.value.fullScaleG / actuator.fullScaleG - 1.0) < 1e-3;
    return words + (isCalibrated ? "calibrated, as in " : "assumed, not as in ") + "the actuator profile " +
           actuator.actuator;
}

std::string layoutText(const std::string& name, const std::string& folder) {
    const auto layout = resolveLayout(resolveProtocolPath(folder, name));
    if (!layout) return name + ": not known here";
    std::set<std::string> kinds;
    std::string words;
    for (const ActuatorDescription& actuator : layout.value.actuators)
        if (const auto [kind, isNew] = kinds.insert(fullScaleText(actuator, folder)); isNew)
            words += (words.empty() ? name + ": " : " and ") + *kind;
    return words;
}

} // namespace

std::string fullScales(const Protocol& protocol) {
    std::set<std::string> seenLayouts;
    std::string words;
    for (const ConditionPlan& condition : protocol.conditions)
        if (seenLayouts.insert(condition.layout).second)
            words += (words.empty() ? "" : "; ") + layoutText(condition.layout, protocol.folder);
    return words;
}

} // namespace physvib
