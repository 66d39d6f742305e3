// SPDX-License-Identifier: GPL-3.0-or-later
// Lists the system's audio output devices and finds one by name, through JUCE's device types.
#include "Host/Devices/AudioDevices.h"
#include "Io/Text/CleanText.h"
#include <algorithm>

namespace physvib {

namespace {

int channelsOf(juce::AudioIODeviceType& type, const juce::String& name) {
    const std::unique_ptr<juce::AudioIODevice> device{type.createDevice(name, {})};
    return device ? device->getOutputChannelNames().size() : 0;
}

// Without a running server, JACK's library prints five lines to stderr for each query. PhysVib reports that
// in one line of its own.
void quietenJack() {
    using Handler = void (*)(const char*);
    static juce::DynamicLibrary jack{"libjack.so.0"};
    if (auto* set = reinterpret_cast<void (*)(Handler)>(jack.getFunction("jack_set_error_function")))
        set([](const char*) {});
}

} // namespace

std::vector<std::unique_ptr<juce::AudioIODeviceType>> systemAudioDeviceTypes() {
    quietenJack();
    using Type = juce::AudioIODeviceType;
    std::vector<std::unique_ptr<Type>> types;
    for (Type* type : {Type::createAudioIODeviceType_JACK(), Type::createAudioIODeviceType_ALSA(),
                       Type::createAudioIODeviceType_CoreAudio(),
                       Type::createAudioIODeviceType_WASAPI(juce::WASAPIDeviceMode::exclusive),
                       Type::createAudioIODeviceType_ASIO()})
        if (type != nullptr) types.emplace_back(type); // null: this system lacks the driver
    return types;
}

std::vector<AudioDeviceName> listAudioDevices(const AudioDeviceTypes& types) {
    std::vector<AudioDeviceName> devices;
    for (const auto& type : types()) {
        type->scanForDevices();
        for (const auto& name : type->getDeviceNames(false))
            devices.push_back(
                {type->getTypeName().toStdString(), name.toStdString(), channelsOf(*type, name)});
    }
    return devices;
}

FoundDevice findAudioDevice(const AudioDeviceTypes& types, const std::string& wanted, bool withInputs) {
    auto all = types();
    const auto prefix = [](const auto& type) { return type->getTypeName().toStdString() + ":"; };
    const auto isNamed = [&](const auto& type) { return wanted.starts_with(prefix(type)); };
    const bool hasType = std::any_of(all.begin(), all.end(), isNamed);
    for (auto& type : all) {
        if (hasType && !isNamed(type)) continue;
        type->scanForDevices();
        const auto name =
            juce::String::fromUTF8(cleanLine(wanted.substr(hasType ? prefix(type).size() : 0)).c_str());
        if (!type->getDeviceNames(false).contains(name)) continue;
        std::unique_ptr<juce::AudioIODevice> device{type->createDevice(
            name, withInputs && type->getDeviceNames(true).contains(name) ? name : juce::String{})};
        if (device) return {std::move(type), std::move(device)};
    }
    return {};
}

} // namespace physvib
