// SPDX-License-Identifier: GPL-3.0-or-later
// Checks the options of a render job for conflicts before any file is read.
#include "Calls/RenderJob.h"
#include "Calls/MovieOutput.h"
#include "Io/Disk/FileClash.h"
#include "Io/Text/NumberText.h"
#include <algorithm>
#include <concepts>

namespace physvib {

static_assert(std::equality_comparable<RenderJob>);

std::string RecordedSound::name() const { return material.empty() ? numberText(frequencyHz) : material; }

std::string RenderJob::methodName() const {
    const auto name = nameOf(method);
    return playsRecordings ? "SV" : std::string{name.begin(), name.end()};
}

namespace {

/// Checks the movie's file name and length: empty, or the error.
std::string movieError(const RenderJob& o) {
    if (auto error = fileExtensionError(o.moviePath, {".webp", ".gif", ".mp4"}); !error.empty())
        return "--movie: " + error;
    return o.seconds <= maxMovieSeconds ? std::string{} : "--movie: expected --seconds of at most 600";
}

} // namespace

std::string sceneOptionsError(const RenderJob& o) {
    if (o.playsRecordings && o.sounds.empty()) return "--method SV: expected a --sound for each material";
    if (!o.playsRecordings && !o.sounds.empty() && o.contactSound.empty())
        return "--sound: expected --method SV, to feel it, or --contact-sound, to hear it";
    if (o.playsRecordings && o.isRemapped) return std::string{recordingsHaveNoFrequency};
    if (o.playsRecordings && o.isWeighted) return std::string{recordingsHaveNoWeight};
    if (!o.sounds.empty() && (o.isRemapped || o.method.fixesFrequency))
        return "--sound: expected hits at their material's own frequency, found " +
               (o.isRemapped ? "--remap" : "--method " + o.methodName());
    if (o.isRemapped && o.actuator == "none")
        return "--remap: expected an --actuator, whose band is to be used";
    return {};
}

std::string inputOptionsError(const RenderJob& o) {
    if (o.scene.empty() == o.fromEvents.empty())
        return "render: give either a scene or --from-events EVENTS.csv";
    if (!o.settings.empty() && o.scene.empty()) return "--set: only a scene has variables";
    if (o.interfaceVolts > 0.0 && o.actuator == "none")
        return "--interface-volts: expected an --actuator, whose drive limit is to be met";
    if (!o.moviePath.empty())
        if (const std::string error = movieError(o); !error.empty()) return error;
    if (!o.coupling.empty() && o.playsRecordings)
        return "--coupling: expected a --method of modes; a recording has no one frequency";
    return sceneOptionsError(o);
}

std::string renderOptionsError(const RenderJob& o) {
    const std::string error = inputOptionsError(o);
    if (!o.pad.empty() && o.wavPath.empty()) return "--pad: expected --out MOTORS.csv";
    if (error.empty() && o.explains && o.scene.empty())
        return "--explain: expected a scene, whose contacts are counted";
    if (!error.empty() || o.explains || !std::ranges::all_of(o.writtenPaths(), &std::string::empty))
        return error;
    return "render: nothing to write; give --out, --events, --picture, --movie, --pattern, --contact-sound "
           "or --marker";
}

} // namespace physvib
