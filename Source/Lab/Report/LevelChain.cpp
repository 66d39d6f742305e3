// SPDX-License-Identifier: MIT
// Looks up layouts and their actuator profiles.
#include "Lab/Report/LevelChain.h"
#include "Io/Text/NumberText.h"
#include "Lab/Files/ProtocolFile.h"
#include "Scene/ActuatorFile.h"
#include "Scene/LayoutNamed.h"
#include <cmath>
#include <set>

namespace physvib {
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
