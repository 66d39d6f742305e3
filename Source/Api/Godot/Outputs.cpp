// SPDX-License-Identifier: MIT
// Outputs, and those that Godot itself drives: sound, XR hands and OSC. LivePosix.cpp has LiveDevice.
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

Outputs::Outputs(GDExtensionObjectPtr worldNode)
    : node(worldNode) {}
Outputs::~Outputs() { close(); }

void Outputs::configure(const OutputSettings& requested) {
    const auto differs = [&](auto OutputSettings::*member) { return settings.*member != requested.*member; };
    const bool needsReopening =
        !isOpen || differs(&OutputSettings::names) || differs(&OutputSettings::sessionFile) ||
        differs(&OutputSettings::fieldWidthMetres) || differs(&OutputSettings::fieldHeightMetres) ||
        std::memcmp(&settings.layout, &requested.layout, sizeof requested.layout) != 0;
    settings = requested;
    if (settings.isSilent) pause();
    for (const auto& device : devices) device->setLevel(settings.levelDb);
    if (!needsReopening) return;
    close();
    isOpen = true;
    for (const std::string& name : settings.names) {
        const std::string error = open(name);
        if (!error.empty()) warn("HapticWorld: " + error);
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
        sound = std::make_unique<SoundOutput>();
        return sound->open(node, name == "sound" ? "Master" : name.substr(bus.size()),
                           settings.fieldWidthMetres, settings.fieldHeightMetres);
    }
    if (name.starts_with(osc)) {
        OscSender sender;
        const std::string error = sender.open(name.substr(osc.size()));
        if (error.empty()) oscSenders.push_back(sender);
        return error;
    }
    if (settings.layout.count == 0) return ""; // reported already
    auto device = std::make_unique<LiveDevice>();
    const std::string error =
        device->open(name, settings.layout, settings.levelDb, settings.fieldWidthMetres,
                     settings.fieldHeightMetres, devices.empty() ? settings.sessionFile : "");
    if (error.empty()) devices.push_back(std::move(device));
    return error;
}

void Outputs::play(physvib_world world, const physvib_event& event) {
    if (settings.isSilent) return;
    for (const auto& device : devices) device->play(world, event);
    for (const OscSender& sender : oscSenders) sender.play(event);
    if (sound != nullptr) sound->play(event);
    if (pads != nullptr) sendToPads(world, event);
    if (hasHands) hands.play(event, clockSeconds);
    if (!hasPhone || event.kind != PHYSVIB_HIT) return;
    constexpr double decayToTenth = 2.3, maxMs = 500.0; // ln 10: a phone's motor has no decay of its own
    const double milliseconds = std::min(maxMs, 1000.0 * decayToTenth / std::max(event.decay_per_s, 1.0));
    singleton("Input").call("vibrate_handheld", static_cast<int>(std::lround(milliseconds)),
                            std::min(1.0, event.amplitude));
}

// The age of the event is converted to real time. A HapticBody's controller is not checked for its presence.
void Outputs::sendToPads(physvib_world world, const physvib_event& event) {
    const int controller = physvib_world_device(world, event.fixture); // from 1; 0: all
    const auto ageNs = static_cast<double>(physvib_world_time_ns(world) - event.time_ns);
    physvib_event scheduled = event;
    scheduled.time_ns = std::llround(1e9 * clockSeconds - ageNs / std::max(timeScale, 1e-3));
    if (controller > 0) {
        physvib_pads_strike(pads, controller - 1, &scheduled);
        return;
    }
    for (const Variant& pad : singleton("Input").call("get_connected_joypads").elements())
        if (pad.integer() < maxPads) physvib_pads_strike(pads, static_cast<int>(pad.integer()), &scheduled);
}

