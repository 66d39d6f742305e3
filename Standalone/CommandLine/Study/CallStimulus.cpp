// SPDX-License-Identifier: GPL-3.0-or-later
// The same parsers as the program's.
#include "CommandLine/Study/CallStimulus.h"
#include "CommandLine/Render/JobSession.h"
#include "CommandLine/Study/CallFiles.h"
#include "CommandLine/Study/StimulusOptions.h"
#include "Files/ProtocolFile.h"
#include "Options/Parser.h"
#include <algorithm>
#include <cmath>
#include <functional>

namespace physvib {
namespace {

/// The job of the options gets its scene and its layout, to be felt; empty, or one line.
std::string prepareScene(RenderOptions& o, RenderJob& job) {
    if (o.actuator != "none") return "--actuator is not yet felt here, only rendered";
    if (!o.coupling.empty()) return "--coupling is not yet felt here, only rendered";
    if (auto fault = checkSceneOptions(o); !fault.empty()) return fault;
    if (o.scene.empty()) return "expected a scene";
    auto layout = layoutNamed(o.layout);
    if (!layout) return layout.error;
    auto scene = findScene(o.scene, o.settings);
    if (!scene) return scene.error;
    job.layout = std::move(layout.value);
    job.scene = std::move(scene.value);
    return {};
}

Result<CallStimulus> ofScene(RenderOptions& o) {
    RenderJob job{o, {}, {}, {}, {}};
    if (auto fault = prepareScene(o, job); !fault.empty()) return Failure{fault};
    Patience patience{Patience::usualSeconds}; // whatever the call says: it may be a stranger's
    job.made = runScene(*job.scene, job.run(), job.endNs(), std::ref(patience));
    if (auto fault = patience.fault(); !fault.empty()) return Failure{fault};
    std::ranges::transform(job.made.events, job.made.events.begin(), EventShaper{job.shaping()});
    if (auto fault = takeRecordings(job, job.made.events, o.scene); !fault.empty()) return Failure{fault};
    return CallStimulus{{job.made.events, job.panner(), job.seconds()}, job.layout, std::vector<float>(job.layout.enchanters.size(), 1.0f), job.feltRecordings()};
}

Result<CallWorld> asWorld(RenderOptions& o) {
    RenderJob job{o, {}, {}, {}, {}};
    if (auto fault = prepareScene(o, job); !fault.empty()) return Failure{fault};
    if (auto fault = fixedLevelFault(job); !fault.empty()) return Failure{fault};
    if (auto fault = takeRecordings(job, soundsOf(*job.scene), o.scene); !fault.empty()) return Failure{fault};
    return CallWorld{sessionSetup(job), job.layout, job.seconds()};
}

Result<CallStimulus> ofStimulus(const OptionTable& command, const StimulusOptions& o, int sampleRateHz) {
    const auto layout = layoutNamed(o.layout);
    if (!layout) return Failure{layout.error};
    MadeStimulus made = makeStimulus(command, o, layout.value);
    if (!made.usage.empty()) return Failure{made.usage};
    if (!made.error.empty()) return Failure{made.error};
    if (!o.recording.empty()) return Failure{"a recording is rendered to a file; a live session plays events"};
    if (const auto sound = renderStimulus(made.stimulus, layout.value, sampleRateHz); !sound) return Failure{sound.error};
    CallStimulus call{std::move(made.stimulus), layout.value, {}, {}};
    for (const auto& enchanter : layout.value.enchanters) call.gains.push_back(static_cast<float>(1.0 / enchanter.fullScaleG));
    return call;
}

/// A call in its parts; `error` if its words are none.
struct ParsedCall {
    explicit ParsedCall(const std::string& call) {
        declareRenderOptions(render, renderOptions);
        declareStimulus(stimulus, stimulusOptions);
        if (auto fault = writtenWordFault(call); !fault.empty()) error = call + ": " + fault;
        if (!error.empty()) return;
        if (const auto parsed = parseText(words, call); !parsed.fault.empty()) error = call + ": " + parsed.fault;
    }
    ParsedCall(const std::string& call, const std::string& folder)
        : ParsedCall{call} {
        if (!error.empty()) return;
        if (auto fault = linkOfCallFault(words, folder); !fault.empty()) error = call + ": " + fault;
        findFiles(folder);
    }
    /// Those in `folder`, where they are there.
    void findFiles(const std::string& folder) {
        for (std::string* path : {&renderOptions.layout, &renderOptions.scene, &stimulusOptions.layout}) *path = besideProtocol(folder, *path);
        for (std::string& sound : renderOptions.sounds)
            if (const auto equals = sound.find('='); equals != std::string::npos) sound = sound.substr(0, equals + 1) + besideProtocol(folder, sound.substr(equals + 1));
    }
    OptionTable words{"physvib", {}};
    RenderOptions renderOptions;
    StimulusOptions stimulusOptions;
    OptionTable& render = words.addCommand("render", {});
    OptionTable& stimulus = words.addCommand("stimulus", {});
    std::string error;
};

} // namespace

std::string wordsFault(const std::string& call) { return ParsedCall{call}.error; }

std::string studyLevelFault(const std::string& call, const std::string& folder) {
    ParsedCall parsed{call, folder};
    RenderOptions& o = parsed.renderOptions;
    if (!parsed.error.empty()) return parsed.error;
    if (!parsed.words.isCalled("render") || !checkSceneOptions(o).empty() || !o.renderingMethod.fixesAmplitude) return {};
    const auto layout = layoutNamed(o.layout);
    if (!layout) return layout.error;
    const double leastG = leastStudyFullScaleG * std::pow(10.0, o.levelDb / 20.0);
    for (const EnchanterDescription& enchanter : layout.value.enchanters)
        if (enchanter.fullScaleG < leastG)
            return "--method " + o.method + ": expected enchanters of at least " + fixedNumber(leastG, 2) + " g (full_scale_g), as 1.5 g and 1 dB of headroom are felt, found " +
                   fixedNumber(enchanter.fullScaleG, 2) + " g";
    return {};
}

Result<CallStimulus> stimulusOfCall(const std::string& call, int sampleRateHz, const std::string& folder) {
    ParsedCall parsed{call, folder};
    if (!parsed.error.empty()) return Failure{parsed.error};
    auto made = parsed.words.isCalled("render") ? ofScene(parsed.renderOptions) : ofStimulus(parsed.stimulus, parsed.stimulusOptions, sampleRateHz);
    if (!made) return Failure{call + ": " + made.error};
    return made;
}

Result<CallWorld> worldOfCall(const std::string& call, const std::string& folder) {
    ParsedCall parsed{call, folder};
    if (!parsed.error.empty()) return Failure{parsed.error};
    auto made = asWorld(parsed.renderOptions);
    if (!made) return Failure{call + ": " + made.error};
    return made;
}

} // namespace physvib
