// SPDX-License-Identifier: GPL-3.0-or-later
// The command `physvib calibrate`: measures an actuator by a device or two files, and writes its profile.
#include "CommandLine/Command.h"
#include "CommandLine/Measure/RecordingList.h"
#include "Core/Units.h"
#include "Io/Disk/AtomicFile.h"
#include "Io/Disk/FileClash.h"
#include "Io/Text/NumberText.h"
#include "Io/Wav/WavSink.h"
#include "Live/Devices/AudioDevice.h"
#include "Live/Devices/AudioOutput.h"
#include "Live/Devices/SweepRecorder.h"
#include "Live/Recordings/ReadRecording.h"
#include "Measure/ActuatorMeasurement.h"
#include "Scene/ActuatorFile.h"
#include "Scene/LayoutFile.h"
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace physvib {
namespace {

struct CalibrateOptions {
    std::string device;
    int channel = 1, input = 1;           ///< from 1
    int sampleRateHz = 0;                 ///< 0: device default
    std::string playedPath, recordedPath; ///< WAV files that replace a device
    std::string sweepPath;                ///< only write the sweep to this file
    std::string profilePath;              ///< output
    std::string layout, layoutPath; ///< to write with the profile and its measured full scale; empty: none
    std::string placeLabel;         ///< label of the measured actuator in the layout; empty: all are equal
    bool isLoopback = false; ///< measure the latency of a cable instead of an actuator; writes no profile
    std::string name = "calibrated";
    std::string band; ///< declared band "LO-HI"; empty: within 10 dB of the peak
    double levelDb = -12.0, seconds = 5.0;
    double gPerUnit = 0.0;   ///< acceleration of a recorded sample of 1; 0: unknown
    double driveVolts = 0.0; ///< voltage of a played sample of 1; 0: unknown
};

constexpr double bandDecibels = 10.0; // below the peak, at the edges of a profile's default band

SweepSettings sweepSettings(const CalibrateOptions& o) {
    return {.seconds = o.seconds, .level = fromDecibels(o.levelDb)};
}

/// Reads channel 1 of each file.
Result<RecordedSweep> readSweepFiles(const CalibrateOptions& o) {
    auto played = readRecording(o.playedPath);
    if (!played) return Failure{played.error};
    auto recorded = readRecording(o.recordedPath);
    if (!recorded) return Failure{recorded.error};
    if (played.value.sampleRateHz != recorded.value.sampleRateHz)
        return Failure{o.recordedPath + ": expected the rate of " + o.playedPath + ", " +
                       std::to_string(played.value.sampleRateHz) + " Hz, found " +
                       std::to_string(recorded.value.sampleRateHz) + " Hz"};
    return RecordedSweep{static_cast<double>(played.value.sampleRateHz),
                         std::move(played.value.channels.front()), std::move(recorded.value.channels.front()),
                         -1};
}

Result<RecordedSweep> measure(const CalibrateOptions& o) {
    if (o.device.empty()) return readSweepFiles(o);
    return recordSweep(
        {o.device, o.channel - 1, o.input - 1, o.sampleRateHz},
        [&](double rateHz) { return makeSweep(sweepSettings(o), rateHz); }, systemAudioDrivers);
}

ActuatorProfile makeProfile(const CalibrateOptions& o, const MeasuredActuator& m) {
    ActuatorProfile profile;
    profile.name = o.name;
    profile.description = "measured";
    profile.source = "physvib calibrate " PHYSVIB_VERSION ": sweep at " + numberText(m.rateHz) + " Hz, " +
                     fixedNumber(100.0 * (1.0 - m.residualShare), 2) + " % explained";
    profile.resonanceHz = m.resonator.resonanceHz;
    profile.q = m.resonator.q;
    profile.band = m.bandWithin(bandDecibels, SweepSettings{}.band);
    if (!o.band.empty()) profile.band = parseBand(o.band).value;
    if (!profile.band->isKnown()) profile.band.reset();
    if (o.gPerUnit > 0.0) profile.fullScaleG = std::abs(m.gain) * o.gPerUnit;
    if (o.driveVolts > 0.0) profile.driveLimitVolts = o.driveVolts;
    profile.delaySeconds = std::max(0.0, m.delaySeconds);
    return profile;
}

int writeSweep(const CalibrateOptions& o) {
    const int rate = o.sampleRateHz > 0 ? o.sampleRateHz : 48000;
    WavSink wav(o.sweepPath, 1, rate, "physvib " PHYSVIB_VERSION " sweep");
    const auto samples = makeSweep(sweepSettings(o), rate);
    const float* const channel = samples.data();
    wav.write(&channel, static_cast<int>(samples.size()));
    if (const std::string& error = wav.finish(); !error.empty()) return reportExit(exitFailed, error);
    std::cout << o.sweepPath
              << "  play it, record what the actuator does, and give both to physvib calibrate\n";
    return exitDone;
}

std::string sweepSource(const CalibrateOptions& o) { return o.device.empty() ? o.recordedPath : o.device; }

/// The layout with profile and full scale at the measured place, or at all places; or one error line.
Result<LayoutDescription> makeLayout(const CalibrateOptions& o, double fullScaleG) {
    auto layout = resolveLayout(o.layout);
    if (!layout) return layout;
    bool hasPlace = false;
    for (ActuatorDescription& actuator : layout.value.actuators) {
        if (!o.placeLabel.empty() && actuator.label != o.placeLabel) continue;
        hasPlace = true;
        actuator.actuator = o.profilePath;
        actuator.fullScaleG = fullScaleG;
    }
    if (!hasPlace) return Failure{"--place: " + o.layout + " has no actuator " + inQuotes(o.placeLabel)};
    const auto read = readLayout(layoutJson(layout.value), o.layoutPath);
    return read ? layout : Failure{read.error};
}

/// Checks the requested layout before anything vibrates; empty if it is valid.
std::string layoutError(const CalibrateOptions& o) {
    return o.layout.empty() ? std::string{} : makeLayout(o, 1.0).error;
}

/// Explains how to use the measured full scale for levels in g.
void printLayoutAdvice(const CalibrateOptions& o, const ActuatorProfile& profile) {
    if (!profile.fullScaleG)
        return void(std::cout << "full scale in g is not known: give --g-per-unit, the acceleration that a "
                                 "recorded sample of 1 stands for\n");
    std::cout << "full scale " << fixedNumber(*profile.fullScaleG, 3) << " g: ";
    if (!o.layoutPath.empty())
        std::cout << o.layoutPath << " has it\n";
    else
        std::cout << "render and play use it with --actuator " << o.profilePath
                  << "; for studies and the mixer write a layout that has it: --layout phone4 --layout-out "
                     "FILE.json\n";
}

/// Measures, and reports device errors.
Result<RecordedSweep> measureAndWarn(const CalibrateOptions& o) {
    auto sweep = measure(o);
    if (sweep && sweep.value.xruns > 0) // -1: not counted
        warnIfAny(static_cast<std::uint64_t>(sweep.value.xruns), "xruns of the device during the sweep");
    return sweep;
}

int printLoopback(const CalibrateOptions& o) {
    const auto sweep = measureAndWarn(o);
    if (!sweep) return reportExit(exitFailed, sweep.error);
    const auto loopback = fitLoopback(sweep.value.played, sweep.value.recorded, sweep.value.rateHz);
    if (!loopback) return reportExit(exitFailed, sweepSource(o) + ": " + loopback.error);
    const MeasuredLoopback& m = loopback.value;
    std::cout << "latency of the loop " << fixedNumber(1e3 * m.delaySeconds, 3) << " ms, "
              << fixedNumber(m.delaySeconds * sweep.value.rateHz, 2) << " frames at "
              << numberText(sweep.value.rateHz) << " Hz; gain " << fixedNumber(m.gain, 4) << "; "
              << fixedNumber(100.0 * (1.0 - m.residualShare), 2) << " % explained\n";
    return exitDone;
}

std::string optionsError(const CalibrateOptions& o) {
    const bool isPair = !o.playedPath.empty() || !o.recordedPath.empty();
    if (!o.sweepPath.empty())
        return isPair || !o.device.empty() || !o.profilePath.empty() ? "calibrate: --sweep stands alone" : "";
    if (isPair == !o.device.empty())
        return "calibrate: expected --device, or --played and --recorded, or --sweep";
    if (isPair && (o.playedPath.empty() || o.recordedPath.empty()))
        return "calibrate: expected both --played and --recorded";
    if (o.isLoopback)
        return o.profilePath.empty() ? "" : "calibrate: --loopback measures a cable and writes no profile";
    if (o.profilePath.empty()) return "calibrate: expected --out FILE.json";
    if (o.layoutPath.empty() != o.layout.empty()) return "calibrate: expected both --layout and --layout-out";
    if (o.layoutPath.empty() && !o.placeLabel.empty())
        return "--place: expected with --layout and --layout-out";
    if (!o.layoutPath.empty() && o.gPerUnit <= 0.0)
        return "--layout-out: expected --g-per-unit, without which the full scale in g is not known";
    return o.band.empty() ? std::string{} : parseBand(o.band).error;
}

void declareCalibrate(OptionTable& command, CalibrateOptions& o) {
    command.add("--device", o.device, "device that plays and records (see physvib devices)");
    command.add("--channel", o.channel, "output of the actuator, from 1").in(1, 256);
    command.add("--input", o.input, "input of the accelerometer or microphone, from 1").in(1, 256);
    command.add("--rate", o.sampleRateHz, "sample rate; left out: as the device stands, 48000 for a file")
        .in(limits::minSampleRateHz, limits::maxSampleRateHz);
    command.add("--played", o.playedPath, "what was played elsewhere").as("FILE.wav");
    command.add("--recorded", o.recordedPath, "what was recorded of it, begun at the same moment")
        .as("FILE.wav");
    command.add("--sweep", o.sweepPath, "only write the sweep").outputFile("FILE.wav");
    command.add("--out", o.profilePath, "the profile").outputFileNamed("FILE.json");
    command.add("--layout", o.layout,
                "also write this layout with the profile and its full scale in g: a preset or a layout file");
    command.add("--layout-out", o.layoutPath, "where that layout goes").outputFileNamed("FILE.json");
    command
        .add("--place", o.placeLabel,
             "label of the one actuator of the layout that was measured; left out: all of them")
        .as("LABEL");
    command.add("--loopback", o.isLoopback,
                "a cable from the output to the input: tell the latency of the loop");
    command.add("--name", o.name, "of the profile");
    command.add("--band", o.band, "to declare; left out: where it is within 10 dB of its peak").as("LO-HI");
    command.add("--level", o.levelDb, "peak of the sweep in dB of full scale").in(-60.0, 0.0);
    command.add("--seconds", o.seconds, "length of the sweep").in(1.0, 60.0);
    command.add("--g-per-unit", o.gPerUnit, "acceleration in g that a recorded sample of 1 stands for")
        .positive();
    command.add("--drive-volts", o.driveVolts, "voltage that a played sample of 1 becomes").positive();
}

int runCalibrate(const CalibrateOptions& o) {
    if (const auto error = optionsError(o); !error.empty()) return reportExit(exitUsage, error);
    if (!o.sweepPath.empty()) return writeSweep(o);
    if (o.isLoopback) return printLoopback(o);
    const std::vector<std::string> outputs{o.profilePath, o.layoutPath},
        inputs{o.playedPath, o.recordedPath, o.layout};
    if (const std::string clash = fileClashError(outputs, inputs); !clash.empty())
        return reportExit(exitUsage, clash);
    AtomicFile file(o.profilePath); // opened before anything vibrates
    std::optional<AtomicFile> layoutFile;
    if (!o.layoutPath.empty()) layoutFile.emplace(o.layoutPath);
    for (const std::string& error :
         {file.error(), layoutFile ? layoutFile->error() : std::string{}, layoutError(o)})
        if (!error.empty()) return reportExit(exitFailed, error);
    const auto sweep = measureAndWarn(o);
    if (!sweep) return reportExit(exitFailed, sweep.error);
    const auto measured = fitActuator(sweep.value.played, sweep.value.recorded, sweep.value.rateHz);
    if (!measured) return reportExit(exitFailed, sweepSource(o) + ": " + measured.error);
    const ActuatorProfile profile = makeProfile(o, measured.value);
    if (const auto read = readActuator(actuatorJson(profile), o.profilePath); !read)
        return reportExit(exitFailed, read.error);
    if (layoutFile) {
        const auto layout = makeLayout(o, profile.fullScaleG.value_or(1.0));
        if (!layout) return reportExit(exitFailed, layout.error);
        layoutFile->write(layoutJson(layout.value));
    }
    file.write(actuatorJson(profile));
    for (AtomicFile* const outputFile : {&file, layoutFile ? &*layoutFile : nullptr})
        if (outputFile != nullptr && !outputFile->commit().empty())
            return reportExit(exitFailed, outputFile->error());
    const MeasuredActuator& m = measured.value;
    std::cout << o.profilePath << "  " << fixedNumber(m.resonator.resonanceHz, 2) << " Hz, Q "
              << fixedNumber(m.resonator.q, 2) << ", gain " << fixedNumber(m.gain, 4) << ", delay "
              << fixedNumber(1e3 * m.delaySeconds, 2) << " ms; "
              << fixedNumber(100.0 * (1.0 - m.residualShare), 2) << " % explained\n";
    printLayoutAdvice(o, profile);
    return exitDone;
}

} // namespace

Command calibrateCommand() {
    return makeCommand("calibrate", "measure an actuator and write its profile", declareCalibrate,
                       runCalibrate);
}

} // namespace physvib
