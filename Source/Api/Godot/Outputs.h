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
class Osc {
public:
    /// `address`: such as 127.0.0.1:9000. Returns the error, or empty. Waits until the host name is resolved.
    std::string open(const std::string& address);
    /// Sends /physvib/strike of Docs/messages.md at once; places are in metres of the field.
    void play(const physvib_event& event) const;

private:
    Value peer; ///< Godot's PacketPeerUDP
};

/// An open device of libphysvib-live. The library is loaded when a world names a device, so that games
/// without one do not need the libraries it needs.
class Live {
public:
    Live() = default;
    ~Live();
    Live(const Live&) = delete;
    Live& operator=(const Live&) = delete;

    /// Returns the error, or empty. Waits for the device. `sessionFile`: file for its events, or empty.
    std::string open(const std::string& device, const physvib_layout& layout, double levelDb,
                     double fieldWidthMetres, double fieldHeightMetres, const std::string& sessionFile);
    void setLevel(double levelDb);
    void play(physvib_world world, const physvib_event& event);
    /// Peak sent to each of `actuators` in the last second, 1: full scale; empty if not all of it was sent.
    std::vector<double> left(int actuators) const;

private:
    physvib_live live = nullptr;
    physvib_int64 startNs = 0; ///< session time of the world's time 0
};

/// Haptic pulses for the two hands of an XR interface, at the frequency of the event. Each frame sends the
/// remaining amplitude of the strongest hit, so that a weak hit never ends a strong one.
class XrHands {
public:
    static constexpr const char* names[] = {"left_hand", "right_hand"}; ///< Godot's trackers, and parts
    /// Plays on the hand that the event's part names, otherwise on both.
    void play(const physvib_event& event, double nowSeconds);
    void update(double nowSeconds);
    void rest();

private:
    struct Ringing {
        double amplitude, decayPerSecond, hertz, sinceSeconds;
        bool isRinging;
    };
    static double left(const Ringing& of, double nowSeconds);
    static void send(std::size_t hand, double hertz, double amplitude);
    std::array<Ringing, 2> hands{};
};

/// Plays events as stereo sound, panned by their place: a renderer fills an audio player of Godot.
class Sound {
public:
    Sound() = default;
    ~Sound();
    Sound(const Sound&) = delete;
    Sound& operator=(const Sound&) = delete;
    /// Adds the player to the node `world`, on that audio bus. Returns the error, or empty.
    std::string open(GDExtensionObjectPtr world, const std::string& bus, double fieldWidthMetres,
                     double fieldHeightMetres);
    void play(physvib_event event);
    void update(); ///< once a frame: renders as many samples as Godot has room for
    void rest();   ///< stops the player until the next update

private:
    std::uint64_t player = 0; ///< Godot's instance id, since the world's node owns it
    physvib_renderer renderer = nullptr;
    double rate = 0.0, filled = 0.0; ///< frames
    std::int64_t later = 0;          ///< ns to add to the world's time for the stream's
};

struct OutputSettings {
    std::vector<std::string> names; ///< controllers, phone, xr, sound, osc:HOST:PORT, or a device of
                                    ///< libphysvib-live
    bool isSilent;
    physvib_layout layout;
    double levelDb, fieldWidthMetres, fieldHeightMetres;
    std::string sessionFile; ///< of the first device; empty: none
};

class Outputs {
public:
    explicit Outputs(GDExtensionObjectPtr of); ///< `of`: node of the world
    ~Outputs();
    Outputs(const Outputs&) = delete;
    Outputs& operator=(const Outputs&) = delete;

    /// Opens the outputs again only if their names, the layout or the field have changed.
    void configure(const OutputSettings& settings);
    void play(physvib_world world, const physvib_event& event);
    /// Once a frame: sends motor commands. `gameSeconds`: duration of the frame in game time.
    void update(double gameSeconds);
    /// Peaks of the first device in the last second, see Live.
    std::vector<double> left() const;
    void rest();  ///< stops motors and sound until the next update
    void close(); ///< stops all motors and closes the devices

private:
    std::string open(const std::string& name); ///< returns the error
    void strikePads(physvib_world world, const physvib_event& event);

    GDExtensionObjectPtr node;
    OutputSettings settings{};
    std::unique_ptr<Sound> sound;
    physvib_pads pads = nullptr;
    bool isOpen = false, hasPhone = false, hasHands = false;
    XrHands hands;
    std::vector<std::unique_ptr<Live>> devices;
    std::vector<Osc> receivers;
    unsigned rumbling = 0;                      ///< bit j: controller j has a command
    double clockSeconds = 1.0, timeScale = 1.0; ///< motors run in real time, also in slow motion
    std::int64_t lastUpdate = 0;                ///< us of the system
};

} // namespace physvib::godot
