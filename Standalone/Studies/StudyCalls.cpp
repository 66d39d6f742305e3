// SPDX-License-Identifier: GPL-3.0-or-later
// Renders stimulus jobs directly; calls in text form are parsed with the program's option tables first.
#include "Studies/StudyCalls.h"
#include "Calls/CallOptions.h"
#include "Calls/LoadedRender.h"
#include "Core/Units.h"
#include "Lab/Files/ProtocolFile.h"
#include "Lab/Study/StimulusJob.h"
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
std::string loadSceneAndLayout(const RenderJob& o, LoadedRender& job) {
    if (o.actuator != "none") return "--actuator is not yet felt here, only rendered";
    if (!o.coupling.empty()) return "--coupling is not yet felt here, only rendered";
    if (auto error = sceneOptionsError(o); !error.empty()) return error;
    auto layout = resolveLayout(o.layout);
    if (!layout) return layout.error;
    job.layout = std::move(layout.value);
    if (!o.fromEvents.empty()) {
        auto list = loadEventsCsv(o.fromEvents);
        job.collisions.events = std::move(list.value.events);
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

Result<PlayableStimulus> stimulusFromScene(const RenderJob& o) {
    LoadedRender job{o, {}, {}, {}, {}};
    if (auto error = loadSceneAndLayout(o, job); !error.empty()) return Failure{error};
    SimulationTimeLimit timeLimit{SimulationTimeLimit::defaultSeconds}; // the call may be hostile
    if (job.scene)
        job.collisions = simulateScene(*job.scene, job.settings(), job.endNs(), std::ref(timeLimit));
    if (auto error = timeLimit.error(); !error.empty()) return Failure{error};
    EventShaper{job.shaping()}.shape(job.collisions.events);
    if (auto error = loadNamedRecordings(job, job.collisions.events, o.scene); !error.empty())
        return Failure{error};
    return PlayableStimulus{{job.collisions.events, job.panner(), job.seconds()},
                            job.layout,
                            std::vector<float>(job.layout.actuators.size(), 1.0f),
                            job.playedRecordings()};
}

Result<PlayableWorld> worldFromJob(const RenderJob& o) {
    LoadedRender job{o, {}, {}, {}, {}};
    if (auto error = loadSceneAndLayout(o, job); !error.empty()) return Failure{error};
    if (!job.scene) return Failure{"expected a scene, found events, which nobody can see"};
    if (auto error = fixedLevelError(job); !error.empty()) return Failure{error};
    if (auto error = loadNamedRecordings(job, materialSounds(*job.scene), o.scene); !error.empty())
        return Failure{error};
    return PlayableWorld{sessionSetup(job), job.layout, job.seconds()};
}

Result<PlayableStimulus> stimulusFromJob(const StimulusJob& job, int sampleRateHz,
                                         const std::string& folder) {
    auto layout = resolveLayout(job.layout);
    if (!layout) return Failure{layout.error};
    for (ActuatorDescription& actuator : layout.value.actuators) // its profile tells the resonance
        actuator.actuator = resolveProtocolPath(folder, actuator.actuator);
    if (auto error = layoutError(job, layout.value); !error.empty()) return Failure{error};
    if (const auto* const phantom = std::get_if<PhantomJob>(&job.stimulus);
        phantom != nullptr && !phantom->recording.empty())
        return Failure{"a recording is rendered to a file; a live session plays events"};
    auto stimulus = makeStimulus(job, layout.value);
    if (!stimulus) return Failure{stimulus.error};
    if (const auto sound = renderStimulus(stimulus.value, layout.value, sampleRateHz); !sound)
        return Failure{sound.error};
    PlayableStimulus result{std::move(stimulus.value), layout.value, {}, {}};
    for (const auto& actuator : layout.value.actuators)
        result.gains.push_back(static_cast<float>(1.0 / actuator.fullScaleG));
    return result;
}

Result<PlayableStimulus> makePlayable(StimulusJob job, int sampleRateHz, const std::string& folder) {
    if (const JobError error = jobError(job)) return Failure{error.text()};
    if (auto error = linkError(folder, job.layout); !error.empty()) return Failure{error};
    job.layout = resolveProtocolPath(folder, job.layout);
    return stimulusFromJob(job, sampleRateHz, folder);
}

/// A parsed call; `error` is set if it is invalid.
struct ParsedCall {
    ParsedCall(const std::string& call, const std::string& folder) {
        declareRenderOptions(render, renderOptions);
        declareStimulus(stimulus, stimulusOptions);
        error = outputOptionError(call);
        if (error.empty()) error = parseText(program, call).error;
        if (error.empty()) error = callLinkError(program, folder);
        if (error.empty()) findFiles(folder);
    }
    /// Prefers files in `folder`, if they exist.
    void findFiles(const std::string& folder) {
        for (std::string* path : {&renderOptions.layout, &renderOptions.scene, &renderOptions.fromEvents,
                                  &stimulusOptions.job.layout})
            *path = resolveProtocolPath(folder, *path);
        for (RecordedSound& sound : renderOptions.sounds)
            sound.path = resolveProtocolPath(folder, sound.path);
    }
    OptionTable program{"physvib", {}};
    RenderJob renderOptions;
    StimulusOptions stimulusOptions;
    OptionTable& render = program.addCommand("render", {});
    OptionTable& stimulus = program.addCommand("stimulus", {});
    std::string error;
};

Result<PlayableStimulus> makePlayable(const ResolvedCall& call, int sampleRateHz, const std::string& folder) {
    ParsedCall parsed{call.words, folder};
    if (!parsed.error.empty()) return Failure{parsed.error};
    if (parsed.program.isCalled("render")) return stimulusFromScene(parsed.renderOptions);
    const auto job = readStimulus(parsed.stimulus, parsed.stimulusOptions);
    return job ? stimulusFromJob(job.value, sampleRateHz, folder) : Failure{job.error};
}

/// An error if the call's layout, which plays, is not the condition's, which is displayed; else empty.
std::string layoutMismatch(const ParsedCall& parsed, const ConditionPlan& condition,
                           const std::string& folder) {
    const std::string& callLayout =
        parsed.program.isCalled("render") ? parsed.renderOptions.layout : parsed.stimulusOptions.job.layout;
    if (callLayout == resolveProtocolPath(folder, condition.layout)) return {};
    return "--layout: expected the condition's own layout, " + printable(condition.layout) + ", found " +
           printable(callLayout);
}

/// Empty, or an error of a call: invalid options, a layout other than the condition's, or a fixed level that
/// its layout cannot reach without the limiter.
std::string studyCallError(const std::string& call, const ConditionPlan& condition,
                           const std::string& folder) {
    ParsedCall parsed{call, folder};
    const RenderJob& o = parsed.renderOptions;
    if (!parsed.error.empty()) return call + ": " + parsed.error;
    if (auto error = layoutMismatch(parsed, condition, folder); !error.empty()) return error;
    if (!parsed.program.isCalled("render") || !sceneOptionsError(o).empty()) return {};
    if (!o.scene.empty())
        if (const auto scene = findScene(o.scene, o.settings); !scene) return call + ": " + scene.error;
    if (!o.method.fixesAmplitude) return {};
    const auto layout = resolveLayout(o.layout);
    if (!layout) return layout.error;
    const double minG = minStudyFullScaleG * fromDecibels(o.levelDb);
    for (const ActuatorDescription& actuator : layout.value.actuators)
        if (actuator.fullScaleG < minG)
            return "--method " + o.methodName() + ": expected enchanters of at least " +
                   fixedNumber(minG, 2) +
                   " g (full_scale_g), as 1.5 g and 1 dB of headroom are felt, found " +
                   fixedNumber(actuator.fullScaleG, 2) + " g";
    return {};
}

/// Checks a condition's calls: each value of each factor once, with the first values of the others, for each
/// part. The reader has already checked all calls for forbidden options.
std::string firstCallsError(const Protocol& protocol, const ConditionPlan& condition) {
    const CallSet* const calls = findCalls(condition.stimuli);
    if (calls == nullptr) return {};
    StimulusItem firstItem;
    for (const StudyFactor& factor : calls->factors)
        firstItem.values.emplace_back(factor.name, factor.values.front());
    std::vector<StimulusItem> items{firstItem};
    for (std::size_t f = 0; f < calls->factors.size(); ++f)
        for (const std::string& value : calls->factors[f].values)
            items.emplace_back(firstItem).values[f].second = value;
    std::set<std::string> checked; // parts may share a call
    for (const StimulusItem& item : items)
        for (const std::string& part : callPartNames(protocol))
            if (const std::string call = resolveCall(*calls, item, part, 0.0); checked.insert(call).second)
                if (auto error = studyCallError(call, condition, protocol.folder); !error.empty())
                    return error;
    return {};
}

} // namespace

Result<Protocol> loadCheckedProtocol(const std::string& nameOrPath) {
    auto protocol = findProtocol(nameOrPath);
    for (std::size_t i = 0; i < protocol.value.conditions.size(); ++i)
        if (const auto error =
                firstCallError(protocol.value, protocol.value.conditions[i], outputOptionError);
            !error.empty())
            return Failure{nameOrPath + ": conditions[" + std::to_string(i) + "].call: " + error};
    return protocol;
}

std::string protocolError(const Protocol& protocol, const std::string& name) {
    if (!isParticipantCode(protocol.name))
        return name + ": name: expected letters, digits, - and _, as files are called after it";
    for (const ConditionPlan& condition : protocol.conditions) {
        const auto layout = resolveLayout(resolveProtocolPath(protocol.folder, condition.layout));
        if (!layout) return name + ": condition " + printable(condition.name) + ": " + layout.error;
        if (auto error = firstCallsError(protocol, condition); !error.empty())
            return name + ": condition " + condition.name + ": call: " + error;
        const auto* patterns = std::get_if<PatternSet>(&condition.stimuli);
        if (patterns && patterns->enchanters != layout.value.geometry.count)
            return name + ": condition " + printable(condition.name) +
                   ": expected as many enchanters as the layout has (" +
                   std::to_string(layout.value.geometry.count) + "), found " +
                   std::to_string(patterns->enchanters);
    }
    return {};
}

Result<PlayableStimulus> makePlayableStimulus(const TrialJob& job, int sampleRateHz,
                                              const std::string& folder) {
    return std::visit(
        [&](const auto& typedJob) -> Result<PlayableStimulus> {
            auto playable = makePlayable(typedJob, sampleRateHz, folder);
            if (!playable) return Failure{textOf(typedJob) + ": " + playable.error};
            return playable;
        },
        job);
}

Result<PlayableWorld> makePlayableWorld(const ResolvedCall& call, const std::string& folder) {
    ParsedCall parsed{call.words, folder};
    auto playable = parsed.error.empty() ? worldFromJob(parsed.renderOptions) : Failure{parsed.error};
    if (!playable) return Failure{call.words + ": " + playable.error};
    return playable;
}

} // namespace physvib