// Godot's frame time is game time: it differs from real time in slow motion, and is 0 at a time scale of 0.
void Outputs::update(double gameSeconds) {
    const std::int64_t nowUs = singleton("Time").call("get_ticks_usec").integer();
    timeScale = singleton("Engine").call("get_time_scale").real();
    if (hasHands && !settings.isSilent) hands.update(clockSeconds); // first, so that a new pulse has age 0
    clockSeconds +=
        timeScale > 0.0 ? gameSeconds / timeScale : 1e-6 * static_cast<double>(nowUs - lastUpdateUs);
    lastUpdateUs = nowUs;
    if (sound != nullptr && !settings.isSilent) sound->update();
    if (pads == nullptr) return;
    std::array<physvib_motors, maxPads> motors{};
    if (physvib_pads_pull(pads, std::llround(1e9 * clockSeconds), motors.data(), maxPads) < 0) return;
    if (settings.isSilent) return;
    const Variant input = singleton("Input");
    for (int pad = 0; pad < maxPads; ++pad) {
        const auto [low, high] = motors[static_cast<std::size_t>(pad)];
        const unsigned bit = 1U << static_cast<unsigned>(pad);
        if (low > 0.0 || high > 0.0) { // Godot's weak motor is the light one
            input.call("start_joy_vibration", pad, high, low, commandSeconds);
            vibratingPads |= bit;
        } else if ((vibratingPads & bit) != 0) {
            input.call("stop_joy_vibration", pad);
            vibratingPads &= ~bit;
        }
    }
}

std::vector<double> Outputs::recentPeaks() const {
    return devices.empty() ? std::vector<double>{} : devices.front()->recentPeaks(settings.layout.count);
}

void Outputs::pause() {
    hands.pause();
    if (sound != nullptr) sound->pause();
    for (int pad = 0; pad < maxPads; ++pad)
        if ((vibratingPads >> static_cast<unsigned>(pad) & 1U) != 0)
            singleton("Input").call("stop_joy_vibration", pad);
    vibratingPads = 0;
}

void Outputs::close() {
    pause();
    isOpen = false;
    devices.clear();
    oscSenders.clear();
    sound.reset();
    hasPhone = hasHands = false;
    if (pads != nullptr) physvib_pads_free(pads);
    pads = nullptr;
}

SoundOutput::~SoundOutput() {
    if (const Variant node(api.objectFromId(playerId)); node.object() != nullptr) node.call("queue_free");
    if (renderer != nullptr) physvib_renderer_free(renderer);
}

// The child is added deferred: a node that is entering the tree cannot get children.
std::string SoundOutput::open(GDExtensionObjectPtr world, const std::string& bus, double fieldWidthMetres,
                              double fieldHeightMetres) {
    constexpr double bufferSeconds = 0.05; // a frame of the game and an audio block
    rateHz = singleton("AudioServer").call("get_mix_rate").real();
    physvib_renderer_settings stereo;
    physvib_renderer_settings_init(&stereo, sizeof stereo);
    stereo.rate_hz = static_cast<int>(std::lround(rateHz));
    stereo.law = PHYSVIB_LAW_ENERGY;
    stereo.field_width_m = stereo.layout.extent_width_m = fieldWidthMetres;
    stereo.field_height_m = stereo.layout.extent_height_m = fieldHeightMetres;
    stereo.layout.count = 2;
    for (int i = 0; i < 2; ++i)
        stereo.layout.x_m[i] = i * fieldWidthMetres, stereo.layout.y_m[i] = 0.5 * fieldHeightMetres;
    if (physvib_renderer_create(&stereo, &renderer) != PHYSVIB_OK) return physvib_error();
    const Variant stream = singleton("ClassDB").call("instantiate", "AudioStreamGenerator"),
                  playerNode = singleton("ClassDB").call("instantiate", "AudioStreamPlayer");
    stream.call("set_mix_rate", rateHz);
    stream.call("set_buffer_length", bufferSeconds);
    playerNode.call("set_stream", stream);
    playerNode.call("set_bus", bus.c_str());
    playerId = api.objectId(playerNode.object());
    Variant(world).call("call_deferred", "add_child", playerNode);
    return "";
}

// All events get the same delay, so that their intervals stay although frames are irregular.
void SoundOutput::play(physvib_event event) {
    constexpr double leadSeconds = 0.04, maxSeconds = 0.12; // a game frame and an audio block; 3 times that
    const double ahead = 1e-9 * static_cast<double>(event.time_ns + streamOffsetNs) - filledFrames / rateHz;
    if (!(ahead >= 0.0 && ahead <= maxSeconds)) // the first event, or the game was paused
        streamOffsetNs = std::llround(1e9 * (filledFrames / rateHz + leadSeconds)) - event.time_ns;
    event.time_ns += streamOffsetNs;
    physvib_renderer_strike(renderer, &event);
}

