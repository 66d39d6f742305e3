// SPDX-License-Identifier: MIT
// Fuzz target of the protocol reader, and of experiments on whatever it lets through.
#include "Fuzzing.h"
#include "Lab/Files/ProtocolFile.h"
#include "Lab/Files/TrialLog.h"
#include "Lab/Study/Experiment.h"
#include "Lab/Study/SimulatedObserver.h"

namespace {
using namespace physvib;

void tryExperiment(const Protocol& protocol) {
    const Participant participant;
    Experiment experiment{protocol, participant};
    const SimulatedObserver observer{{}, protocol, participant};
    std::string text = trialHeader(protocol, participant, "0");
    for (int i = 0; i < 20 && !experiment.isDone(); ++i) {
        const Answer answer = observer.answer(experiment);
        fuzz::demand(experiment.answerError(answer).empty(), "the observer's answer is refused",
                     experiment.answerError(answer));
        text += trialRow(protocol, participant, experiment.acceptAnswer(answer));
    }
    const auto log = readTrialLog(text, "f", protocol, participant);
    fuzz::demand(static_cast<bool>(log), "its trials cannot be read", log.error);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (const auto protocol = fuzz::tried(data, size, readProtocol, protocolJson)) tryExperiment(*protocol);
    return 0;
}
