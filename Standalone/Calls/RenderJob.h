// SPDX-License-Identifier: GPL-3.0-or-later
// A render job as a value: input, rendering options and output files, with checks for conflicting options.
#pragma once
#include "Core/EventShaping.h"
#include "Core/Modes/InstructionSet.h"
#include "Core/PanningLaws.h"
#include "Io/Text/NumberText.h"
#include "Live/Session/OfflineRender.h"
#include "Live/Session/OnsetMarks.h"
#include "Scene/FieldSize.h"
#include "Scene/SceneFile.h"
#include "Scene/World/Simulation.h"
#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// How samples are kept within full scale.
enum class Limiting {
    on,    ///< one smooth limiter of all outputs
    off,   ///< nothing
    blocks ///< each block of each output by itself, as thesis 5.1.3 has it
};

/// The recorded contact of a material, or of all events of a frequency.
struct RecordedSound {
    std::string material;     ///< empty: by frequency
    double frequencyHz = 0.0; ///< 0: by material
    std::string path;

    std::string name() const; ///< the part of the option before the "="
    bool operator==(const RecordedSound&) const = default;
};
using RecordedSounds = std::vector<RecordedSound>;

constexpr double defaultContactSoundDb = -20.0; ///< level of the contact sound for a full-scale impact

/// The options of `physvib render` as values; --help shows these defaults.
struct RenderJob {
    std::string scene;      ///< a built-in scene's name or the path of a scene file; empty with fromEvents
    SceneSettings settings; ///< the scene's variables
    std::string fromEvents; ///< path of an event list
    std::string wavPath, eventsPath, picturePath, moviePath, patternPath; ///< empty: not written
    std::string pad;        ///< game controller profile; `wavPath` then holds motor commands; empty: samples
    double threshold = 0.1; ///< of the pattern, as a share of full scale
    double interfaceVolts = 0.0; ///< interface voltage for a sample of 1 in the WAV; 0: not scaled
    double seconds = 10.0;
    int sampleRateHz = 48000;
    int blockFrames = 256;
    InstructionSet instructions = InstructionSet::best;
    std::uint32_t seed = 1;
    int stepsPerSecond = 100;
    double timeoutSeconds = SimulationTimeLimit::defaultSeconds; ///< for a world that is simulated slower
                                                                 ///< than real time
    std::string layout = "phone4";                               ///< preset or path of a layout file
    FieldSize field; ///< unset: the field of the scene or list, or the layout's extent
    PanningLaw law = PanningLaw::automatic;
    double exponent = 1.0;
    Limiting limiting = Limiting::on;
    ImpactLocation location = ImpactLocation::contact;
    ImpactTiming timing = ImpactTiming::onset;
    RenderingMethod method;       ///< its amplitude needs the layout
    bool fixesSum = true;         ///< a fixed amplitude is that of all hits together; else of each
    bool playsRecordings = false; ///< SV: play `sounds` instead of the method's modes
    double levelDb = 0.0;         ///< of all impacts
    double gamma = 0.0;           ///< Eq. 5.5: share of the amplitude at which a decay is cut; 0: not cut
    bool isWeighted = false;      ///< weights impacts by how strongly their frequency is perceived
    bool matchesStrength = false; ///< recordings get the mode's root mean square; else its peak
    RecordedSounds sounds;        ///< for SV and the contact sound
    std::string contactSound;     ///< a WAV of `render`, outputs of `play`; empty: none
    double contactSoundDb = defaultContactSoundDb; ///< of a full-scale impact
    int contactSoundChannels = 1; ///< of `render`; 2: left and right, by the impact's place in the field
    std::string marker; ///< output of onset markers: a WAV of `render`, outputs of `play`; empty: none
    MarkedOnsets markedOnsets = MarkedOnsets::all;
    std::string actuator = "none";               ///< "none", "layout", a profile's name or its path
    bool isEqualised = true, isRemapped = false; ///< effective with an actuator
    bool explains = false; ///< print which contacts of the scene became events, and why others did not
    std::string coupling;  ///< path of a measured coupling to compensate; empty: none

    std::set<std::string> givenOptions; ///< options in the call, with their dashes; a saved session keeps its
                                        ///< own values for all others
    bool isGiven(const std::string& option) const { return givenOptions.contains(option); }
    /// The first of these that the call had; null: none.
    const char* firstGiven(std::initializer_list<const char*> options) const {
        const auto found = std::ranges::find_if(options, [&](const char* name) { return isGiven(name); });
        return found == options.end() ? nullptr : *found;
    }
    /// Output files of `render`.
    std::vector<std::string> writtenPaths() const {
        return {wavPath, eventsPath, picturePath, moviePath, patternPath, contactSound, marker};
    }
    /// The onsets to be marked; nullopt: no markers.
    std::optional<MarkedOnsets> marks() const {
        return marker.empty() ? std::nullopt : std::optional{markedOnsets};
    }
    std::string methodName() const; ///< "AV-FV-DRV", or "SV"

    bool operator==(const RenderJob&) const = default;
};

inline constexpr std::string_view recordingsHaveNoFrequency =
    "--remap: recordings have no frequency to be moved";
inline constexpr std::string_view recordingsHaveNoWeight =
    "--perceived-level: recordings have no one frequency to be weighted by";
/// Checks for conflicts the options on how a scene is rendered.
/// Empty, or a usage error in one line. Any thread (allocates).
std::string sceneOptionsError(const RenderJob& job);

/// The same check that also covers the options on what is rendered. Any thread (allocates).
std::string inputOptionsError(const RenderJob& job);

/// The full check, of scene, input and output options. Any thread (allocates).
std::string renderOptionsError(const RenderJob& job);

/// "12 pulses", or "12 pulses for 14 onsets: 2 came within 0.5 ms of another".
inline std::string markSummary(const OnsetMarks& marks) {
    const std::string words = plural(marks.pulses(), "pulse");
    if (marks.sharedOnsets() == 0) return words;
    return words + " for " + std::to_string(marks.pulses() + marks.sharedOnsets()) +
           " onsets: " + std::to_string(marks.sharedOnsets()) + " came within 0.5 ms of another";
}

} // namespace physvib
