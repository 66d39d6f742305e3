// SPDX-License-Identifier: GPL-3.0-or-later
// Experiment and trial file, step by step together.
#include "CommandLine/Study/StudyRun.h"
#include "CommandLine/Study/CallFiles.h"
#include "CommandLine/Study/CallStimulus.h"
#include "CommandLine/Render/LayoutNamed.h"
#include "Files/Disk/AtomicFile.h"
#include "Files/ProtocolFile.h"
#include "Files/Text/NumberText.h"
#include <algorithm>
#include <juce_core/juce_core.h>

namespace physvib {

bool isStudyCode(const std::string& code) noexcept {
    const auto isPlain = [](char c) { return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '-' || c == '_'; };
    return code.size() <= 32 && std::ranges::all_of(code, isPlain);
}

namespace {

/// The words of a condition's calls: each value of each factor once, with the first of the others. The reader has looked at all of them for
/// what no call may do.
std::string firstCallsFault(const Protocol& protocol, const ConditionPlan& condition) {
    const CallSet* const calls = callSetOf(condition.stimuli);
    if (calls == nullptr) return {};
    StimulusItem first;
    for (const StudyFactor& factor : calls->factors) first.values.emplace_back(factor.name, factor.values.front());
    for (std::size_t f = 0; f < calls->factors.size(); ++f)
        for (const std::string& value : calls->factors[f].values) {
            StimulusItem item = first;
            item.values[f].second = value;
            const std::string call = callOf(*calls, item, *callPartsOf(protocol).begin(), "0");
            if (auto fault = wordsFault(call); !fault.empty()) return fault;
            if (auto fault = studyLevelFault(call, protocol.folder); !fault.empty()) return fault;
        }
    return {};
}

/// By this machine's calendar: exposure is counted by the day.
bool wasWrittenToday(const std::filesystem::path& path) {
    const auto dayOf = [](juce::Time time) { return std::pair{time.getYear(), time.getDayOfYear()}; };
    const juce::File file{juce::File::getCurrentWorkingDirectory().getChildFile(juce::String::fromUTF8(path.string().c_str()))};
    return file.existsAsFile() && dayOf(file.getLastModificationTime()) == dayOf(juce::Time::getCurrentTime());
}

} // namespace

Result<Protocol> protocolNamed(const std::string& nameOrPath) {
    auto protocol = findProtocol(nameOrPath);
    for (std::size_t i = 0; i < protocol.value.conditions.size(); ++i)
        if (const auto fault = firstCallFault(protocol.value, protocol.value.conditions[i], writtenWordFault); !fault.empty())
            return Failure{nameOrPath + ": conditions[" + std::to_string(i) + "].call: " + fault};
    return protocol;
}

std::string protocolFault(const Protocol& protocol, const std::string& name) {
    if (!isStudyCode(protocol.name)) return name + ": name: expected letters, digits, - and _, as files are called after it";
    for (const ConditionPlan& condition : protocol.conditions) {
        const auto layout = layoutNamed(besideProtocol(protocol.folder, condition.layout));
        if (!layout) return name + ": condition " + printable(condition.name) + ": " + layout.error;
        if (auto fault = firstCallsFault(protocol, condition); !fault.empty()) return name + ": condition " + condition.name + ": call: " + fault;
        const auto* patterns = std::get_if<PatternSet>(&condition.stimuli);
        if (patterns && patterns->enchanters != layout.value.geometry.count)
            return name + ": condition " + printable(condition.name) + ": expected as many enchanters as the layout has (" + std::to_string(layout.value.geometry.count) + "), found " +
                   std::to_string(patterns->enchanters);
    }
    return {};
}

std::filesystem::path trialFile(const std::filesystem::path& folder, const Protocol& protocol, const Participant& participant) {
    return folder / (protocol.name + "-" + participant.code + ".csv");
}

StudyRun::StudyRun(const std::filesystem::path& folder, Protocol protocol, Participant participant)
    : protocol_{std::move(protocol)}
    , participant_{std::move(participant)}
    , path_{trialFile(folder, protocol_, participant_)}
    , isOfToday_{wasWrittenToday(path_)}
    , log_{path_, protocol_, participant_, PHYSVIB_VERSION}
    , experiment_{protocol_, participant_, participant_.observer == Participant{}.observer}
    , error_{log_.error()} {
    if (!error_.empty()) return;
    for (const TrialRecord& record : log_.records()) {
        const std::string fault = experiment_.redo(record);
        if (fault.empty()) continue;
        error_ = path_.string() + ": session " + printable(protocol_.sessions[record.trial.session].name) + ", trial " + std::to_string(record.trial.number) + ": " + fault;
        return;
    }
    before_ = experiment_.trialsTaken();
    if (isOfToday_ && before_ > 0) exposureToday_ = log_.records().back().answer.exposure.value_or(0.0);
}

std::string StudyRun::keepComment(const std::string& words) const {
    AtomicFile file{std::filesystem::path{path_}.replace_extension(".comment.txt")};
    file.write(protocol_.closingQuestion + "\n\n" + words + "\n");
    return file.error().empty() ? file.commit() : file.error();
}

bool StudyRun::take(Answer answer) {
    if (!error_.empty()) return false;
    if (const std::string fault = experiment_.refusal(answer); !fault.empty()) return error_ = fault, false;
    if (!log_.append(experiment_.take(std::move(answer))) || (experiment_.isDone() && !log_.sync())) error_ = log_.error();
    return error_.empty();
}

} // namespace physvib