void SoundOutput::update() {
    const Variant node(api.objectFromId(playerId));
    if (node.object() == nullptr || !node.call("is_inside_tree").isTrue()) return;
    if (!node.call("is_playing").isTrue()) node.call("play");
    const Variant playback = node.call("get_stream_playback");
    const auto frames = static_cast<int>(playback.call("get_frames_available").integer());
    if (frames < 1) return;
    std::vector<float> samples(2 * static_cast<std::size_t>(frames));
    if (physvib_renderer_pull_interleaved(renderer, samples.data(), 2, frames) != PHYSVIB_OK) return;
    const Variant list = Variant::empty(type::vector2Array);
    for (std::size_t i = 0; i < samples.size(); i += 2)
        list.call("append", Variant::vector({samples[i], samples[i + 1], 0.0}, false));
    playback.call("push_buffer", list);
    filledFrames += frames;
}

void SoundOutput::pause() {
    if (const Variant node(api.objectFromId(playerId)); node.object() != nullptr) node.call("stop");
    const std::int64_t nowNs = std::llround(1e9 * filledFrames / rateHz);
    if (renderer != nullptr) physvib_renderer_silence(renderer, nowNs, nowNs);
}

void XrHands::play(const physvib_event& event, double nowSeconds) {
    static const std::array parts{physvib_part(names[0]), physvib_part(names[1])};
    for (std::size_t i = 0; i < hands.size(); ++i)
        if (event.part != parts[1 - i] && event.amplitude > remainingAmplitude(hands[i], nowSeconds))
            hands[i] = {event.amplitude, event.decay_per_s, event.frequency_hz, nowSeconds, true};
}

double XrHands::remainingAmplitude(const HandPulse& hand, double nowSeconds) {
    return hand.amplitude * std::exp(-hand.decayPerSecond * (nowSeconds - hand.startSeconds));
}

void XrHands::update(double nowSeconds) {
    constexpr double minAmplitude = 0.01;
    for (std::size_t i = 0; i < hands.size(); ++i) {
        if (!hands[i].isActive) continue;
        const double amplitude = remainingAmplitude(hands[i], nowSeconds);
        hands[i].isActive = amplitude > minAmplitude;
        send(i, hands[i].frequencyHz, amplitude > minAmplitude ? std::min(1.0, amplitude) : 0.0);
    }
}

void XrHands::pause() {
    for (std::size_t i = 0; i < hands.size(); ++i)
        if (hands[i].isActive) send(i, hands[i].frequencyHz, 0.0);
    hands = {};
}

// "haptic" is the output action of Godot's default OpenXR action map.
void XrHands::send(std::size_t hand, double frequencyHz, double amplitude) {
    const Variant interface = singleton("XRServer").call("get_primary_interface");
    if (interface.object() != nullptr)
        interface.call("trigger_haptic_pulse", "haptic", names[hand], frequencyHz, amplitude, commandSeconds,
                       0.0);
}

namespace {
class OscPacket {
public:
    void add(std::string_view text) {
        for (const char character : text) add(character);
        for (std::size_t i = text.size() % 4; i < 4; ++i) add('\0'); // texts end with 1 to 4 zeros
    }
    void add(double number) {
        const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(number));
        for (const int shift : {24, 16, 8, 0}) add(static_cast<char>(bits >> shift & 0xFFU));
    }
    const Variant& bytes() const { return data; }

private:
    void add(char byte) { data.call("append", static_cast<unsigned char>(byte)); }
    Variant data = Variant::empty(type::bytes);
};
} // namespace

std::string OscSender::open(const std::string& address) {
    const std::size_t colon = address.rfind(':');
    const Variant port =
        Variant(colon < address.size() ? address.substr(colon + 1).c_str() : "").call("to_int");
    if (port.integer() < 1 || port.integer() > 65'535)
        return "outputs: osc: expected an address such as osc:127.0.0.1:9000, found osc:" + address;
    peer = singleton("ClassDB").call("instantiate", "PacketPeerUDP");
    peer.call("set_broadcast_enabled", true);
    const Variant error = peer.call("set_dest_address", address.substr(0, colon).c_str(), port);
    return error.integer() == 0 ? "" : "outputs: osc: there is no host " + address.substr(0, colon);
}

void OscSender::play(const physvib_event& event) const {
    OscPacket packet;
    packet.add("/physvib/strike");
    packet.add(",sfsfsffsf");
    packet.add("frequency_hz"), packet.add(event.frequency_hz);
    packet.add("decay_per_s"), packet.add(event.decay_per_s);
    packet.add("place"), packet.add(event.x_m), packet.add(event.y_m);
    packet.add("level"), packet.add(std::min(1.0, event.amplitude));
    peer.call("put_packet", packet.bytes());
}

} // namespace physvib::godot
