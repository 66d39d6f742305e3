// SPDX-License-Identifier: GPL-3.0-or-later
// Files first, then simulation, then what the options make of each collision.
#include "CommandLine/Render/RenderInputs.h"
#include "CommandLine/Render/ClipInput.h"
#include "Live/Session/SessionRender.h"
#include "Scene/EventsCsv.h"
#include "Scene/FileKind.h"
#include <functional>

namespace physvib {
namespace {

std::string readInputs(LoadedRender& job) {
    if (job.session && !job.options.given.contains("--layout")) {
        job.layout = job.session->layout;
    } else {
        auto layout = layoutNamed(job.options.layout);
        if (!layout) return layout.error;
        job.layout = std::move(layout.value);
    }
    auto calibrated = calibratedLayout(job.options, std::move(job.layout));
    if (!calibrated) return calibrated.error;
    job.layout = std::move(calibrated.value);
    if (auto fault = fixedLevelFault(job); !fault.empty()) return fault;
    auto actuators = chooseActuators(job.options, job.layout);
    if (!actuators) return actuators.error;
    job.actuators = std::move(actuators.value);
    if (!job.options.coupling.empty()) {
        if (job.session)
            return "--coupling: expected a scene or events; a saved session may change its layout and play "
                   "recordings";
        auto coupling = chooseCoupling(job.options.coupling, job.layout);
        if (!coupling) return coupling.error;
        job.coupling = std::move(coupling.value);
    }
    if (job.scene) return {};
    auto events = loadEventsCsv(job.options.fromEvents);
    if (!events) return events.error;
    job.made.events = std::move(events.value.events);
    job.listField = events.value.field;
    job.listNames = std::move(events.value.names);
    return {};
}

/// Of the scene or session; one line if it is simulated too slowly.
Result<SceneEvents> eventsOf(const LoadedRender& job) {
    Patience patience{job.options.patienceSeconds};
    auto made = job.session ? sessionEvents(*job.session, job.endNs(), std::ref(patience))
                            : runScene(*job.scene, job.run(), job.endNs(), std::ref(patience));
    if (auto fault = patience.fault(); !fault.empty()) return Failure{job.options.scene + ": " + fault};
    return made;
}

} // namespace

int takeInputs(LoadedRender& job) {
    const std::string& name = job.options.scene;
    if (clipFormatOf(name)) return takeClip(job);
    if (!name.empty()) {
        const bool isSession = isJsonPath(name) && fileKind(name) == FileKind::session;
        if (const int code = isSession ? takeSession(job) : takeScene(job); code != exitDone) return code;
    }
    const std::string error = readInputs(job);
    return error.empty() ? exitDone : leave(exitFailed, error);
}

Result<std::vector<std::string>> makeEvents(LoadedRender& job) {
    if (job.scene) {
        auto made = eventsOf(job);
        if (!made) return Failure{made.error};
        job.made = std::move(made.value);
    }
    auto warnings = remapWarnings(job.shaping().remap, job.made.events, job.layout, job.options);
    std::ranges::transform(job.made.events, job.made.events.begin(), EventShaper{job.shaping()});
    return warnings;
}

} // namespace physvib
