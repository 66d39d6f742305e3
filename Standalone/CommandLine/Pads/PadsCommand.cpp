// SPDX-License-Identifier: GPL-3.0-or-later
// The command `physvib pads`: lists game controllers, and tests and calibrates their motors.
#include "CommandLine/Command.h"
#include "CommandLine/DeviceList.h"
#include "Io/Disk/AtomicFile.h"
#include "Io/Text/NumberText.h"
#include "Live/Devices/AudioDevice.h"
#include "Live/Devices/SinkTable.h"
#include "Live/Pads/PadTrial.h"
#include "Scene/PadFile.h"
#include "System/Process.h"
#include <chrono>
#include <iostream>
#include <thread>

namespace physvib {
namespace {

struct PadsOptions {
    std::string action = "list";
    std::string pad = anyPad;
    std::string profilePath, name;
};

constexpr auto searchTime = std::chrono::milliseconds{1500}; // Bluetooth controllers need a second

PadTrialClock makeTrialClock(GamePads& pads) {
    const auto seconds = [] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
    };
    const auto tick = [&pads] {
        pads.update();
        std::this_thread::sleep_for(std::chrono::milliseconds{1});
    };
    return {seconds, tick, [] { return !interrupted.load(); }};
}

std::string describeAbilities(const GamePadInfo& info, const std::vector<AudioDeviceName>& audioDevices) {
    std::string text = info.hasMotors ? "two motors" : "no motors";
    if (info.hasTriggers) text += ", triggers";
    if (info.hasAccelerometer) text += ", accelerometer";
    if (!info.isDualSense) return text;
    const auto sound = dualSenseDevice(audioDevices);
    return text + (sound ? ", coils at " + sound.value + " (--device dualsense --layout dualsense)"
                   : info.bus == PadBus::bluetooth ? ", coils (--device DUALSENSE:auto --layout dualsense)"
                                                   : ", coils by USB sound (not there)");
}

int listPads() {
    GamePads pads{GamePads::Driver::sdl}; // only SDL's drivers report accelerometers
    if (!pads.error().empty()) return reportExit(exitFailed, pads.error());
    for (const auto end = std::chrono::steady_clock::now() + searchTime;
         pads.list().empty() && std::chrono::steady_clock::now() < end;)
        makeTrialClock(pads).tick();
    const auto connectedPads = pads.list();
    const bool hasDualSense = std::ranges::any_of(connectedPads, &GamePadInfo::isDualSense);
    const auto audioDevices =
        hasDualSense ? listAudioDevices(systemAudioDrivers) : std::vector<AudioDeviceName>{};
    for (const GamePadInfo& info : connectedPads)
        std::cout << info.name << "  " << busName(info.bus) << ", " << describeAbilities(info, audioDevices)
                  << "  profile " << info.profile << '\n';
    bool hasAny = !connectedPads.empty();
    for (const SinkKind& kind : sinkKinds()) // controllers with coils or more motors
        for (const SinkUnit& unit : kind.acceptsRawReports ? kind.listUnits() : std::vector<SinkUnit>{}) {
            std::cout << unit.label << "  " << unit.address << "  --device " << kind.name << ':'
                      << unit.address << '\n';
            hasAny = true;
        }
    if (!hasAny) printMessage("no game controller is there");
    return exitDone;
}

/// The requested controller, or one error line.
Result<std::unique_ptr<GamePad>> awaitPad(GamePads& pads, const std::string& name) {
    if (!pads.error().empty()) return Failure{pads.error()};
    for (const auto end = std::chrono::steady_clock::now() + searchTime;
         std::chrono::steady_clock::now() < end && !interrupted; makeTrialClock(pads).tick())
        if (auto pad = pads.open(name)) return pad;
    return Failure{name == anyPad ? "no game controller with motors is there"
                                  : "no game controller with motors is called " + inQuotes(name)};
}

int testMotors(const PadsOptions& o) {
    installInterruptHandlers();
    GamePads pads;
    auto foundPad = awaitPad(pads, o.pad);
    if (!foundPad) return reportExit(exitFailed, foundPad.error);
    GamePad& pad = *foundPad.value;
    auto profile = findPad(pad.info().profile);
    PadModel law = profile.value.law;
    law.commandsPerSecond = std::min(law.commandsPerSecond, maxCommandsPerSecond(pad.info().bus));
    const PadTrialClock clock = makeTrialClock(pads);
    std::cout << pad.info().name << ", " << profile.value.name << '\n';
    const std::string error =
        tryMotors(pad, law, clock, [](const std::string& line) { std::cout << line << std::endl; });
    return error.empty() ? exitDone : reportExit(exitFailed, error);
}

int calibrateMotors(const PadsOptions& o) {
    if (o.profilePath.empty()) return reportExit(exitUsage, "pads calibrate: expected --out FILE.json");
    AtomicFile file(o.profilePath); // opened before anything vibrates
    if (!file.error().empty()) return reportExit(exitFailed, file.error());
    installInterruptHandlers();
    GamePads pads{GamePads::Driver::sdl};
    auto foundPad = awaitPad(pads, o.pad);
    if (!foundPad) return reportExit(exitFailed, foundPad.error);
    GamePad& pad = *foundPad.value;
    PadProfile profile = findPad(pad.info().profile).value;
    for (const bool isHeavy : {true, false}) {
        std::cout << (isHeavy ? "heavy" : "light")
                  << " motor, 15 s: leave the controller alone, on something soft" << std::endl;
        const auto steps = recordMotor(pad, isHeavy, makeTrialClock(pads));
        const auto motor = steps ? fitMotor(steps.value) : Result<PadMotor>{Failure{steps.error}};
        if (!motor) return reportExit(exitFailed, motor.error);
        const PadMotor& m = isHeavy ? profile.law.low = motor.value : profile.law.high = motor.value;
        std::cout << "nothing below " << numberText(m.threshold) << ", half at " << numberText(m.half)
                  << ", full at " << numberText(m.full) << ", rises in "
                  << fixedNumber(1e3 * m.riseSeconds, 0) << " ms, falls in "
                  << fixedNumber(1e3 * m.fallSeconds, 0) << " ms\n";
    }
    profile.name = o.name.empty() ? std::filesystem::path{o.profilePath}.stem().string() : o.name;
    profile.description = "measured on " + pad.info().name;
    profile.source = "physvib pads calibrate " PHYSVIB_VERSION ", the controller's own accelerometer";
    if (const auto checkedPad = readPad(padJson(profile), o.profilePath); !checkedPad)
        return reportExit(exitFailed, checkedPad.error);
    file.write(padJson(profile));
    if (const std::string& error = file.commit(); !error.empty()) return reportExit(exitFailed, error);
    std::cout << o.profilePath << "  for --pad " << (o.pad == anyPad ? "auto" : o.pad) << '@' << o.profilePath
              << '\n';
    return exitDone;
}

void declarePads(OptionTable& command, PadsOptions& o) {
    command
        .add("action", o.action,
             "list, test (each motor, then ten hits) or calibrate (by the controller's accelerometer)")
        .oneOf({"list", "test", "calibrate"});
    command.add("pad", o.pad, "part of its name, or auto: the first with motors");
    command.add("--out", o.profilePath, "calibrate: the profile").outputFileNamed("FILE.json");
    command.add("--name", o.name, "calibrate: of the profile; left out: the file's");
}

int runPads(const PadsOptions& o) {
    if (o.action != "calibrate" && !(o.profilePath.empty() && o.name.empty()))
        return reportExit(exitUsage, "--out, --name: expected pads calibrate");
    return o.action == "test" ? testMotors(o) : o.action == "calibrate" ? calibrateMotors(o) : listPads();
}

} // namespace

Command padsCommand() {
    return makeCommand("pads", "list game controllers, try or measure their motors", declarePads, runPads);
}

} // namespace physvib
