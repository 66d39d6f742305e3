// SPDX-License-Identifier: MIT
#include "Api/Godot/Outputs.h"
#include "Api/Godot/Live.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace physvib::godot {

namespace {
constexpr int maxPads = 8;
constexpr double commandSeconds = 0.1; // a command ends by itself if the game stops sending
} // namespace

Outputs::Outputs() = default;
Outputs::~Outputs() { close(); }

void Outputs::configure(const OutputSettings& wanted) {
    close();
    settings = wanted;
    for (const Value& name : settings.names) {
        const std::string error = open(name.text());
        if (!error.empty()) report("HapticWorld: " + error);
    }
}

std::string Outputs::open(const std::string& name) {
    constexpr std::string_view osc = "osc:";
    if (name.empty() || (name == "controllers" && pads != nullptr)) return "";
    if (name == "phone") return hasPhone = true, "";
    if (name == "controllers")
        return physvib_pads_create(maxPads, settings.fieldWidthMetres, settings.fieldHeightMetres, nullptr,
                                   &pads) == PHYSVIB_OK
                   ? ""
                   : physvib_error();
    if (name.starts_with(osc)) {
        Osc receiver;
        const std::string error = receiver.open(name.substr(osc.size()));
        if (error.empty()) receivers.push_back(receiver);
        return error;
    }
    if (settings.layout.count == 0) return ""; // which was reported
    auto device = std::make_unique<Live>();
    const std::string error = device->open(name, settings.layout, settings.levelDb, settings.fieldWidthMetres,
                                           settings.fieldHeightMetres);
    if (error.empty()) devices.push_back(std::move(device));
    return error;
}

void Outputs::play(physvib_world world, const physvib_event& event) {
    if (settings.isSilent) return;
    for (const auto& device : devices) device->play(world, event);
    for (const Osc& receiver : receivers) receiver.play(event);
    const Value input = singleton("Input");
    if (pads != nullptr) {
        const int only = physvib_world_device(world, event.fixture); // a HapticBody's controller + 1; 0: all
        const Value connected = input.call("get_connected_joypads");
        for (int pad = 0; pad < maxPads; ++pad)
            if ((only <= 0 || only == pad + 1) && connected.call("has", pad).isTrue())
                physvib_pads_strike(pads, pad, &event);
    }
    if (!hasPhone || event.kind != PHYSVIB_HIT) return;
    constexpr double toATenth = 2.3, longestMs = 500.0; // ln 10: a phone's motor has no decay of its own
    const double milliseconds = std::min(longestMs, 1000.0 * toATenth / std::max(event.decay_per_s, 1.0));
    input.call("vibrate_handheld", static_cast<int>(std::lround(milliseconds)),
               std::min(1.0, event.amplitude));
}

void Outputs::update(physvib_world world) {
    if (pads == nullptr || world == nullptr) return;
    std::array<physvib_motors, maxPads> motors{};
    if (physvib_pads_pull(pads, physvib_world_time_ns(world), motors.data(), maxPads) < 0) return;
    const Value input = singleton("Input");
    for (int pad = 0; pad < maxPads; ++pad) {
        const auto [low, high] = motors[static_cast<std::size_t>(pad)];
        const unsigned bit = 1U << static_cast<unsigned>(pad);
        if (low > 0.0 || high > 0.0) {
            input.call("start_joy_vibration", pad, high, low, commandSeconds); // Godot's weak motor is the
                                                                               // light one
            rumbling |= bit;
        } else if ((rumbling & bit) != 0) {
            input.call("stop_joy_vibration", pad);
            rumbling &= ~bit;
        }
    }
}

void Outputs::close() {
    devices.clear();
    receivers.clear();
    hasPhone = false;
    for (int pad = 0; pad < maxPads; ++pad)
        if ((rumbling >> static_cast<unsigned>(pad) & 1U) != 0)
            singleton("Input").call("stop_joy_vibration", pad);
    rumbling = 0;
    if (pads != nullptr) physvib_pads_free(pads);
    pads = nullptr;
}

} // namespace physvib::godot
