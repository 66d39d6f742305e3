// SPDX-License-Identifier: GPL-3.0-or-later
// The command `physvib play`: its options, and the setup of a live session.
#include "Calls/CallOptions.h"
#include "Calls/LoadedRender.h"
#include "CommandLine/Command.h"
#include "CommandLine/DeviceList.h"
#include "CommandLine/Music/BeatOptions.h"
#include "CommandLine/Play/LivePlay.h"
#include "Core/Units.h"
#include "Host/Osc/OscPort.h"
#include "Io/Disk/FileClash.h"
#include "Live/Devices/AudioDevice.h"
#include "Live/Pads/PadReports.h"
#include "Options/OptionTable.h"
#include "Scene/SceneEdits.h"
#include <algorithm>
#include <numbers>
#include <string>

namespace physvib {
namespace {

struct PlayOptions {
    RenderJob input;       ///< what is played, with its layout and panning
    LivePlaySettings live; ///< settings of the playback
    std::string device;
    std::string board;             ///< serial port of a four-channel board, alone or in addition to a device
    std::vector<std::string> pads; ///< game controllers: auto or NAME[@PROFILE]
    std::string map;               ///< "1,2,3,4": device outputs from 1, in the order of the actuators
    std::string onOff;             ///< actuators from 1 that are on/off motors; empty: none
    double threshold = OnOffSteps::thesisThreshold; ///< of these motors, as a share of full scale
    std::string noise;                              ///< outputs for pink noise, as in map; empty: none
    double noiseDb = PinkNoise::safeDb;             ///< root mean square, dB of full scale
    std::string driver = "thread";                  ///< or "message"
    bool takesLiveInput = false, isDirect = false;
    std::string beatInputs; ///< device inputs whose beats are played, as in map; empty: none
    BeatOptions beats;
    double oscTurnDegrees = 0.0;     ///< counter-clockwise rotation of a phone from upright
    double levelDb = defaultLevelDb; ///< master level
    std::string ceilings = "0";      ///< dB of full scale: one for all actuators, or one each
    int blockFrames = 0;             ///< 0: device default
};

/// "1,2,3" to {0, 1, 2}; an empty text gives an empty map, any other text an error.
std::string parseMap(std::string_view option, const std::string& example, const std::string& text,
                     std::vector<int>& map, int maxNumber = std::numeric_limits<int>::max()) {
    const auto isInRange = [maxNumber](int number) { return number >= 1 && number <= maxNumber; };
    if (!text.empty() && !(parseNumbers(text, map) && std::ranges::all_of(map, isInRange)))
        return std::string{option} + ": expected " + example + ", found " + inQuotes(text);
    for (int& output : map) --output;
    return {};
}

float toGain(double decibels) { return static_cast<float>(fromDecibels(decibels)); }

/// "-6" for all channels, or "-6,-12,-6,-6" for each; false for any other text.
bool parseCeilings(const std::string& text, int channels, std::array<float, limits::maxActuators>& ceilings) {
    std::vector<double> decibels;
    if (!parseNumbers(text, decibels)) return false;
    if (decibels.size() == 1) decibels.resize(static_cast<std::size_t>(channels), decibels[0]);
    const auto isCeiling = [](double dB) { return dB >= minCeilingDb && dB <= 0.0; };
    if (decibels.size() != static_cast<std::size_t>(channels) ||
        !std::all_of(decibels.begin(), decibels.end(), isCeiling))
        return false;
    std::transform(decibels.begin(), decibels.end(), ceilings.begin(), toGain);
    return true;
}

SessionSetup makeSetup(const PlayOptions& o, const LoadedRender& job) {
    SessionSetup setup = sessionSetup(job);
    if (!o.input.contactSound.empty()) setup.contactSound = job.recordings;
    if (o.input.contactSound.find(',') != std::string::npos) setup.contactChannels = 2;
    setup.marks = o.input.marks();
    if (o.isDirect) setup.direct = Direct::inputs;
    setup.longestGapSeconds =
        o.driver == "thread" ? threadGapSeconds(setup.stepsPerSecond) : messageTimerGapSeconds;
    if (!o.beatInputs.empty())
        setup.longestGapSeconds =
            std::max(setup.longestGapSeconds, LiveBeats::detectionDelaySeconds - 2.0 / setup.stepsPerSecond);
    return setup;
}

/// Selects the DualSense's device and coil outputs, and switches its coils to audio. Returns an exit code.
int prepareDualSense(AudioOutputSettings& settings, int channels) {
    if (settings.channelMap.empty() && channels != 2)
        return reportExit(exitUsage, "--device " + settings.device + ": it has two coils, this layout " +
                                         std::to_string(channels) + "; try --layout dualsense, or --map");
    if (settings.device == dualSenseDeviceName) {
        auto device = dualSenseDevice(listAudioDevices(systemAudioDrivers));
        if (!device) return reportExit(exitFailed, device.error);
        settings.device = std::move(device.value);
    }
    if (settings.channelMap.empty()) settings.channelMap = {dualsense::leftCoil, dualsense::rightCoil};
    if (const std::string note = switchCoilsToAudio(); !note.empty()) printMessage(note);
    return exitDone;
}

void declarePlayOptions(OptionTable& command, PlayOptions& o) {
    declareSceneOptions(command, o.input);
    command.add("--device", o.device, "output device (see physvib devices), or pico: the first Pico");
    command
        .add("--board", o.board, "four-channel board: serial port, or auto; alone, or together with a device")
        .as("PORT");
    command
        .add("--pad", o.pads,
             "game controller: its name or part of it, or auto, then, if wanted, @ and a profile; alone, or "
             "together with a device or a board; may be repeated (see physvib pads)")
        .as("NAME")
        .single();
    command.add("--map", o.map, "device outputs of the actuators, from 1").as("1,2,3,4");
    command.add("--driver", o.driver, "who steps the world: thread or message").oneOf({"thread", "message"});
    command.add("--level", o.levelDb, "master level in dB").in(-90.0, 0.0);
    command
        .add("--ceiling", o.ceilings,
             "drive ceiling in dB of full scale, before the master level: one for all, or one per actuator")
        .as("DB[,DB...]");
    command
        .add("--on-off", o.onOff,
             "actuators, from 1, that are motors which are only on or off: full scale in each 10 ms after "
             "one in which a sample exceeds --threshold")
        .as("1,2");
    command.add("--threshold", o.threshold, "of --on-off, in full scale").in(0.0, 1.0);
    command
        .add("--noise", o.noise,
             "other outputs of the device that play pink noise, from 1: masks what actuators sound like")
        .as("5,6");
    command.add("--noise-db", o.noiseDb, "its root mean square, in dB of full scale")
        .in(PinkNoise::minDb, PinkNoise::maxDb);
    command
        .add("--contact-sound", o.input.contactSound,
             "other outputs of the device on which each hit is heard, from 1; two: left and right")
        .as("5,6");
    command
        .add(
            "--marker", o.input.marker,
            "other outputs of the device with a pulse at the sample of each onset, from 1: for trigger boxes")
        .as("8");
    command.add("--block", o.blockFrames, "frames per block; 0: device default")
        .in(0, limits::maxBlockFrames)
        .hideDefault();
    command.add("--record", o.live.rig.recordPath, "WAV of what was played, before the master level")
        .outputFile("FILE.wav");
    command
        .add("--save", o.live.rig.savePath,
             "the session, to render it again; what was played beside it as .events.csv")
        .outputFileNamed("FILE.json");
    command
        .add("--beats", o.beatInputs,
             "inputs of the device, from 1, whose music is felt: its beats are struck (Docs/music.md)")
        .as("1,2");
    declareBeatOptions(command, o.beats);
    command.add("--hands", o.takesLiveInput,
                "disable the scene's scripted user input; take it from --listen instead");
    command.add("--direct", o.isDirect,
                "low-latency mode for messages and controls: one block plus the limiter's look-ahead. "
                "Collisions keep the normal output latency");
    command.add("--listen", o.live.readsInput,
                "take inputs and controls from standard input, a line of JSON each (Docs/sessions.md)");
    command.add("--keep-playing", o.live.keepsPlaying,
                "play on when standard input has ended, until --seconds are over: for a file of lines. "
                "Without it that is silence and the end: who controls may have died");
    command
        .add("--clips", o.live.clips, "folder from which messages of --listen and --osc may have clips read")
        .as("FOLDER")
        .existingFolder();
    command
        .add("--osc", o.live.osc.port,
             "take messages by OSC (Docs/osc.md) at this port of UDP, or the next free one; 0: any")
        .as("PORT")
        .in(0, 65'535);
    command
        .add("--osc-interface", o.live.osc.address,
             "address of this computer at which they are taken; 0.0.0.0: any, for phones")
        .as("ADDRESS");
    command
        .add("--osc-turn", o.oscTurnDegrees,
             "by how much a phone that tilts the scene is held counter-clockwise of upright")
        .as("DEGREES")
        .in(-180.0, 180.0)
        .hideDefault();
    command.add("--osc-to", o.live.osc.receiver, "send each hit as it is felt, and the status once a second")
        .as("HOST:PORT");
}

bool isGiven(const OptionTable& command, std::string_view name) {
    return std::ranges::any_of(command.options, [&](const Option& option) {
        return option.spellings.front() == name && !option.arguments.empty();
    });
}

/// Without a device: lists the available ones, and prints a complete example call.
int suggestDevices(const std::string& scene) {
    const auto devices = availableDevices();
    printDevices(std::cout, devices);
    std::cout << (devices.empty() ? "no audio device was found; for nobody, in time: " : "for example: ")
              << suggestedPlayCall(scene, devices) << '\n'
              << std::flush;
    return reportExit(exitUsage, "play: expected --device, --board or --pad");
}

int runPlay(const OptionTable& command, PlayOptions& o) {
    OutputNames outputs{o.device};
    o.device = outputs.device;
    if (!o.board.empty()) outputs.sinks.push_back({"BOARD", o.board});
    for (const std::string& pad : o.pads) outputs.sinks.push_back({"PAD", pad});
    if (o.device.empty() && outputs.sinks.empty()) return suggestDevices(o.input.scene);
    if (o.device.empty()) { // boards and controllers alone: a timer requests the blocks
        o.device = OutputNames{"BOARD:"}.device;
        for (const char* option : {"--map", "--on-off", "--threshold", "--noise", "--noise-db",
                                   "--contact-sound", "--marker", "--beats"})
            if (isGiven(command, option))
                return reportExit(exitUsage,
                                  std::string{option} + ": expected a --device, as it is of its channels");
    }
    // options that a board or a live session cannot apply
    const bool hasBoard = std::ranges::find(outputs.sinks, "BOARD", &SinkName::kind) != outputs.sinks.end();
    if (auto error = sceneOptionsError(o.input); !error.empty()) return reportExit(exitUsage, error);
    if (!o.input.coupling.empty()) return reportExit(exitUsage, "--coupling: not yet live; render has it");
    if (o.input.limiting == Limiting::blocks && !o.live.rig.savePath.empty())
        return reportExit(exitUsage,
                          "--limiter blocks: expected no --save, as a session does not keep blocks");
    const bool isBoardPlayable = o.input.method.fixesNothing() && !o.input.playsRecordings &&
                                 o.input.actuator == "none" && o.input.levelDb == 0.0 &&
                                 o.input.gamma == 0.0 && !o.input.isWeighted;
    if (hasBoard && !isBoardPlayable)
        return reportExit(exitUsage,
                          "--board: not yet with --method, --level-db, --gamma, --perceived-level and "
                          "--actuator; render --events, then board PORT play, has them");
    if (o.isDirect && hasBoard)
        return reportExit(exitUsage,
                          "--direct: a board has to know of a strike earlier; expected no --board");
    // scene or sound file, layout, actuators and recordings
    if (const auto preset = picoLayoutPreset(systemAudioDrivers, o.device);
        !preset.empty() && !isGiven(command, "--layout"))
        o.input.layout = preset;
    LoadedRender job{o.input, {}, {}, {}, {}};
    std::optional<LoadedClip> sound;
    if (isSoundFile(o.input.scene)) {
        if (!outputs.sinks.empty())
            return reportExit(exitUsage, o.input.scene + ": boards and controllers play no recordings; "
                                                         "expected a --device alone");
        recordGivenOptions(command, o.input);
        auto loaded = loadSound(o.input, o.device, job);
        if (!loaded) return reportExit(exitFailed, loaded.error);
        sound = std::move(loaded.value);
    } else if (const int code = loadSceneInto(job); code != exitDone)
        return code;
    if (o.takesLiveInput) job.scene = sceneForUserInput(std::move(*job.scene));
    auto layout = resolveLayout(o.input.layout);
    if (!layout) return reportExit(exitFailed, layout.error);
    auto calibrated = calibratedLayout(o.input, std::move(layout.value));
    if (!calibrated) return reportExit(exitFailed, calibrated.error);
    job.layout = std::move(calibrated.value);
    if (!o.board.empty() && job.channels() > limits::board::channels)
        return reportExit(exitUsage, "--board: the board has four channels, this layout " +
                                         std::to_string(job.channels()));
    if (auto error = channelCountError(outputs.sinks, job.channels()); !error.empty())
        return reportExit(exitUsage, error);
    if (auto error = fixedLevelError(job); !error.empty()) return reportExit(exitFailed, error);
    if (auto error = sound ? soundError(*sound, job) : ""; !error.empty())
        return reportExit(exitUsage, error);
    auto actuators = chooseActuators(o.input, job.layout);
    if (!actuators) return reportExit(exitFailed, actuators.error);
    job.actuators = std::move(actuators.value);
    for (const std::string& line :
         remapWarnings(job.actuators.remap, materialSounds(*job.scene), job.layout, o.input))
        printMessage("warning: " + line);
    if (auto error = loadNamedRecordings(job, materialSounds(*job.scene), o.input.scene); !error.empty())
        return reportExit(exitFailed, error);
    for (const std::string& note : recordingNotes(job.recordings)) printMessage(note);
    for (const std::string& line : calibrationWarnings(o.input, job.layout)) printMessage("warning: " + line);
    for (const std::string& line : levelNotes(job.actuators, o.input.sampleRateHz)) printMessage(line);
    const std::vector<std::string> outputPaths{
        o.live.rig.recordPath, o.live.rig.savePath,
        o.live.rig.savePath.empty()
            ? ""
            : std::filesystem::path{o.live.rig.savePath}.replace_extension(".events.csv").string()};
    if (auto clash = fileClashError(outputPaths, job.namedInputs()); !clash.empty())
        return reportExit(exitUsage, clash);
    // device outputs, and what they play besides the actuators' signals
    AudioOutputSettings settings{o.device, {}, 0, o.blockFrames, toGain(o.levelDb)};
    const std::string actuatorsExample = "actuators like 1,2, of " + std::to_string(job.channels());
    ListeningSettings& listening = settings.listening;
    for (const std::string& error :
         {parseMap("--map", "outputs like 1,2,3,4", o.map, settings.channelMap),
          parseMap("--on-off", actuatorsExample, o.onOff, settings.onOffActuators, job.channels()),
          parseMap("--noise", "outputs like 5,6", o.noise, listening.noise),
          parseMap("--contact-sound", "outputs like 5,6", o.input.contactSound, listening.contacts),
          parseMap("--marker", "outputs like 8", o.input.marker, listening.marks),
          parseMap("--beats", "inputs like 1,2", o.beatInputs, settings.inputs)})
        if (!error.empty()) return reportExit(exitUsage, error);
    if (dualsense::isDevice(o.device))
        if (const int code = prepareDualSense(settings, job.channels()); code != exitDone) return code;
    settings.onOffThreshold = o.threshold;
    listening.noiseDb = o.noiseDb;
    listening.contactDb = o.input.contactSoundDb;
    const auto voices = parseBeatVoices(o.beats, job.channels());
    if (!voices) return reportExit(exitUsage, voices.error);
    // the session
    SessionSetup setup = makeSetup(o, job);
    if (!parseCeilings(o.ceilings, setup.channels, setup.ceilings))
        return reportExit(exitUsage,
                          "--ceiling: expected one number of dB from -60 to 0, or one per actuator (" +
                              std::to_string(setup.channels) + "), found \"" + o.ceilings + "\"");
    if (hasBoard && std::ranges::any_of(setup.ceilings, [](float ceiling) { return ceiling < 1.0f; }))
        return reportExit(exitUsage,
                          "--ceiling: a board has none below full scale; expected a lower --level");
    setup.log = LogUse::none;
    LivePlaySettings& live = o.live;
    live.rig.setup = setup;
    live.rig.output = settings;
    live.rig.sinks = outputs.sinks;
    live.rig.hasOwnThread = o.driver == "thread";
    live.rig.provenance = {PHYSVIB_VERSION, {{"scene", setup.scene.name}, {"session", live.rig.savePath}}};
    live.seconds = o.input.seconds;
    live.beatSensitivity = o.beats.sensitivity;
    live.osc.phoneAngleRadians = o.oscTurnDegrees * std::numbers::pi / 180.0;
    live.sound = std::move(sound);
    if (!settings.inputs.empty()) live.beats = voices.value;
    const std::string error = playLive(std::move(live));
    return error.empty() ? exitDone : reportExit(exitFailed, error);
}

} // namespace

Command playCommand() {
    return makeCommand("play", "play a scene or a sound live on an audio device", declarePlayOptions,
                       runPlay);
}

} // namespace physvib
