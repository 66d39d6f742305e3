// SPDX-License-Identifier: GPL-3.0-or-later
// A render job with its loaded inputs (scene, session, clip, layout, actuators, coupling, recordings) and its
// events, and the values that the renderer and the outputs derive from them.
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

// Evaluates --actuator, --equalise and --remap for a layout.

/// Processing of the output for the actuators of a layout.
struct ActuatorChoice {
    EqualisedActuators equalised{}; ///< one per actuator
    /// From a sample to the interface's full scale; 0: no scaling.
    std::array<double, limits::maxEnchanters> voltageScale{};
    FrequencyRemap remap; ///< one for all actuators, because an event has one frequency
};

/// From the options: --actuator none, one profile for all actuators, or `layout` for the profiles in the
/// layout. One error line if a profile is unknown or lacks required data. Message thread.
Result<ActuatorChoice> chooseActuators(const RenderJob& options, const LayoutDescription& layout);

/// Layout with the measured full scale of `--actuator PROFILE`, so that all values in g refer to that
/// actuator. With `--actuator layout`, or a profile without a full scale, the layout's values stay. One error
/// line if the profile is unknown or a layout cannot store the value. Message thread.
Result<LayoutDescription> calibratedLayout(const RenderJob& options, LayoutDescription layout);

/// Warnings on actuators of the layout whose measured full scale the layout does not contain (`--actuator
/// layout`). Message thread.
std::vector<std::string> calibrationWarnings(const RenderJob& options, const LayoutDescription& layout);

/// Notes on the cost of equalisation: the highest level that is flat in the band, per distinct actuator.
std::vector<std::string> levelNotes(const ActuatorChoice& choice, int sampleRateHz);

/// Warnings on remapping: materials that end up less than one JND apart, and materials that decay faster than
/// the actuator itself. `before`: the collisions before remapping.
std::vector<std::string> remapWarnings(const FrequencyRemap& remap, std::span<const CollisionEvent> before,
                                       const LayoutDescription& layout, const RenderJob& options);

// Evaluates --coupling for a layout.

/// Drives that compensate a measured coupling.
struct CouplingChoice {
    CouplingDrives drives; ///< empty: no compensation
    std::string note;      ///< residual error and cost, in one line
};

/// Loads the coupling at `path`. One error line if it is not for the number of actuators in `layout`. M only.
Result<CouplingChoice> chooseCoupling(const std::string& path, const LayoutDescription& layout);

struct LoadedRender {
    const RenderJob& options;
    std::optional<Scene> scene; ///< none: events come from a list
    LayoutDescription layout;
    std::optional<SavedSession> session{}; ///< rendered again; `scene` is that of its first run
    SceneEvents made;
    FieldSize listField{};                      ///< of the list; unknown: not stated, or no list
    SoundNames listNames{};                     ///< of the materials in the list
    std::vector<ContactRecording> recordings{}; ///< of --sound
    LoadedRecordings sessionRecordings{};       ///< of a session
    ActuatorChoice actuators{};                 ///< by the options; see equalised() and shaping()
    CouplingChoice coupling{};                  ///< by the options
    std::optional<Clip> clip{};                 ///< rendered instead of events

    /// For messages about events.
    const std::string& source() const {
        return scene ? scene->name : clip ? options.scene : options.fromEvents;
    }

    /// Names of materials and parts.
    SoundNames names() const {
        SoundNames all = listNames;
        for (const EnchanterDescription& one : layout.enchanters) all.parts.add(one.part);
        if (scene) all.addScene(*scene);
        if (session)
            for (const SceneRun& take : session->log.takes) all.addScene(*take.scene);
        return all;
    }

    /// Recordings that are played instead of modes.
    std::vector<ContactRecording> feltRecordings() const {
        return options.playsRecordings ? recordings : std::vector<ContactRecording>{};
    }

