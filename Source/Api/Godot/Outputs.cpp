// SPDX-License-Identifier: MIT
#include "Api/Godot/Outputs.h"
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <string_view>

namespace physvib::godot {
namespace {
constexpr int maxPads = 8;
constexpr double commandSeconds = 0.1; // a command ends by itself if the game stops sending
} // namespace

Outputs::Outputs(GDExtensionObjectPtr of)
    : node(of) {}
Outputs::~Outputs() { close(); }

void Outputs::configure(const OutputSettings& wanted) {
    const auto differs = [&](auto OutputSettings::*member) { return settings.*member != wanted.*member; };
    const bool isOther =
        !isOpen || differs(&OutputSettings::names) || differs(&OutputSettings::sessionFile) ||
        differs(&OutputSettings::fieldWidthMetres) || differs(&OutputSettings::fieldHeightMetres) ||
        std::memcmp(&settings.layout, &wanted.layout, sizeof wanted.layout) != 0;
    settings = wanted;
    if (settings.isSilent) rest();
    for (const auto& device : devices) device->setLevel(settings.levelDb);
    if (!isOther) return;
    close();
    isOpen = true;
    for (const std::string& name : settings.names) {
        const std::string error = open(name);
        if (!error.empty()) report("HapticWorld: " + error);
    }
}

std::string Outputs::open(const std::string& name) {
    constexpr std::string_view osc = "osc:", bus = "sound:";
    if (name.empty() || (name == "controllers" && pads != nullptr)) return "";
    if (name == "phone") return hasPhone = true, "";
    if (name == "xr") return hasHands = true, "";
    if (name == "controllers")
        return physvib_pads_create(maxPads, settings.fieldWidthMetres, settings.fieldHeightMetres, nullptr,
                                   &pads) == PHYSVIB_OK
                   ? ""
                   : physvib_error();
    if (name == "sound" || name.starts_with(bus)) {
        sound = std::make_unique<Sound>();
        return sound->open(node, name == "sound" ? "Master" : name.substr(bus.size()),
                           settings.fieldWidthMetres, settings.fieldHeightMetres);
    }
    if (name.starts_with(osc)) {
        Osc receiver;
        const std::string error = receiver.open(name.substr(osc.size()));
        if (error.empty()) receivers.push_back(receiver);
        return error;
    }
    if (settings.layout.count == 0) return ""; // reported already
    auto device = std::make_unique<Live>();
    const std::string error =
        device->open(name, settings.layout, settings.levelDb, settings.fieldWidthMetres,
                     settings.fieldHeightMetres, devices.empty() ? settings.sessionFile : "");
    if (error.empty()) devices.push_back(std::move(device));
    return error;
}

void Outputs::play(physvib_world world, const physvib_event& event) {
    if (settings.isSilent) return;
    for (const auto& device : devices) device->play(world, event);
    for (const Osc& receiver : receivers) receiver.play(event);
    if (sound != nullptr) sound->play(event);
    if (pads != nullptr) strikePads(world, event);
    if (hasHands) hands.play(event, clockSeconds);
    if (!hasPhone || event.kind != PHYSVIB_HIT) return;
    constexpr double toATenth = 2.3, longestMs = 500.0; // ln 10: a phone's motor has no decay of its own
    const double milliseconds = std::min(longestMs, 1000.0 * toATenth / std::max(event.decay_per_s, 1.0));
    singleton("Input").call("vibrate_handheld", static_cast<int>(std::lround(milliseconds)),
                            std::min(1.0, event.amplitude));
}

// The age of the event is converted to real time. A HapticBody's controller is not checked for its presence.
void Outputs::strikePads(physvib_world world, const physvib_event& event) {
    const int only = physvib_world_device(world, event.fixture); // a HapticBody's controller + 1; 0: all
    const auto ago = static_cast<double>(physvib_world_time_ns(world) - event.time_ns);
    physvib_event now = event;
    now.time_ns = std::llround(1e9 * clockSeconds - ago / std::max(timeScale, 1e-3));
    if (only > 0) {
        physvib_pads_strike(pads, only - 1, &now);
        return;
    }
    for (const Value& pad : singleton("Input").call("get_connected_joypads").elements())
        if (pad.whole() < maxPads) physvib_pads_strike(pads, static_cast<int>(pad.whole()), &now);
}

// Godot's frame time is game time: it differs from real time in slow motion, and is 0 at a time scale of 0.
void Outputs::update(double gameSeconds) {
    const std::int64_t now = singleton("Time").call("get_ticks_usec").whole();
    timeScale = singleton("Engine").call("get_time_scale").real();
    if (hasHands && !settings.isSilent) hands.update(clockSeconds); // first, so that a new pulse has age 0
    clockSeconds += timeScale > 0.0 ? gameSeconds / timeScale : 1e-6 * static_cast<double>(now - lastUpdate);
    lastUpdate = now;
    if (sound != nullptr && !settings.isSilent) sound->update();
    if (pads == nullptr) return;
    std::array<physvib_motors, maxPads> motors{};
    if (physvib_pads_pull(pads, std::llround(1e9 * clockSeconds), motors.data(), maxPads) < 0) return;
    if (settings.isSilent) return;
    const Value input = singleton("Input");
    for (int pad = 0; pad < maxPads; ++pad) {
        const auto [low, high] = motors[static_cast<std::size_t>(pad)];
        const unsigned bit = 1U << static_cast<unsigned>(pad);
        if (low > 0.0 || high > 0.0) { // Godot's weak motor is the light one
            input.call("start_joy_vibration", pad, high, low, commandSeconds);
            rumbling |= bit;
        } else if ((rumbling & bit) != 0) {
            input.call("stop_joy_vibration", pad);
            rumbling &= ~bit;
        }
    }
}

std::vector<double> Outputs::left() const {
    return devices.empty() ? std::vector<double>{} : devices.front()->left(settings.layout.count);
}

void Outputs::rest() {
    hands.rest();
    if (sound != nullptr) sound->rest();
    for (int pad = 0; pad < maxPads; ++pad)
        if ((rumbling >> static_cast<unsigned>(pad) & 1U) != 0)
            singleton("Input").call("stop_joy_vibration", pad);
    rumbling = 0;
}

void Outputs::close() {
    rest();
    isOpen = false;
    devices.clear();
    receivers.clear();
    sound.reset();
    hasPhone = hasHands = false;
    if (pads != nullptr) physvib_pads_free(pads);
    pads = nullptr;
}

Sound::~Sound() {
    if (const Value there(api.instanceFromId(player)); there.object() != nullptr) there.call("queue_free");
    if (renderer != nullptr) physvib_renderer_free(renderer);
}

// The child is added deferred: a node that is entering the tree cannot get children.
std::string Sound::open(GDExtensionObjectPtr world, const std::string& bus, double fieldWidthMetres,
                        double fieldHeightMetres) {
    constexpr double bufferSeconds = 0.05; // a frame of the game, and a block of Godot's
    rate = singleton("AudioServer").call("get_mix_rate").real();
    physvib_renderer_settings ears;
    physvib_renderer_settings_init(&ears, sizeof ears);
    ears.rate_hz = static_cast<int>(std::lround(rate));
    ears.law = PHYSVIB_LAW_ENERGY;
    ears.field_width_m = ears.layout.extent_width_m = fieldWidthMetres;
    ears.field_height_m = ears.layout.extent_height_m = fieldHeightMetres;
    ears.layout.count = 2;
    for (int i = 0; i < 2; ++i)
        ears.layout.x_m[i] = i * fieldWidthMetres, ears.layout.y_m[i] = 0.5 * fieldHeightMetres;
    if (physvib_renderer_create(&ears, &renderer) != PHYSVIB_OK) return physvib_error();
    const Value stream = singleton("ClassDB").call("instantiate", "AudioStreamGenerator"),
                made = singleton("ClassDB").call("instantiate", "AudioStreamPlayer");
    stream.call("set_mix_rate", rate);
    stream.call("set_buffer_length", bufferSeconds);
    made.call("set_stream", stream);
    made.call("set_bus", bus.c_str());
    player = api.instanceId(made.object());
    Value(world).call("call_deferred", "add_child", made);
    return "";
}

// All events get the same delay, so that their distances stay although frames are irregular.
void Sound::play(physvib_event event) {
    constexpr double leadSeconds = 0.04, mostSeconds = 0.12; // a frame of the game and a block of Godot's
    const double ahead = 1e-9 * static_cast<double>(event.time_ns + later) - filled / rate;
    if (!(ahead >= 0.0 && ahead <= mostSeconds)) // the first event, or the game was paused
        later = std::llround(1e9 * (filled / rate + leadSeconds)) - event.time_ns;
    event.time_ns += later;
    physvib_renderer_strike(renderer, &event);
}

void Sound::update() {
    const Value there(api.instanceFromId(player));
    if (there.object() == nullptr || !there.call("is_inside_tree").isTrue()) return;
    if (!there.call("is_playing").isTrue()) there.call("play");
    const Value playback = there.call("get_stream_playback");
    const auto frames = static_cast<int>(playback.call("get_frames_available").whole());
    if (frames < 1) return;
    std::vector<float> samples(2 * static_cast<std::size_t>(frames));
    if (physvib_renderer_pull_interleaved(renderer, samples.data(), 2, frames) != PHYSVIB_OK) return;
    const Value list = Value::empty(type::places);
    for (std::size_t i = 0; i < samples.size(); i += 2)
        list.call("append", Value::vector({samples[i], samples[i + 1], 0.0}, false));
    playback.call("push_buffer", list);
    filled += frames;
}

void Sound::rest() {
    if (const Value there(api.instanceFromId(player)); there.object() != nullptr) there.call("stop");
    const std::int64_t now = std::llround(1e9 * filled / rate);
    if (renderer != nullptr) physvib_renderer_silence(renderer, now, now);
}

void XrHands::play(const physvib_event& event, double nowSeconds) {
    static const std::array parts{physvib_part(names[0]), physvib_part(names[1])};
    for (std::size_t i = 0; i < hands.size(); ++i)
        if (event.part != parts[1 - i] && event.amplitude > left(hands[i], nowSeconds))
            hands[i] = {event.amplitude, event.decay_per_s, event.frequency_hz, nowSeconds, true};
}

double XrHands::left(const Ringing& of, double nowSeconds) {
    return of.amplitude * std::exp(-of.decayPerSecond * (nowSeconds - of.sinceSeconds));
}

void XrHands::update(double nowSeconds) {
    constexpr double least = 0.01;
    for (std::size_t i = 0; i < hands.size(); ++i) {
        if (!hands[i].isRinging) continue;
        const double amplitude = left(hands[i], nowSeconds);
        hands[i].isRinging = amplitude > least;
        send(i, hands[i].hertz, amplitude > least ? std::min(1.0, amplitude) : 0.0);
    }
}

void XrHands::rest() {
    for (std::size_t i = 0; i < hands.size(); ++i)
        if (hands[i].isRinging) send(i, hands[i].hertz, 0.0);
    hands = {};
}

// "haptic" is the output action of Godot's default OpenXR action map.
void XrHands::send(std::size_t hand, double hertz, double amplitude) {
    const Value interface = singleton("XRServer").call("get_primary_interface");
    if (interface.object() != nullptr)
        interface.call("trigger_haptic_pulse", "haptic", names[hand], hertz, amplitude, commandSeconds, 0.0);
}

namespace {
class Packet {
public:
    void add(std::string_view text) {
        for (const char each : text) add(each);
        for (std::size_t i = text.size() % 4; i < 4; ++i) add('\0'); // texts end with 1 to 4 zeros
    }
    void add(double number) {
        const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(number));
        for (const int shift : {24, 16, 8, 0}) add(static_cast<char>(bits >> shift & 0xFFU));
    }
    const Value& bytes() const { return data; }

private:
    void add(char byte) { data.call("append", static_cast<unsigned char>(byte)); }
    Value data = Value::empty(type::bytes);
};
} // namespace

std::string Osc::open(const std::string& address) {
    const std::size_t colon = address.rfind(':');
    const Value port = Value(colon < address.size() ? address.substr(colon + 1).c_str() : "").call("to_int");
    if (port.whole() < 1 || port.whole() > 65'535)
        return "outputs: osc: expected an address such as osc:127.0.0.1:9000, found osc:" + address;
    peer = singleton("ClassDB").call("instantiate", "PacketPeerUDP");
    peer.call("set_broadcast_enabled", true);
    const Value error = peer.call("set_dest_address", address.substr(0, colon).c_str(), port);
    return error.whole() == 0 ? "" : "outputs: osc: there is no host " + address.substr(0, colon);
}

void Osc::play(const physvib_event& event) const {
    Packet packet;
    packet.add("/physvib/strike");
    packet.add(",sfsfsffsf");
    packet.add("frequency_hz"), packet.add(event.frequency_hz);
    packet.add("decay_per_s"), packet.add(event.decay_per_s);
    packet.add("place"), packet.add(event.x_m), packet.add(event.y_m);
    packet.add("level"), packet.add(std::min(1.0, event.amplitude));
    peer.call("put_packet", packet.bytes());
}

} // namespace physvib::godot
