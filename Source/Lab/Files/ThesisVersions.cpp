// SPDX-License-Identifier: MIT
// Applies the edit of each deviation; deviations without an edit remain deviations of the edited version.
#include "Lab/Files/ThesisVersions.h"
#include "Lab/Files/ProtocolFile.h"
#include <algorithm>

namespace physvib {
namespace {

/// Appends these options to all calls of the protocol.
void addToCalls(Protocol& protocol, std::string_view options) {
    for (ConditionPlan& condition : protocol.conditions)
        std::visit(
            [options](auto& set) {
                if constexpr (requires { set.call; }) set.call.append(" ").append(options);
            },
            condition.stimuli);
}

void edit(Protocol& protocol, ThesisEdit how) {
    switch (how) {
    case ThesisEdit::none: break;
    case ThesisEdit::noBreakBefore:
        for (SessionPlan& session : protocol.sessions) session.breakBeforeSeconds = 0.0;
        break;
    case ThesisEdit::noGroups:
        for (ConditionPlan& condition : protocol.conditions) condition.group.clear();
        break;
    case ThesisEdit::releaseTiming: addToCalls(protocol, "--timing release"); break;
    case ThesisEdit::cutDecays: addToCalls(protocol, "--gamma 0.1"); break;
    }
}

std::vector<Protocol> makeVersions() {
    std::vector<Protocol> versions;
    for (Protocol protocol : builtInProtocols()) {
        const Protocol builtIn = protocol;
        for (const ThesisDeviation& one : thesisDeviations)
            if (one.protocol == builtIn.name) edit(protocol, one.edit);
        if (protocol == builtIn) continue;
        protocol.name.append(thesisSuffix);
        protocol.title += ", as published";
        versions.push_back(std::move(protocol));
    }
    return versions;
}

} // namespace

const std::vector<Protocol>& thesisVersions() {
    static const std::vector<Protocol> versions = makeVersions();
    return versions;
}

} // namespace physvib