    RunSettings run() const {
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
        for (const EnchanterDescription& enchanter : layout.enchanters) paths.push_back(enchanter.actuator);
        if (isJsonPath(options.pad)) paths.push_back(options.pad);
        return paths;
    }
    int channels() const { return keepsLayouts() ? session->channels : layout.geometry.count; }
    double seconds() const {
        if (options.isGiven("--seconds")) return options.seconds;
        if (clip) return clip->seconds();
        return session ? static_cast<double>(session->lengthNs) * 1e-9 : options.seconds;
    }
    /// Gains. A saved session's ceilings belong to its actuators, and do not apply to other layouts.
    std::array<float, limits::maxEnchanters> ceilings() const {
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
    /// 0 for recordings, which are played whole: one call of a study renders model and recording.
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
    /// True if the session's recordings apply, i.e. its own method.
    bool keepsRecordings() const { return session && !options.isGiven("--method"); }
    bool isLimited() const { return session ? session->limiterEnabled : options.limiting == Limiting::on; }
    std::int64_t frames() const {
        return std::max<std::int64_t>(1, std::llround(seconds() * options.sampleRateHz));
    }
    std::int64_t endNs() const { return std::llround(seconds() * 1e9); }
    /// The field of the options, else of session, scene or list; unknown if the list does not state one.
    FieldSize saidField() const {
        if (options.field.isKnown()) return options.field;
        if (session) return fieldOf(session->panner);
        return scene ? FieldSize{scene->fieldWidthMetres, scene->fieldHeightMetres} : listField;
    }
    FieldSize field() const {
        const FieldSize said = saidField();
        return said.isKnown() ? said : extentOf(layout.geometry);
    }
    bool hasGuessedField() const { return !clip && !saidField().isKnown(); }
    double fieldWidthMetres() const { return field().widthMetres; }
    double fieldHeightMetres() const { return field().heightMetres; }
    /// The requested method, with its fixed level as a share of the actuators' full scale.
    RenderingMethod method() const {
        if (session && !options.isGiven("--method")) return session->shaping.method;
        RenderingMethod wanted = options.method;
        wanted.fixedAmplitude = RenderingMethod::fixedLevelG / fullScaleG();
        wanted.holdsLevel = wanted.fixesAmplitude && options.fixesSum;
        return wanted;
    }
    /// Full scale of the first actuator; a fixed level needs it to be that of all.
    double fullScaleG() const { return layout.enchanters.front().fullScaleG; }
    PhantomPanner panner() const {
        if (keepsLayouts()) return session->panner;
        // an exponent alone is that of the linear law, of grains too, even if it is 1
        const bool isLinear = options.isGiven("--exponent") && !options.isGiven("--law");
        return {layout.geometry, isLinear ? PanningLaw::linear : options.law, options.exponent,
                fieldWidthMetres(), fieldHeightMetres()};
    }
};

/// Why the method's fixed level is impossible, or empty; prints a warning if it is above full scale. An event
/// has one amplitude, which is 1.5 g on every actuator only if their full scales are equal.
inline std::string fixedLevelFault(const LoadedRender& job) {
    if (!job.method().fixesAmplitude) return {};
    for (const auto& enchanter : job.layout.enchanters)
        if (enchanter.fullScaleG != job.fullScaleG())
            return job.options.layout + ": --method " + job.options.methodName() +
                   ": expected one full_scale_g for all actuators, found " + numberText(job.fullScaleG()) +
                   " and " + numberText(enchanter.fullScaleG);
    if (job.method().fixedAmplitude > 1.0)
        std::cerr << "physvib: warning: --method " << job.options.methodName() << ": the fixed level of "
                  << numberText(RenderingMethod::fixedLevelG) << " g is above the actuators' full scale of "
                  << numberText(job.fullScaleG()) << " g"
                  << (job.isLimited() ? "; the limiter lowers it\n" : "\n");
    return {};
}

/// True if a --sound names the event's material or frequency.
inline bool isNamedBy(const RecordingFile& file, const CollisionEvent& event) {
    return file.material.empty() ? event.frequencyHz == file.frequencyHz : event.sound == file.sound();
}

/// The file of a --sound with the frequency and decay of its events; or one error line.
inline Result<RecordingFile> recordingOf(const RecordedSound& sound, const LoadedRender& job,
                                         const std::vector<CollisionEvent>& events) {
    RecordingFile file{sound.frequencyHz, sound.path, 0.0, job.options.matchesStrength, {}, sound.material};
    const auto isMeant = [&](const CollisionEvent& e) { return isNamedBy(file, e); };
    if (const auto struck = std::ranges::find_if(events, isMeant); struck != events.end()) {
        file.frequencyHz = struck->frequencyHz;
        file.decayPerSecond = struck->decayPerSecond;
        return file;
    }
    if (sound.material.empty()) return file;
    if (job.scene) // it has no event
        for (const Material& m : job.scene->materials)
            if (m.name == sound.material && m.frequencyHz > 0.0) {
                file.frequencyHz = m.frequencyHz;
                file.decayPerSecond = m.decayPerSecond;
                return file;
            }
    return Failure{"--sound " + sound.material + "=" + sound.path + ": expected a material of " +
                   job.source() + " that vibrates, or a frequency"};
}

/// Loads the files of --sound, and checks that each of the events (or materials, as events) has one. Empty,
/// or one error line. The caller prints their notes.
inline std::string takeRecordings(LoadedRender& job, const std::vector<CollisionEvent>& events,
                                  const std::string& source) {
    for (const RecordedSound& sound : job.options.sounds) {
        const auto file = recordingOf(sound, job, events);
        if (!file) return file.error;
        auto contact = loadContact(file.value);
        if (!contact) return contact.error;
        job.recordings.push_back(std::move(contact.value));
    }
    for (const CollisionEvent& e : events) {
        const auto isItsOwn = [&](const ContactRecording& r) { return isNamedBy(r.file, e); };
        if (!job.options.playsRecordings || isClip(e.sound) || std::ranges::any_of(job.recordings, isItsOwn))
            continue;
        const SoundNames names = job.names();
        return source + ": expected a --sound for " + (names.has(e.sound) ? names.of(e.sound) + " or " : "") +
               numberText(e.frequencyHz) + " Hz, found none";
    }
    return {};
}

/// Loads the saved session into `job`. Returns exitDone, or the exit code after an error line on stderr.
inline int takeSession(LoadedRender& job) {
    if (const char* own = job.options.firstGiven(
            {"--set", "--seed", "--steps-per-second", "--location", "--timing", "--limiter"}))
        return leave(exitUsage, std::string{own} + ": a saved session brings its own");
    auto session = loadSession(job.options.scene);
    if (!session) return leave(exitFailed, session.error);
    job.session = std::move(session.value);
    job.scene = job.session->log.takes.front().whole();
    SessionLog& log = job.session->log;
    if (!job.keepsRecordings()) log.recordings.clear();
    if (log.recordings.empty() && log.clips.empty()) return exitDone;
    if (!log.recordings.empty() && job.options.isRemapped)
        return leave(exitUsage, std::string{recordingsHaveNoFrequency});
    if (!log.recordings.empty() && job.perceived().isWeighted)
        return leave(exitUsage, std::string{recordingsHaveNoWeight});
    auto recordings = loadRecordings(log);
    if (!recordings) return leave(exitFailed, job.options.scene + ": " + recordings.error);
    job.sessionRecordings = std::move(recordings.value);
    for (const std::string& note : notesOf(job.sessionRecordings)) tell(note);
    return exitDone;
}

/// Loads the scene that the options name into `job`, and prints its warnings. Returns exitDone, or the exit
/// code after an error line on stderr.
inline int takeScene(LoadedRender& job) {
    const std::string& name = job.options.scene;
    auto scene = findScene(name, job.options.settings);
    if (!scene) return leave(isJsonPath(name) ? exitFailed : exitUsage, scene.error);
    job.scene = std::move(scene.value);
    for (const std::string& warning : sceneWarnings(*job.scene)) tell("warning: " + name + ": " + warning);
    return exitDone;
}

/// One event per material with a frequency. In a live session any material may collide, so all of them count.
inline std::vector<CollisionEvent> soundsOf(const Scene& scene) {
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

/// Session setup of a job with a scene.
inline SessionSetup sessionSetup(const LoadedRender& job) {
    SessionSetup setup;
    setup.scene = *job.scene;
    const RunSettings run = job.run();
    setup.seed = run.seed;
    setup.stepsPerSecond = run.stepsPerSecond;
    setup.timing = run.timing;
    setup.location = run.location;
    setup.channels = job.channels();
    setup.panner = job.panner();
    setup.layout = job.layout;
    setup.equalised = job.equalised();
    setup.shaping = job.shaping();
    setup.recordings = job.feltRecordings();
    setup.limiterEnabled = job.options.limiting == Limiting::on;
    setup.normalisesBlocks = job.options.limiting == Limiting::blocks;
    return setup;
}

} // namespace physvib
