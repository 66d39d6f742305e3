// SPDX-License-Identifier: MIT
// Studies as an observer answers them, their trial files, a text as a reader's file, and examples of the
// pages.
#pragma once
#include "Lab/Files/ProtocolFile.h"
#include "Lab/Files/StudyCsv.h"
#include "Lab/Files/TrialLog.h"
#include "Lab/Study/SimulatedObserver.h"
#include "TestPlaces.h"
#include <numeric>

namespace physvib {

/// All trials of a study, as that observer answers them.
inline std::vector<TrialRecord> answered(const Protocol& protocol, const Participant& participant = {},
                                         const ObserverSettings& settings = {}) {
    Experiment experiment{protocol, participant};
    const SimulatedObserver observer{settings, protocol, participant};
    std::vector<TrialRecord> records;
    while (!experiment.isDone()) records.push_back(experiment.acceptAnswer(observer.answer(experiment)));
    return records;
}

/// The file of these trials.
inline std::string trialFile(const Protocol& protocol, const Participant& participant,
                             const std::vector<TrialRecord>& records, std::string_view version = "0") {
    std::string text = trialHeader(protocol, participant, version);
    for (const TrialRecord& record : records) text += trialRow(protocol, participant, record);
    return text;
}

/// What a reader finds in a file of that text.
template <class Read>
auto readOne(Read read, std::string_view text, std::string_view name = "f.csv") {
    const NamedText file{text, name};
    return read(std::span{&file, 1});
}

/// An example of the pages.
inline Protocol example(const std::string& name) {
    return loadProtocol(PHYSVIB_SOURCE_DIR "/Docs/protocol-examples/" + name + ".json").value;
}

/// What a staircase has come to: mean level of the later half of its two or more reversals.
inline double thresholdDb(const Staircase& stairs) {
    const auto& reversals = stairs.reversals();
    const auto first = reversals.begin() + static_cast<std::ptrdiff_t>(reversals.size() / 2);
    return std::accumulate(first, reversals.end(), 0.0) / static_cast<double>(reversals.end() - first);
}

} // namespace physvib
