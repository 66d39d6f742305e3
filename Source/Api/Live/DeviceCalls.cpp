// SPDX-License-Identifier: MIT
// physvib_live_devices: what can be opened.
#include "Api/Live/Lives.h"
#include "Live/Devices/AudioDevice.h"
#include "Live/Devices/SinkTable.h"
#include <algorithm>
#include <cstring>

using namespace physvib;
using namespace physvib::api;

namespace {

template <std::size_t Size>
void copy(std::string_view text, char (&to)[Size]) {
    const std::size_t length = std::min(text.size(), Size - 1);
    std::copy_n(text.data(), length, to);
    to[length] = '\0';
}

physvib_device deviceOf(std::string_view name, std::string_view about, int kind, int channels) {
    auto device = zeroed<physvib_device>();
    copy(name, device.name);
    copy(about, device.about);
    device.kind = kind;
    device.channels = channels;
    return device;
}

std::vector<physvib_device> allDevices() {
    std::vector<physvib_device> all;
    for (const AudioDeviceName& one : listAudioDevices(systemAudioDrivers))
        all.push_back(deviceOf(one.type + ":" + one.name, {}, PHYSVIB_DEVICE_SOUND, one.channels));
    for (const SinkKind& kind : sinkKinds())
        for (const SinkPlace& place : kind.places())
            all.push_back(deviceOf(std::string{kind.name} + ":" + place.where, place.about,
                                   kind.name == "PAD" ? PHYSVIB_DEVICE_PAD : PHYSVIB_DEVICE_BOARD,
                                   kind.actuators));
    return all;
}

} // namespace

int physvib_live_devices(physvib_device* devices, int capacity, size_t size) {
    return guarded([&] {
        constexpr std::size_t least = offsetof(physvib_device, channels) + sizeof(int), most = 1 << 16;
        if (capacity < 0 || (capacity > 0 && (devices == nullptr || size < least || size > most)))
            return nothingThere("devices: expected a place for them, and the size of one");
        const auto all = allDevices();
        const std::size_t written = std::min(size, sizeof(physvib_device));
        auto* at = reinterpret_cast<std::byte*>(devices); // the caller's structures may be longer
        for (std::size_t i = 0; i < std::min(all.size(), static_cast<std::size_t>(capacity));
             ++i, at += size) {
            std::memcpy(at, &all[i], written);
            std::memcpy(at, &size, sizeof size);
        }
        return static_cast<int>(all.size());
    });
}
