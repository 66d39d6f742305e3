// SPDX-License-Identifier: GPL-3.0-or-later
// A render as a value: what is rendered, how it is spread and which files it writes. A call, a design of a
// sweep or a button makes one.
#pragma once
#include "Core/Modes/InstructionSet.h"
#include "Core/PanningLaws.h"
#include "Core/RenderingMethod.h"
#include "Live/Session/OnsetMarks.h"
#include "Live/Session/Patience.h"
#include "Scene/FieldSize.h"
#include "Scene/SceneFile.h"
#include "Scene/World/SceneRun.h"
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace physvib {

/// The recorded contact of a material, or of all events of a frequency.
struct RecordedSound {
    std::string material;     ///< empty: by frequency
    double frequencyHz = 0.0; ///< 0: by material
    std::string path;

    std::string name() const; ///< what a call says before the "="
    bool operator==(const RecordedSound&) const = default;
};
using RecordedSounds = std::vector<RecordedSound>;

constexpr double usualContactDb = -20.0; ///< of the contact sound of a hit at full scale

/// The defaults are those that --help shows.
struct RenderJob {
    std::string scene;      ///< a built-in scene's name or the path of a scene file; empty with fromEvents
    SceneSettings settings; ///< the scene's variables
    std::string fromEvents; ///< path of an event list
    std::string wavPath, eventsPath, picturePath, moviePath, patternPath; ///< empty: not wanted
    std::string pad; ///< profile of a game controller, whose motors' commands `wavPath` then holds; empty:
                     ///< samples
    double threshold = 0.1;      ///< of the pattern, in full scale
    double interfaceVolts = 0.0; ///< what a sample of 1 in the WAV becomes; 0: no matter
    double seconds = 10.0;
    int sampleRateHz = 48000;
    int blockFrames = 256;
    InstructionSet instructions = InstructionSet::best;
    std::uint32_t seed = 1;
    int stepsPerSecond = 100;
    double patienceSeconds = Patience::usualSeconds; ///< with a world that is simulated slower than it lasts
    std::string layout = "phone4";                   ///< preset or path of a layout file
    FieldSize field; ///< none: the scene's, the list's, or the layout's extent
    PanningLaw law = PanningLaw::linear;
    double exponent = 1.0;
    bool isLimited = true;
    ImpactLocation location = ImpactLocation::contact;
    ImpactTiming timing = ImpactTiming::onset;
    RenderingMethod method;       ///< its amplitude needs the layout
    bool playsRecordings = false; ///< SV: of `sounds`, instead of the method's modes
    double levelDb = 0.0;         ///< of all hits
    double gamma = 0.0;           ///< Eq. 5.5, the share at which a decay is cut; 0: it rings out
    bool isWeighted = false;      ///< hits of one amplitude feel more alike at all frequencies
    bool matchesStrength = false; ///< recordings are as strong as the mode; else as high
    RecordedSounds sounds;        ///< for SV and the contact sound
    std::string contactSound; ///< where it is heard: a WAV of `render`, outputs of `play`; empty: not wanted
    double contactSoundDb = usualContactDb; ///< of a hit at full scale
    std::string marker; ///< where onsets are marked: a WAV of `render`, outputs of `play`; empty: not wanted
    MarkedOnsets marked = MarkedOnsets::all;
    std::string actuator = "none";               ///< or "layout", a profile's name, a profile's path
    bool isEqualised = true, isRemapped = false; ///< with an actuator
    bool explains = false;                       ///< says what became of the scene's contacts
    std::string coupling; ///< path of a measured coupling that drives shall make up for; empty: none

    std::set<std::string> given; ///< names of the options that were chosen, with their dashes: a session
                                 ///< keeps its own where they are not
    /// of `render`
    std::vector<std::string> writtenPaths() const {
        return {wavPath, eventsPath, picturePath, moviePath, patternPath, contactSound, marker};
    }
    /// nullopt: not wanted
    std::optional<MarkedOnsets> marks() const {
        return marker.empty() ? std::nullopt : std::optional{marked};
    }
    std::string methodName() const; ///< "AV-FV-DRV", or "SV"

    bool operator==(const RenderJob&) const = default;
};

inline constexpr std::string_view recordingsHaveNoFrequency =
    "--remap: recordings have no frequency to be moved";
inline constexpr std::string_view recordingsHaveNoWeight =
    "--perceived-level: recordings have no one frequency to be weighted by";
/// What does not fit together of how a scene is felt: empty, or the usage error in one line. Any thread
/// (allocates), as the others.
std::string sceneFault(const RenderJob& job);

/// The same of all that says what is rendered.
std::string renderInputFault(const RenderJob& job);

/// The same, and of what says where to.
std::string renderFault(const RenderJob& job);

} // namespace physvib
