// SPDX-License-Identifier: GPL-3.0-or-later
// Renders stimulus jobs directly; calls in text form are parsed with the program's option tables first.
#include "Studies/StudyCalls.h"
#include "Calls/CallOptions.h"
#include "Calls/LoadedRender.h"
#include "Core/Units.h"
#include "Lab/Files/ProtocolFile.h"
#include "Lab/Study/Stimulus.h"
#include "Lab/Study/StudyRun.h"
#include "Live/Session/SessionRender.h"
#include "Options/OptionTable.h"
#include "Scene/EventsCsv.h"
#include <algorithm>
#include <functional>
#include <set>

namespace physvib {
namespace {

/// Loads scene or events, and layout, of the job for live playback; empty, or one error line.
std::string prepareScene(const RenderJob& o, LoadedRender& job) {
    if (o.actuator != "none") return "--actuator is not yet felt here, only rendered";
    if (!o.coupling.empty()) return "--coupling is not yet felt here, only rendered";
    if (auto fault = sceneFault(o); !fault.empty()) return fault;
    auto layout = layoutNamed(o.layout);
    if (!layout) return layout.error;
    job.layout = std::move(layout.value);
    if (!o.fromEvents.empty()) {
        auto list = loadEventsCsv(o.fromEvents);
        job.made.events = std::move(list.value.events);
        job.listField = list.value.field;
        job.listNames = std::move(list.value.names);
        return list.error;
    }
    if (o.scene.empty()) return "expected a scene, or --from-events";
    auto scene = findScene(o.scene, o.settings);
    if (!scene) return scene.error;
    job.scene = std::move(scene.value);
    return {};
}

Result<FeltStimulus> ofScene(const RenderJob& o) {
    LoadedRender job{o, {}, {}, {}, {}};
    if (auto fault = prepareScene(o, job); !fault.empty()) return Failure{fault};
    Patience patience{Patience::usualSeconds}; // fixed, since the call may be untrusted
    if (job.scene) job.made = runScene(*job.scene, job.run(), job.endNs(), std::ref(patience));
    if (auto fault = patience.fault(); !fault.empty()) return Failure{fault};
    EventShaper{job.shaping()}.shape(job.made.events);
    if (auto fault = takeRecordings(job, job.made.events, o.scene); !fault.empty()) return Failure{fault};
    return FeltStimulus{{job.made.events, job.panner(), job.seconds()},
                        job.layout,
                        std::vector<float>(job.layout.enchanters.size(), 1.0f),
                        job.feltRecordings()};
}

Result<FeltWorld> asWorld(const RenderJob& o) {
    LoadedRender job{o, {}, {}, {}, {}};
    if (auto fault = prepareScene(o, job); !fault.empty()) return Failure{fault};
    if (!job.scene) return Failure{"expected a scene, found events, which nobody can see"};
    if (auto fault = fixedLevelFault(job); !fault.empty()) return Failure{fault};
    if (auto fault = takeRecordings(job, soundsOf(*job.scene), o.scene); !fault.empty())
        return Failure{fault};
    return FeltWorld{sessionSetup(job), job.layout, job.seconds()};
}

Result<FeltStimulus> ofStimulus(const StimulusJob& job, int sampleRateHz) {
    const auto layout = layoutNamed(job.layout);
    if (!layout) return Failure{layout.error};
    if (auto fault = layoutFault(job, layout.value); !fault.empty()) return Failure{fault};
    if (const auto* const phantom = std::get_if<PhantomJob>(&job.what);
        phantom != nullptr && !phantom->recording.empty())
        return Failure{"a recording is rendered to a file; a live session plays events"};
    auto stimulus = makeStimulus(job, layout.value);
    if (!stimulus) return Failure{stimulus.error};
    if (const auto sound = renderStimulus(stimulus.value, layout.value, sampleRateHz); !sound)
        return Failure{sound.error};
    FeltStimulus felt{std::move(stimulus.value), layout.value, {}, {}};
    for (const auto& enchanter : layout.value.enchanters)
        felt.gains.push_back(static_cast<float>(1.0 / enchanter.fullScaleG));
    return felt;
}

Result<FeltStimulus> felt(StimulusJob job, int sampleRateHz, const std::string& folder) {
    if (const JobFault fault = faultOf(job)) return Failure{fault.words()};
    if (auto fault = linkFault(folder, job.layout); !fault.empty()) return Failure{fault};
    job.layout = besideProtocol(folder, job.layout);
    return ofStimulus(job, sampleRateHz);
}

/// A parsed call; `error` is set if it is invalid.
struct ParsedCall {
    ParsedCall(const std::string& call, const std::string& folder) {
        declareRenderOptions(render, renderOptions);
        declareStimulus(stimulus, stimulusOptions);
        error = writtenWordFault(call);
        if (error.empty()) error = parseText(words, call).fault;
        if (error.empty()) error = linkOfCallFault(words, folder);
        if (error.empty()) findFiles(folder);
    }
    /// Prefers files in `folder`, if they exist.
    void findFiles(const std::string& folder) {
        for (std::string* path : {&renderOptions.layout, &renderOptions.scene, &renderOptions.fromEvents,
                                  &stimulusOptions.job.layout})
            *path = besideProtocol(folder, *path);
        for (RecordedSound& sound : renderOptions.sounds) sound.path = besideProtocol(folder, sound.path);
    }
    OptionTable words{"physvib", {}};
    RenderJob renderOptions;
    StimulusOptions stimulusOptions;
    OptionTable& render = words.addCommand("render", {});
    OptionTable& stimulus = words.addCommand("stimulus", {});
    std::string error;
};

Result<FeltStimulus> felt(const WrittenCall& call, int sampleRateHz, const std::string& folder) {
    ParsedCall parsed{call.words, folder};
    if (!parsed.error.empty()) return Failure{parsed.error};
    if (parsed.words.isCalled("render")) return ofScene(parsed.renderOptions);
    const auto job = readStimulus(parsed.stimulus, parsed.stimulusOptions);
    return job ? ofStimulus(job.value, sampleRateHz) : Failure{job.error};
}

/// The condition's layout is displayed and reported, the call's layout plays. Empty, or an error if unequal.
std::string layoutDifference(const ParsedCall& parsed, const ConditionPlan& condition,
                             const std::string& folder) {
    const std::string& felt =
        parsed.words.isCalled("render") ? parsed.renderOptions.layout : parsed.stimulusOptions.job.layout;
    if (felt == besideProtocol(folder, condition.layout)) return {};
    return "--layout: expected the condition's own layout, " + printable(condition.layout) + ", found " +
           printable(felt);
}

/// Empty, or an error of a call: invalid options, a layout other than the condition's, or a fixed level that
/// its layout cannot reach without the limiter.
std::string studyCallFault(const std::string& call, const ConditionPlan& condition,
                           const std::string& folder) {
    ParsedCall parsed{call, folder};
    const RenderJob& o = parsed.renderOptions;
    if (!parsed.error.empty()) return call + ": " + parsed.error;
    if (auto fault = layoutDifference(parsed, condition, folder); !fault.empty()) return fault;
    if (!parsed.words.isCalled("render") || !sceneFault(o).empty()) return {};
    if (!o.scene.empty())
        if (const auto scene = findScene(o.scene, o.settings); !scene) return call + ": " + scene.error;
    if (!o.method.fixesAmplitude) return {};
    const auto layout = layoutNamed(o.layout);
    if (!layout) return layout.error;
    const double leastG = leastStudyFullScaleG * fromDecibels(o.levelDb);
    for (const EnchanterDescription& enchanter : layout.value.enchanters)
        if (enchanter.fullScaleG < leastG)
            return "--method " + o.methodName() + ": expected enchanters of at least " +
                   fixedNumber(leastG, 2) +
                   " g (full_scale_g), as 1.5 g and 1 dB of headroom are felt, found " +
                   fixedNumber(enchanter.fullScaleG, 2) + " g";
    return {};
}

/// Checks a condition's calls: each value of each factor once, combined with the first values of the others,
/// for each part.
/// The reader has already checked all calls for forbidden options.
std::string firstCallsFault(const Protocol& protocol, const ConditionPlan& condition) {
    const CallSet* const calls = callSetOf(condition.stimuli);
    if (calls == nullptr) return {};
    StimulusItem first;
    for (const StudyFactor& factor : calls->factors)
        first.values.emplace_back(factor.name, factor.values.front());
    std::vector<StimulusItem> items{first};
    for (std::size_t f = 0; f < calls->factors.size(); ++f)
        for (const std::string& value : calls->factors[f].values)
            items.emplace_back(first).values[f].second = value;
    std::set<std::string> told; // parts may share a call
    for (const StimulusItem& item : items)
        for (const std::string& part : callPartsOf(protocol))
            if (const std::string call = callOf(*calls, item, part, 0.0); told.insert(call).second)
                if (auto fault = studyCallFault(call, condition, protocol.folder); !fault.empty())
                    return fault;
    return {};
}

} // namespace

Result<Protocol> protocolNamed(const std::string& nameOrPath) {
    auto protocol = findProtocol(nameOrPath);
    for (std::size_t i = 0; i < protocol.value.conditions.size(); ++i)
        if (const auto fault = firstCallFault(protocol.value, protocol.value.conditions[i], writtenWordFault);
            !fault.empty())
            return Failure{nameOrPath + ": conditions[" + std::to_string(i) + "].call: " + fault};
    return protocol;
}

std::string protocolFault(const Protocol& protocol, const std::string& name) {
    if (!isStudyCode(protocol.name))
        return name + ": name: expected letters, digits, - and _, as files are called after it";
    for (const ConditionPlan& condition : protocol.conditions) {
        const auto layout = layoutNamed(besideProtocol(protocol.folder, condition.layout));
        if (!layout) return name + ": condition " + printable(condition.name) + ": " + layout.error;
        if (auto fault = firstCallsFault(protocol, condition); !fault.empty())
            return name + ": condition " + condition.name + ": call: " + fault;
        const auto* patterns = std::get_if<PatternSet>(&condition.stimuli);
        if (patterns && patterns->enchanters != layout.value.geometry.count)
            return name + ": condition " + printable(condition.name) +
                   ": expected as many enchanters as the layout has (" +
                   std::to_string(layout.value.geometry.count) + "), found " +
                   std::to_string(patterns->enchanters);
    }
    return {};
}

Result<FeltStimulus> feltStimulus(const TrialJob& job, int sampleRateHz, const std::string& folder) {
    return std::visit(
        [&](const auto& one) -> Result<FeltStimulus> {
            auto made = felt(one, sampleRateHz, folder);
            if (!made) return Failure{textOf(one) + ": " + made.error};
            return made;
        },
        job);
}

Result<FeltWorld> feltWorld(const WrittenCall& call, const std::string& folder) {
    ParsedCall parsed{call.words, folder};
    auto made = parsed.error.empty() ? asWorld(parsed.renderOptions) : Failure{parsed.error};
    if (!made) return Failure{call.words + ": " + made.error};
    return made;
}

} // namespace physvib
