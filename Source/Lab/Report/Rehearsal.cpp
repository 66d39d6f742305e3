// SPDX-License-Identifier: MIT
// The same rows as `study run` writes.
#include "Lab/Report/Rehearsal.h"
#include "Lab/Files/ProtocolFile.h"
#include "Lab/Files/TrialLog.h"
#include "Lab/Study/SimulatedObserver.h"

namespace physvib {

ReportTrials rehearse(const std::string& name, const std::string& observer, int participants) {
    const Protocol protocol = findProtocol(name).value;
    std::vector<std::pair<std::string, std::string>> texts;
    for (int number = 1; number <= participants; ++number) {
        const std::string code = (number < 10 ? "P0" : "P") + std::to_string(number);
        const Participant participant{code, number, observer};
        Experiment experiment{protocol, participant};
        const SimulatedObserver answering{*observerNamed(observer), protocol, participant};
        std::string text = trialHeader(protocol, participant, PHYSVIB_VERSION);
        while (!experiment.isDone())
            text += trialRow(protocol, participant, experiment.take(answering.answer(experiment)));
        texts.emplace_back(name + "-" + code + ".csv", std::move(text));
    }
    return readReportTrials(texts, {}, protocol).value;
}

} // namespace physvib
