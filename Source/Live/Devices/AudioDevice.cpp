// SPDX-License-Identifier: MIT
// Scans drivers for their output devices.
#include "Live/Devices/AudioDevice.h"
#include "Io/Text/CleanText.h"
#include "Live/Devices/DeviceThread.h"
#include "Live/Devices/NoDevice.h"
#include "Live/Devices/PicoDevice.h"
#include <algorithm>

namespace physvib {
namespace {

// JACK's library waits for ever after a program was killed while it opened a client.
constexpr std::chrono::seconds answering{2};

std::vector<AudioDeviceName> devicesOf(AudioDriver& driver) {
    std::vector<AudioDeviceName> devices;
    driver.scan();
    for (const std::string& name : driver.deviceNames(false))
        if (const auto device = driver.create(name, false))
            devices.push_back({driver.name(), name, device->outputs()});
    return devices;
}

} // namespace

std::vector<AudioDeviceName> listAudioDevices(const AudioDrivers& drivers) {
    std::vector<AudioDeviceName> devices;
    for (auto& each : drivers()) {
        const std::shared_ptr<AudioDriver> driver = std::move(each);
        const auto found = std::make_shared<std::vector<AudioDeviceName>>();
        DeviceThread thread;
        thread.begin([driver, found] { *found = devicesOf(*driver); });
        if (thread.isOver(DeviceThread::Clock::now() + answering))
            std::ranges::move(*found, std::back_inserter(devices));
        else
            devices.push_back({driver->name(), "does not answer", 0});
    }
    return devices;
}

FoundDevice findAudioDevice(const AudioDrivers& drivers, const std::string& asked, bool withInputs) {
    auto all = drivers();
    // what older versions saved: a way to these very outputs that is not taken any more (AlsaDriver)
    const std::string wanted = asked == "ALSA:JACK Audio Connection Kit" ? "JACK:system" : asked;
    const auto prefix = [](const auto& driver) { return driver->name() + ":"; };
    const auto isNamed = [&](const auto& driver) { return wanted.starts_with(prefix(driver)); };
    const bool hasDriver = std::ranges::any_of(all, isNamed);
    for (auto& driver : all) {
        if (hasDriver && !isNamed(driver)) continue;
        driver->scan();
        std::string name = cleanLine(wanted.substr(hasDriver ? prefix(driver).size() : 0));
        const auto has = [&](bool inputs) {
            const auto names = driver->deviceNames(inputs);
            return std::ranges::find(names, name) != names.end();
        };
        if (name == picoDeviceName && !has(false)) name = picoAmong(driver->deviceNames(false));
        if (name.empty()) continue;
        auto device = driver->create(name, withInputs && has(true));
        if (device) return {std::move(driver), std::move(device)};
    }
    return {};
}

std::string picoLayout(const AudioDrivers& drivers, const std::string& name) {
    if (name != picoDeviceName) return picoLayoutOf(name);
    const auto found = findAudioDevice(drivers, name);
    return found.device ? picoLayoutOf(found.device->name()) : std::string{};
}

// Scores devices by name and number of outputs, without opening any.

namespace {

bool says(const AudioDeviceName& device, std::initializer_list<const char*> words) {
    const std::string name = lowerCase(device.name);
    return std::ranges::any_of(
        words, [&](const char* word) { return name.find(lowerCase(word)) != std::string::npos; });
}

int likelihood(const AudioDeviceName& device) {
    if (device.type == noDeviceType) return -100;
    const int outputs = ownOutputs(device);
    int points = outputs > 2 ? 50 : 10 * outputs;
    if (device.type == "JACK") points += 10;
    if (says(device, {"DualSense"})) points += 5;
    if (isPico(device.name)) points += 20; // it has no other use
    if (says(device, {"HDMI", "DisplayPort", "Monitor of"})) points -= 40;
    return points;
}

} // namespace

int ownOutputs(const AudioDeviceName& device) {
    const bool isMixed =
        device.type == "ALSA" && says(device, {"default", "pulse", "pipewire", "dmix", "front:", "surround"});
    return isMixed ? std::min(2, device.channels) : device.channels;
}

std::vector<AudioDeviceName> byLikelihood(std::vector<AudioDeviceName> devices) {
    std::ranges::stable_sort(devices, std::greater{}, likelihood);
    return devices;
}

const char* layoutFor(int outputs, std::string_view device) {
    if (isPico(device) && outputs >= 4) return outputs >= 8 ? "pico8" : "pico4";
    return outputs >= 4 ? "phone4" : outputs == 3 ? "phone3" : outputs == 2 ? "phone2" : "phone1";
}

} // namespace physvib
