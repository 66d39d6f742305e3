// SPDX-License-Identifier: MIT
// A render as a value: what is rendered, how it is spread and which files it writes. A call, a design of a sweep or a button makes one.
#pragma once
#include "Core/PhantomPanner.h"
#include "Core/RenderingMethod.h"
#include "Scene/SceneFile.h"
#include "Session/OnsetMarks.h"
#include "Session/Patience.h"
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace physvib {

constexpr double usualContactDb = -20.0; ///< of the contact sound of a hit at full scale

/// The defaults are those that --help shows.
struct RenderJob {
    std::string scene;      ///< a built-in scene's name or the path of a scene file; empty with fromEvents
    std::vector<std::string> sets; ///< "NAME=VALUE" of the scene's variables
    std::string fromEvents; ///< path of an event list
    std::string wavPath, eventsPath, picturePath, patternPath; ///< empty: not wanted
    double threshold = 0.1;      ///< of the pattern, in full scale
    double interfaceVolts = 0.0; ///< what a sample of 1 in the WAV becomes; 0: no matter
    double seconds = 10.0;
    int sampleRateHz = 48000;
    int blockFrames = 256;
    std::string instructions = "best"; ///< or "scalar"
    std::uint32_t seed = 1;
    int stepsPerSecond = 100;
    double patienceSeconds = Patience::usualSeconds; ///< with a world that is simulated slower than it lasts
    std::string layout = "phone4"; ///< preset or path of a layout file
    std::string field;             ///< "W,H" in metres; empty: the scene's, or the layout's extent
    std::string law = "linear";
    double exponent = 1.0;
    std::string limiter = "on";
    std::string location = "contact", timing = "onset", method = "AV-FV-DRV";
    double levelDb = 0.0;            ///< of all hits
    double gamma = 0.0;              ///< Eq. 5.5, the share at which a decay is cut; 0: it rings out
    std::string perceivedLevel = "off"; ///< on: hits of one amplitude feel more alike at all frequencies
    std::string soundMatch = "peak"; ///< of recordings: as high as the mode, or ("rms") as strong
    std::vector<std::string> sounds; ///< "HZ=FILE.wav" for SV and the contact sound
    std::string contactSound;        ///< where it is heard: a WAV of `render`, outputs of `play`; empty: not wanted
    double contactSoundDb = usualContactDb; ///< of a hit at full scale
    std::string marker;              ///< where onsets are marked: a WAV of `render`, outputs of `play`; empty: not wanted
    std::string markerOf = "all";    ///< of which
    std::string actuator = "none"; ///< or "layout", a profile's name, a profile's path
    std::string equalise = "on", remap = "off"; ///< with an actuator
    bool explain = false; ///< tell what became of the scene's contacts
    std::string coupling; ///< path of a measured coupling that drives shall make up for; empty: none

    std::set<std::string> given; ///< names of the options that were chosen, with their dashes: a session keeps its own where they are not
    SceneSettings settings; ///< from `sets` by renderFault
    double fieldWidthMetres = 0.0, fieldHeightMetres = 0.0; ///< from `field` by renderFault; 0: not given
    PanningLaw panningLaw = PanningLaw::linear;             ///< from `law`
    std::vector<std::string> writtenPaths() const { return {wavPath, eventsPath, picturePath, patternPath, contactSound, marker}; } ///< of `render`
    std::optional<MarkedOnsets> marks() const; ///< nullopt: not wanted
    bool playsRecordings() const { return method == "SV"; }
    std::vector<std::pair<double, std::string>> recordings; ///< from `sounds`: of which frequency, in which file
    RenderingMethod renderingMethod;                        ///< from `method`; its amplitude needs the layout

    bool operator==(const RenderJob&) const = default;
};

inline constexpr std::string_view recordingsHaveNoFrequency = "--remap: recordings have no frequency to be moved";
inline constexpr std::string_view recordingsHaveNoWeight = "--perceived-level: recordings have no one frequency to be weighted by";
inline constexpr std::string_view soundExpectation = "--sound: expected HZ=FILE.wav, the frequency of a material and its recorded contact";

/// Appends what --sound says, "HZ=FILE.wav"; false if one is anything else.
bool parseSounds(const std::vector<std::string>& sounds, std::vector<std::pair<double, std::string>>& recordings);

/// What parsing cannot see of the scene options: empty, or the usage error in one line.
std::string sceneFault(RenderJob& job);

/// The same of all options of `render` that say what is rendered.
std::string renderInputFault(RenderJob& job);

/// The same, and of those that say where to.
std::string renderFault(RenderJob& job);

} // namespace physvib
