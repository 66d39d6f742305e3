// SPDX-License-Identifier: GPL-3.0-or-later
// Declares the options of `physvib render`: names, ranges and help texts.
#include "Calls/RenderOptions.h"
#include "Core/EventShaping.h"
#include "Formats/ClipFile.h"
#include "Io/Text/NameList.h"
#include "Io/Text/NumberText.h"
#include "Lab/Study/Stimulus.h"
#include "Live/Devices/AudioOutput.h"
#include "Scene/World/Simulation.h"
#include <algorithm>

namespace physvib {
static_assert(usualContactDb == safeContactDb, "as on a device");

void declareSceneOptions(OptionTable& command, RenderJob& o) {
    command.add("scene", o.scene,
                "a built-in scene (see `physvib scenes`), SCENE.json, or a CLIP" + listed(clipEndings) +
                    ", or (render, export) a saved SESSION.json, or (play) a SOUND.wav, .flac, .ogg");
    addSettings(command, o.settings);
    command.add("--seconds", o.seconds, "length").in(0.001, 86400.0, " s");
    command.add("--seed", o.seed, "seed of the scene").in(0u, 4294967295u);
    command.add("--layout", o.layout,
                listedByNumber(layoutPresetNames) + ", study1, dualsense or a layout file");
    addField(command, o.field);
    addLaw(command, o.law);
    command.add("--exponent", o.exponent, "exponent of the law").in(0.01, 100.0);
    command.addOneOf<Limiting>("--limiter", o.limiting,
                               {{"on", Limiting::on}, {"off", Limiting::off}, {"blocks", Limiting::blocks}},
                               "on, off, or each block by itself, as in the thesis");
    command.add("--steps-per-second", o.stepsPerSecond, "physics steps per second")
        .in(Simulation::minStepsPerSecond, Simulation::maxStepsPerSecond, " steps/s");
    command.addOneOf<ImpactLocation>(
        "--location", o.location,
        {{"contact", ImpactLocation::contact}, {"fixture", ImpactLocation::fixture}},
        "place of a hit: contact, or centre of the fixture");
    command.addOneOf<ImpactTiming>(
        "--timing", o.timing, {{"onset", ImpactTiming::onset}, {"release", ImpactTiming::release}},
        "a hit is felt when its contact begins (onset) or ends (release, at most 50 ms later)");
    addMethod(command, o);
    command.addOneOf<bool>("--fixed-level", o.fixesSum, {{"sum", true}, {"each", false}},
                           "of a fixed amplitude: the peak of all that sound together (sum), or of each hit, "
                           "as in the thesis (each)");
    addSounds(command, o.sounds,
              "for SV and --contact-sound: the recorded contact of a material, or HZ=FILE.wav of all of that "
              "frequency; FILE may be synthetic-SEED; may be repeated");
    command.addOneOf<bool>(
        "--sound-match", o.matchesStrength, {{"peak", false}, {"rms", true}},
        "level of recordings: their peak is the mode's (peak), or their strength over 0.25 s is (rms)");
    command.add("--level-db", o.levelDb, "all hits so much stronger or weaker")
        .in(-limits::maxLevelDb, limits::maxLevelDb, " dB");
    command
        .add("--gamma", o.gamma,
             "cut each decay where its envelope falls to this share, as Eq. 5.5 does with 0.1 (0: it rings "
             "out, without a click); recordings (SV) are played whole")
        .in(0.0, EventShaping::mostTruncation);
    command.addSwitch("--perceived-level", o.isWeighted,
                      "weight hits by how strong their frequency is felt, by at most 6 dB (on or off)");
    command
        .add("--contact-sound-db", o.contactSoundDb,
             "its level: that of a hit at full scale, in dB of full scale")
        .in(leastContactDb, mostContactDb, " dB");
    command.addOneOf<MarkedOnsets>(
        "--marker-of", o.marked,
        {{"all", MarkedOnsets::all}, {"hits", MarkedOnsets::hits}, {"messages", MarkedOnsets::messages}},
        "what --marker marks: all onsets, hits (no grains, no messages), or messages");
    command.add(
        "--actuator", o.actuator,
        "none, layout (those it names), or one for all: a name (see physvib actuators) or a profile's file");
    command.addSwitch("--equalise", o.isEqualised,
                      "with an actuator: make it flat within its band (on or off)");
    command.addSwitch("--remap", o.isRemapped,
                      "with an actuator: move all frequencies into its band, in their order (on or off)");
    command
        .add("--coupling", o.coupling,
             "measured coupling of the layout's actuators, made up for with at most 3 dB more drive (render)")
        .as("FILE.json");
}

void declareRenderOptions(OptionTable& command, RenderJob& o) {
    declareSceneOptions(command, o);
    command.add("--from-events", o.fromEvents, "render this event list instead of a scene").as("EVENTS.csv");
    command.add("--out", o.wavPath, "32-bit float WAV, one channel per actuator").written("FILE.wav");
    command
        .add("--pad", o.pad,
             "with --out MOTORS.csv: what the motors of that game controller would get instead of samples; a "
             "profile (pad-generic, pad-xbox, pad-dualshock) or its file")
        .as("PROFILE");
    command.add("--events", o.eventsPath, "the collisions as an event list").written("FILE.csv");
    command.add("--picture", o.picturePath, "world, waveforms and event marks").writtenAs("FILE.png");
    command
        .add("--movie", o.moviePath,
             "world, impacts and channels in time: .webp; with the program ffmpeg also .gif, and .mp4 with "
             "audio")
        .written("FILE.webp");
    command.add("--pattern", o.patternPath, "when a motor that is only on or off would be on, per channel")
        .written("FILE.csv");
    command.add("--explain", o.explains,
                "count the scene's contacts, and say why nothing or not everything is felt");
    command.add("--threshold", o.threshold, "of the pattern, in full scale").in(0.0, 1.0);
    command
        .add("--interface-volts", o.interfaceVolts,
             "with an actuator: scale the WAV so that full scale becomes its drive limit on an interface of "
             "this peak voltage")
        .in(0.001, 1000.0, " V");
    command
        .add("--contact-sound", o.contactSound,
             "what is heard of each hit, for headphones or loudspeakers, in sync with --out")
        .written("FILE.wav");
    command.add("--contact-sound-channels", o.contactSoundEars, "2: left and right, by place").in(1, 2);
    command.add("--marker", o.marker, "a pulse at the sample of each onset: one channel, in sync with --out")
        .written("FILE.wav");
    command.add("--rate", o.sampleRateHz, "sample rate")
        .in(limits::minSampleRateHz, limits::maxSampleRateHz, " Hz");
    command.add("--block", o.blockFrames, "frames per block; changes nothing but --limiter blocks")
        .in(1, limits::maxBlockFrames, " frames");
    command.addOneOf<InstructionSet>(
        "--instructions", o.instructions,
        {{"best", InstructionSet::best}, {"scalar", InstructionSet::scalar}},
        "best: the vectors of this processor, with the same bytes on all; scalar: double precision");
    command
        .add("--patience", o.patienceSeconds,
             "time-out: processor time, beyond its own length, that a world may take to simulate")
        .in(0.0, 1e7, " s");
}

void noteGiven(const OptionTable& command, RenderJob& o) {
    for (const Option& option : command.options)
        if (!option.said.empty()) o.given.insert(option.spellings.front());
}

namespace {

std::string readField(const std::string& word, FieldSize& field) {
    const auto read = parseField(word);
    if (!read) return std::string{expectedField} + inQuotes(word);
    field = *read;
    return {};
}

std::string readSettings(const std::vector<std::string>& words, SceneSettings& settings) {
    for (const std::string& word : words) {
        const auto equals = word.find('=');
        if (equals == 0 || equals == std::string::npos) return "expected NAME=VALUE";
        settings.emplace_back(word.substr(0, equals), word.substr(equals + 1));
    }
    return {};
}

std::string readSounds(const std::vector<std::string>& words, RecordedSounds& sounds) {
    for (const std::string& word : words) {
        const auto equals = word.find('=');
        const auto hz = parseNumber<double>(std::string_view{word}.substr(0, equals));
        if (equals == std::string::npos || equals == 0 || equals + 1 == word.size() || (hz && !(*hz > 0.0)))
            return "expected MATERIAL=FILE.wav, a material and its recorded contact, or HZ=FILE.wav, its "
                   "frequency";
        const RecordedSound sound{hz ? "" : word.substr(0, equals), hz.value_or(0.0),
                                  word.substr(equals + 1)};
        const auto isSame = [&](const RecordedSound& other) { return other.name() == sound.name(); };
        if (std::ranges::any_of(sounds, isSame))
            return "expected one recording of " + sound.name() + ", found another";
        sounds.push_back(sound);
    }
    return {};
}

std::string readLaw(const std::string& word, PanningLaw& law) {
    return panningLawNamed(word, law)
               ? std::string{}
               : "expected " + listed(panningLawNames, " or ") + ", found " + inQuotes(word);
}

std::string readMethod(const std::string& word, RenderJob& job) {
    job.playsRecordings = word == "SV";
    if (job.playsRecordings || renderingMethodNamed(word, job.method)) return {};
    return "expected a name from AV-FV-DRV to AF-FF-DRF, or SV, found " + inQuotes(word);
}

} // namespace

Option& addLaw(OptionTable& command, PanningLaw& law) {
    const auto read = [&law](const std::string& word) { return readLaw(word, law); };
    return command.addRead(stimulusWords::law, std::string{nameOf(law)}, read,
                           "panning law: " + listed(panningLawNames));
}

Option& addSounds(OptionTable& command, RecordedSounds& sounds, std::string says) {
    const WordsReader read = [&sounds](const std::vector<std::string>& words) {
        return readSounds(words, sounds);
    };
    return command.addRow("--sound", read, std::move(says)).as("MATERIAL=FILE.wav").single();
}

Option& addField(OptionTable& command, FieldSize& field) {
    const auto read = [&field](const std::string& word) { return readField(word, field); };
    return command
        .addRead("--field", {}, read,
                 "metres that x and y span (scene: its field; events: as they say, or the layout's extent)")
        .as("W,H");
}

Option& addSettings(OptionTable& command, SceneSettings& settings) {
    const WordsReader read = [&settings](const std::vector<std::string>& words) {
        return readSettings(words, settings);
    };
    return command.addRow("--set", read, "a variable of the scene; may be repeated")
        .as("NAME=VALUE")
        .single();
}

Option& addMethod(OptionTable& command, RenderJob& job) {
    const auto read = [&job](const std::string& word) { return readMethod(word, job); };
    return command.addRead("--method", job.methodName(), read,
                           "A{V,F}-F{V,F}-DR{V,F}: amplitude, frequency, decay varied by physics or fixed; "
                           "or SV, recorded contacts");
}

} // namespace physvib
