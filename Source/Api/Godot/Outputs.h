// SPDX-License-Identifier: MIT
// The outputs of a haptic world: OSC, devices of libphysvib-live, XR controllers, sound, and through Godot
// game controllers and phones. For Godot's main thread.
#pragma once
#include "Api/Godot/Binding.h"
#include <array>
#include <memory>
#include <physvib/physvib-live.h>
#include <physvib/physvib.h>
#include <string>
#include <vector>

namespace physvib::godot {
/// Sends events to a program that speaks Open Sound Control.
class OscSender {
public:
    /// `address`: such as 127.0.0.1:9000. Returns the error, or empty. Waits until the host name is resolved.
    std::string open(const std::string& address);
    /// Sends the event at once, as the message /physvib/strike of Docs/messages.md; places are in m.
    void play(const physvib_event& event) const;

private:
    Variant peer; ///< Godot's PacketPeerUDP
};

/// An open device of libphysvib-live. The library is loaded when a world names a device, so that games
/// without one do not need the libraries it needs.
class LiveDevice {
public:
    LiveDevice() = default;
    ~LiveDevice();
    LiveDevice(const LiveDevice&) = delete;
    LiveDevice& operator=(const LiveDevice&) = delete;

    /// Returns the error, or empty. Waits for the device. `sessionFile`: file for its events, or empty.
    std::string open(const std::string& device, const physvib_layout& layout, double levelDb,
                     double fieldWidthMetres, double fieldHeightMetres, const std::string& sessionFile);
    void setLevel(double levelDb);
    void play(physvib_world world, const physvib_event& event);
    /// Peak sent to each of `actuators` in the last second, 1: full scale; empty if not all of it was sent.
    std::vector<double> recentPeaks(int actuators) const;

private:
    physvib_live live = nullptr;
    physvib_int64 startNs = 0; ///< session time of the world's time 0
};

/// Sends haptic pulses to the two hands of an XR interface, at the frequency of the event. Each frame sends
/// the remaining amplitude of the strongest hit, so that a weak hit never ends a strong one.
class XrHands {
public:
    static constexpr const char* names[] = {"left_hand", "right_hand"}; ///< trackers of Godot, and parts
    /// Plays on the hand that the event's part names, otherwise on both.
    void play(const physvib_event& event, double nowSeconds);
    void update(double nowSeconds);
    void pause();

private:
    struct HandPulse {
        double amplitude, decayPerSecond, frequencyHz, startSeconds;
        bool isActive;
    };
    static double remainingAmplitude(const HandPulse& hand, double nowSeconds);
    static void send(std::size_t hand, double frequencyHz, double amplitude);
    std::array<HandPulse, 2> hands{};
};

/// Plays events as stereo sound, panned by their place: a renderer fills an audio player of Godot.
class SoundOutput {
public:
    SoundOutput() = default;
    ~SoundOutput();
    SoundOutput(const SoundOutput&) = delete;
    SoundOutput& operator=(const SoundOutput&) = delete;
    /// Adds the player to the node `world`, on that audio bus. Returns the error, or empty.
    std::string open(GDExtensionObjectPtr world, const std::string& bus, double fieldWidthMetres,
                     double fieldHeightMetres);
    void play(physvib_event event);
    void update(); ///< once a frame: renders as many samples as Godot has room for
    void pause();  ///< stops the player until the next update

private:
    std::uint64_t playerId = 0; ///< Godot's instance id, since the world's node owns it
    physvib_renderer renderer = nullptr;
    double rateHz = 0.0, filledFrames = 0.0;
    std::int64_t streamOffsetNs = 0; ///< added to the world's time, gives that of the stream
};

/// Settings of all outputs, from the properties of the world.
struct OutputSettings {
    std::vector<std::string> names; ///< controllers, phone, xr, sound, osc:HOST:PORT, or a device of
                                    ///< libphysvib-live
    bool isSilent;
    physvib_layout layout;
    double levelDb, fieldWidthMetres, fieldHeightMetres;
    std::string sessionFile; ///< of the first device; empty: none
};

/// All outputs of a world. Each plays every event that it can.
class Outputs {
public:
    explicit Outputs(GDExtensionObjectPtr worldNode); ///< node of the world
    ~Outputs();
    Outputs(const Outputs&) = delete;
    Outputs& operator=(const Outputs&) = delete;

    /// Opens the outputs again only if their names, the layout or the field have changed.
    void configure(const OutputSettings& settings);
    void play(physvib_world world, const physvib_event& event);
    /// Once a frame: sends motor commands. `gameSeconds`: duration of the frame in game time.
    void update(double gameSeconds);
    /// Peaks of the first device in the last second, see LiveDevice.
    std::vector<double> recentPeaks() const;
    void pause(); ///< stops motors and sound until the next update
    void close(); ///< stops all motors and closes the devices

private:
    std::string open(const std::string& name); ///< returns the error
    void sendToPads(physvib_world world, const physvib_event& event);

    GDExtensionObjectPtr node;
    OutputSettings settings{};
    std::unique_ptr<SoundOutput> sound;
    physvib_pads pads = nullptr;
    bool isOpen = false, hasPhone = false, hasHands = false;
    XrHands hands;
    std::vector<std::unique_ptr<LiveDevice>> devices;
    std::vector<OscSender> oscSenders;
    unsigned vibratingPads = 0;                 ///< bit j: controller j has a command
    double clockSeconds = 1.0, timeScale = 1.0; ///< motors run in real time, also in slow motion
    std::int64_t lastUpdateUs = 0;              ///< of Godot's clock
};

} // namespace physvib::godot
