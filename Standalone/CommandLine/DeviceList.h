// SPDX-License-Identifier: GPL-3.0-or-later
// Audio devices of this machine, as `devices` lists and `play` suggests them; the device of a DualSense
// controller, and the report that switches its coils to audio.
#pragma once
#include "Io/Result.h"
#include "Live/Devices/AudioDevice.h"
#include "Live/Pads/GamePads.h"
#include "Live/Pads/PadReports.h"
#include <chrono>
#include <ostream>
#include <string>
#include <thread>
#include <vector>

namespace physvib {

/// Available devices in the system's order. Message thread; queries the system.
inline std::vector<AudioDeviceName> availableDevices() { return listAudioDevices(systemAudioDrivers); }

/// One line per device: the name for --device, and its number of outputs.
inline void printDevices(std::ostream& out, const std::vector<AudioDeviceName>& devices) {
    for (const auto& device : devices)
        out << device.type << ':' << device.name << "  " << device.channels << " outputs\n";
}

/// A call of `play` with the first device that has four outputs, else with the device with most outputs, and
/// a layout that fits it.
inline std::string suggestedPlayCall(const std::string& scene, const std::vector<AudioDeviceName>& devices) {
    const AudioDeviceName* best = nullptr;
    for (const auto& device : devices)
        if (best == nullptr || (best->channels < 4 && device.channels > best->channels)) best = &device;
    const std::string call = "physvib play " + (scene.empty() ? "shake-the-box" : scene) + " --device ";
    if (best == nullptr || best->channels < 1) return call + "\"None:no device\"";
    const std::string name = '"' + best->type + ':' + best->name + '"';
    const int count = best->channels < 4 ? best->channels : 4;
    std::string map = "1";
    for (int output = 2; output <= count; ++output) map += ',' + std::to_string(output);
    return call + name + (count < 4 ? " --layout phone" + std::to_string(count) : std::string{}) + " --map " +
           map;
}

/// Name for --device that selects it with any driver.
inline constexpr const char* dualSenseDeviceName = "dualsense";

/// "type:name" of the first DualSense with four outputs; or one error line if there is none, or if its system
/// profile hides two outputs. Message thread.
inline Result<std::string> dualSenseDevice(const std::vector<AudioDeviceName>& devices) {
    std::string reason;
    for (const AudioDeviceName& device : devices) {
        if (!dualsense::isDevice(device.name)) continue;
        if (device.channels >= dualsense::outputs) return device.type + ":" + device.name;
        reason = device.type + ":" + device.name + ": expected four outputs, found " +
                 std::to_string(device.channels) + ": its profile hides the coils (Docs/pads.md)";
    }
    return Failure{reason.empty() ? "--device dualsense: no sound device of a DualSense is there; it has one "
                                    "by USB; by Bluetooth: --device DUALSENSE:auto"
                                  : reason};
}

/// Sends the report that switches the coils to audio; empty, or one error line. Coils are in audio mode from
/// connection until the first rumble command. Message thread; waits at most half a second for the controller.
inline std::string switchCoilsToAudio() {
    GamePads pads{GamePads::Driver::sdl};
    if (!pads.error().empty()) return pads.error();
    constexpr auto report = dualsense::coilsToSound();
    for (int i = 0; i < 50; ++i) {
        pads.update();
        for (const GamePadInfo& info : pads.list())
            if (auto pad = info.isDualSense ? pads.open(info.name) : nullptr)
                return pad->sendEffect(report.data(), static_cast<int>(report.size()))
                           ? std::string{}
                           : info.name + ": it did not take the report that gives its coils to sound";
        std::this_thread::sleep_for(std::chrono::milliseconds{10});
    }
    return "the DualSense's own controls are not there: its coils play sound unless something has made it "
           "rumble since it was plugged in";
}

} // namespace physvib
