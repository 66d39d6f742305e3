// SPDX-License-Identifier: GPL-3.0-or-later
// LoadedRender: a render job with its loaded inputs (scene, session, clip, layout, actuators, coupling,
// recordings), its events, and the renderer's values derived from them; and functions that load these inputs.
// All for the message thread.
#pragma once
#include "Calls/CallOptions.h"
#include "Core/Actuators/ActuatorEqualiser.h"
#include "Core/CollisionEvent.h"
#include "Core/EventShaping.h"
#include "Core/NameNumbers.h"
#include "Core/Units.h"
#include "Formats/ClipFile.h"
#include "Io/Disk/Embedded.h"
#include "Io/Result.h"
#include "Io/Text/NumberText.h"
#include "Lab/Study/Coupling.h"
#include "Live/Documents/SessionFile.h"
#include "Live/Recordings/LoadRecordings.h"
#include "Live/Session/SessionSetup.h"
#include "Scene/LayoutFile.h"
#include "Scene/PartNames.h"
#include "Scene/SceneFile.h"
#include "Scene/SceneValidation.h"
#include "Scene/World/Simulation.h"
#include "System/Process.h"
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace physvib {

/// Processing of the output for the actuators of a layout.
struct ActuatorChoice {
    EqualisedActuators equalised{}; ///< one per actuator
    /// Factor from a sample to the interface's full scale; 0: no scaling.
    std::array<double, limits::maxActuators> voltageScale{};
    FrequencyRemap remap; ///< one for all actuators, because an event has one frequency
};

/// Evaluates --actuator (none, one profile for all, or `layout` for the profiles in the layout), --equalise
/// and --remap. One error line if a profile is unknown or lacks required data.
Result<ActuatorChoice> chooseActuators(const RenderJob& options, const LayoutDescription& layout);

/// The layout with the measured full scale of `--actuator PROFILE`, so that all values in g refer to that
/// actuator; with `--actuator layout`, or a profile without a full scale, the layout itself. One error line
/// if the profile is unknown.
Result<LayoutDescription> calibratedLayout(const RenderJob& options, LayoutDescription layout);

/// Warnings for actuators whose full scale in the layout differs from the measured one in their profile (with
/// `--actuator layout`).
std::vector<std::string> calibrationWarnings(const RenderJob& options, const LayoutDescription& layout);

/// Notes on the cost of equalisation: for each distinct actuator the highest level that is flat in its band.
std::vector<std::string> levelNotes(const ActuatorChoice& choice, int sampleRateHz);

/// Warnings on remapping: materials that end up less than one JND apart, and materials that decay faster than
/// the actuator itself. `before`: the collisions before remapping.
std::vector<std::string> remapWarnings(const FrequencyRemap& remap, std::span<const CollisionEvent> before,
                                       const LayoutDescription& layout, const RenderJob& options);

/// Drives that compensate a measured coupling.
struct CouplingChoice {
    CouplingDrives drives; ///< empty: no compensation
    std::string note;      ///< residual error and cost, in one line
};

/// Loads the coupling at `path` (--coupling). One error line if it cannot be read, or has another number of
/// actuators than `layout`.
Result<CouplingChoice> chooseCoupling(const std::string& path, const LayoutDescription& layout);

/// A render job with its loaded inputs and events. One thread at a time.
struct LoadedRender {
    const RenderJob& options;
    std::optional<Scene> scene; ///< none: events come from a list
    LayoutDescription layout;
    std::optional<SavedSession> session{}; ///< a saved session to be rendered again; `scene` is that of its
                                           ///< first run
    SceneEvents collisions;
    FieldSize listField{};                      ///< field of the event list; unknown if it states none
    SoundNames listNames{};                     ///< of the materials in the list
    std::vector<ContactRecording> recordings{}; ///< of --sound
    LoadedRecordings sessionRecordings{};       ///< of a session
    ActuatorChoice actuators{};                 ///< by the options; see equalised() and shaping()
    CouplingChoice coupling{};                  ///< by the options
    std::optional<Clip> clip{};                 ///< rendered instead of events

    /// Name of the scene, clip or event list, for messages.
    const std::string& source() const {
        return scene ? scene->name : clip ? options.scene : options.fromEvents;
    }

    /// Names of all materials and parts of the inputs.
    SoundNames names() const {
        SoundNames all = listNames;
        for (const ActuatorDescription& actuator : layout.actuators) all.parts.add(actuator.part);
        if (scene) all.addScene(*scene);
        if (session)
            for (const SceneRun& sceneRun : session->log.runs) all.addScene(*sceneRun.scene);
        return all;
    }

    /// Recordings that are played instead of modes.
    std::vector<ContactRecording> playedRecordings() const {
        return options.playsRecordings ? recordings : std::vector<ContactRecording>{};
    }

    RunSettings settings() const {
        if (session) return session->run;
        return {options.seed, options.stepsPerSecond, options.timing, options.location};
    }
    /// True if the session's layouts apply, i.e. no option replaces them.
    bool keepsLayouts() const {
        return session && !options.firstGiven({"--layout", "--law", "--exponent", "--field"});
    }
    /// Files that are read because others name them: recordings of a session, actuators of a layout.
    std::vector<std::string> namedInputs() const {
        auto paths = session ? recordingPaths(session->log) : std::vector<std::string>{};
        for (const ActuatorDescription& actuator : layout.actuators) paths.push_back(actuator.actuator);
        if (isJsonPath(options.pad)) paths.push_back(options.pad);
        return paths;
    }
    int channels() const { return keepsLayouts() ? session->channels : layout.geometry.count; }
    double seconds() const {
        if (options.isGiven("--seconds")) return options.seconds;
        if (clip) return clip->seconds();
        return session ? static_cast<double>(session->lengthNs) * 1e-9 : options.seconds;
    }
    /// Maximum gains. A saved session's ceilings belong to its actuators, and do not apply to other layouts.
    std::array<float, limits::maxActuators> ceilings() const {
        return keepsLayouts() ? session->ceilings : RendererSettings::fullScale();
    }
    /// True if the session's actuators apply, as keepsLayouts().
    bool keepsActuators() const {
        return session && !options.firstGiven({"--actuator", "--equalise", "--remap", "--layout"});
    }
    EqualisedActuators equalised() const {
        return keepsActuators() ? session->equalised : actuators.equalised;
    }
    EventShaping shaping() const {
        return {method(), keepsActuators() ? session->shaping.remap : actuators.remap, gain(), perceived(),
                truncation()};
    }
    /// Share of the amplitude at which decays are cut; 0 for recordings, which are played whole.
    double truncation() const {
        if (session && !options.isGiven("--gamma")) return session->shaping.truncation;
        return options.playsRecordings ? 0.0 : options.gamma;
    }
    double gain() const {
        return session && !options.isGiven("--level-db") ? session->shaping.gain
                                                         : fromDecibels(options.levelDb);
    }
    PerceivedLevel perceived() const {
        return session && !options.isGiven("--perceived-level") ? session->shaping.perceived
                                                                : PerceivedLevel{options.isWeighted};
    }
    /// True if the session's recordings apply, i.e. no option replaces its method.
    bool keepsRecordings() const { return session && !options.isGiven("--method"); }
    bool isLimited() const { return session ? session->limiterEnabled : options.limiting == Limiting::on; }
    std::int64_t frames() const {
        return std::max<std::int64_t>(1, std::llround(seconds() * options.sampleRateHz));
    }
    std::int64_t endNs() const { return std::llround(seconds() * 1e9); }
    /// The field of the options, else of session, scene or list; unknown if the list does not state one.
    FieldSize statedField() const {
        if (options.field.isKnown()) return options.field;
        if (session) return fieldOf(session->panner);
        return scene ? FieldSize{scene->fieldWidthMetres, scene->fieldHeightMetres} : listField;
    }
    FieldSize field() const {
        const FieldSize stated = statedField();
        return stated.isKnown() ? stated : extentOf(layout.geometry);
    }
    bool hasGuessedField() const { return !clip && !statedField().isKnown(); }
    double fieldWidthMetres() const { return field().widthMetres; }
    double fieldHeightMetres() const { return field().heightMetres; }
    /// The requested method, with its fixed level as a share of the actuators' full scale.
    RenderingMethod method() const {
        if (session && !options.isGiven("--method")) return session->shaping.method;
        RenderingMethod requested = options.method;
        requested.fixedAmplitude = RenderingMethod::fixedLevelG / fullScaleG();
        requested.holdsLevel = requested.fixesAmplitude && options.fixesSum;
        return requested;
    }
    /// Full scale of the first actuator; a fixed level needs it to be that of all.
    double fullScaleG() const { return layout.actuators.front().fullScaleG; }
    PhantomPanner panner() const {
        if (keepsLayouts()) return session->panner;
        // --exponent without --law means the linear law, also of grains and with exponent 1
        const bool isLinear = options.isGiven("--exponent") && !options.isGiven("--law");
        return {layout.geometry, isLinear ? PanningLaw::linear : options.law, options.exponent,
                fieldWidthMetres(), fieldHeightMetres()};
    }
};

/// Empty, or why the method's fixed level in g is impossible: an event has one amplitude, which means the
/// same level on all actuators only if their full scales are equal. Warns if it is above full scale.
inline std::string fixedLevelError(const LoadedRender& job) {
    if (!job.method().fixesAmplitude) return {};
    for (const auto& actuator : job.layout.actuators)
        if (actuator.fullScaleG != job.fullScaleG())
            return job.options.layout + ": --method " + job.options.methodName() +
                   ": expected one full_scale_g for all actuators, found " + numberText(job.fullScaleG()) +
                   " and " + numberText(actuator.fullScaleG);
    if (job.method().fixedAmplitude > 1.0)
        std::cerr << "physvib: warning: --method " << job.options.methodName() << ": the fixed level of "
                  << numberText(RenderingMethod::fixedLevelG) << " g is above the actuators' full scale of "
                  << numberText(job.fullScaleG()) << " g"
                  << (job.isLimited() ? "; the limiter lowers it\n" : "\n");
    return {};
}

/// True if the recording is that of the event's material or frequency.
inline bool isNamedBy(const RecordingFile& file, const CollisionEvent& event) {
    return file.material.empty() ? event.frequencyHz == file.frequencyHz : event.sound == file.sound();
}

/// The recording of a --sound with the frequency and decay of its events or material; or one error line.
inline Result<RecordingFile> findRecording(const RecordedSound& sound, const LoadedRender& job,
                                           const std::vector<CollisionEvent>& events) {
    RecordingFile file{sound.frequencyHz, sound.path, 0.0, job.options.matchesStrength, {}, sound.material};
    const auto isNamed = [&](const CollisionEvent& e) { return isNamedBy(file, e); };
    if (const auto firstMatch = std::ranges::find_if(events, isNamed); firstMatch != events.end()) {
        file.frequencyHz = firstMatch->frequencyHz;
        file.decayPerSecond = firstMatch->decayPerSecond;
        return file;
    }
    if (sound.material.empty()) return file;
    if (job.scene) // no event has that material
        for (const Material& m : job.scene->materials)
            if (m.name == sound.material && m.frequencyHz > 0.0) {
                file.frequencyHz = m.frequencyHz;
                file.decayPerSecond = m.decayPerSecond;
                return file;
            }
    return Failure{"--sound " + sound.material + "=" + sound.path + ": expected a material of " +
                   job.source() + " that vibrates, or a frequency"};
}

/// Loads the files of --sound into `job`, and checks that each of `events` has one if recordings are played.
/// Empty, or one error line. The caller prints the recordings' notes.
inline std::string loadNamedRecordings(LoadedRender& job, const std::vector<CollisionEvent>& events,
                                       const std::string& source) {
    for (const RecordedSound& sound : job.options.sounds) {
        const auto file = findRecording(sound, job, events);
        if (!file) return file.error;
        auto contact = loadContact(file.value);
        if (!contact) return contact.error;
        job.recordings.push_back(std::move(contact.value));
    }
    for (const CollisionEvent& e : events) {
        const auto isMatching = [&](const ContactRecording& r) { return isNamedBy(r.file, e); };
        if (!job.options.playsRecordings || isClip(e.sound) ||
            std::ranges::any_of(job.recordings, isMatching))
            continue;
        const SoundNames names = job.names();
        return source + ": expected a --sound for " +
               (names.has(e.sound) ? names.nameOf(e.sound) + " or " : "") + numberText(e.frequencyHz) +
               " Hz, found none";
    }
    return {};
}

/// Loads the saved session into `job`. Returns exitDone, or the exit code after an error line on stderr.
inline int loadSessionInto(LoadedRender& job) {
    if (const char* conflicting = job.options.firstGiven(
            {"--set", "--seed", "--steps-per-second", "--location", "--timing", "--limiter"}))
        return reportExit(exitUsage, std::string{conflicting} + ": a saved session brings its own");
    auto session = loadSession(job.options.scene);
    if (!session) return reportExit(exitFailed, session.error);
    job.session = std::move(session.value);
    job.scene = job.session->log.runs.front().fullScene();
    SessionLog& log = job.session->log;
    if (!job.keepsRecordings()) log.recordings.clear();
    if (log.recordings.empty() && log.clips.empty()) return exitDone;
    if (!log.recordings.empty() && job.options.isRemapped)
        return reportExit(exitUsage, std::string{recordingsHaveNoFrequency});
    if (!log.recordings.empty() && job.perceived().isWeighted)
        return reportExit(exitUsage, std::string{recordingsHaveNoWeight});
    auto recordings = loadRecordings(log);
    if (!recordings) return reportExit(exitFailed, job.options.scene + ": " + recordings.error);
    job.sessionRecordings = std::move(recordings.value);
    for (const std::string& note : recordingNotes(job.sessionRecordings)) printMessage(note);
    return exitDone;
}

/// Loads the scene that the options name into `job`, and prints its warnings. Returns exitDone, or the exit
/// code after an error line on stderr.
inline int loadSceneInto(LoadedRender& job) {
    const std::string& name = job.options.scene;
    auto scene = findScene(name, job.options.settings);
    if (!scene) return reportExit(isJsonPath(name) ? exitFailed : exitUsage, scene.error);
    job.scene = std::move(scene.value);
    for (const std::string& warning : sceneWarnings(*job.scene))
        printMessage("warning: " + name + ": " + warning);
    return exitDone;
}

/// One event per material with a frequency: a live session needs the sounds of all, because any may collide.
inline std::vector<CollisionEvent> materialSounds(const Scene& scene) {
    std::vector<CollisionEvent> sounds;
    for (const Material& m : scene.materials) {
        if (!(m.frequencyHz > 0.0)) continue;
        CollisionEvent& sound = sounds.emplace_back();
        sound.frequencyHz = m.frequencyHz;
        sound.decayPerSecond = m.decayPerSecond;
        sound.sound = soundOfMaterial(m.name);
    }
    return sounds;
}

/// The setup of a live session from a job that has a scene.
inline SessionSetup sessionSetup(const LoadedRender& job) {
    SessionSetup setup;
    setup.scene = *job.scene;
    const RunSettings run = job.settings();
    setup.seed = run.seed;
    setup.stepsPerSecond = run.stepsPerSecond;
    setup.timing = run.timing;
    setup.location = run.location;
    setup.channels = job.channels();
    setup.panner = job.panner();
    setup.layout = job.layout;
    setup.equalised = job.equalised();
    setup.shaping = job.shaping();
    setup.recordings = job.playedRecordings();
    setup.limiterEnabled = job.options.limiting == Limiting::on;
    setup.normalisesBlocks = job.options.limiting == Limiting::blocks;
    return setup;
}

} // namespace physvib
