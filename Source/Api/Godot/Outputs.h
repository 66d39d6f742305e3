// SPDX-License-Identifier: MIT
// Where a world's events are felt: controllers and phones through Godot, other devices through
// libphysvib-live. For Godot's main thread.
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
    /// `address`: such as 127.0.0.1:9000. Returns the error; empty: it will send. Waits for a host's address.
    std::string open(const std::string& address);
    /// As /physvib/strike of Docs/messages.md: now, at its place in metres of the field.
    void play(const physvib_event& event) const;

private:
    Value peer; ///< Godot's PacketPeerUDP
};

/// An open device of libphysvib-live. That library is loaded when a world names a device, so that games that
/// rumble only need none of what it needs.
class Live {
public:
    Live() = default;
    ~Live();
    Live(const Live&) = delete;
    Live& operator=(const Live&) = delete;

    /// Returns the error; empty: it is open. Waits for the device. `sessionFile`: where all of its events are
    /// written; empty: nowhere.
    std::string open(const std::string& device, const physvib_layout& layout, double levelDb,
                     double fieldWidthMetres, double fieldHeightMetres, const std::string& sessionFile);
    void setLevel(double levelDb);
    void play(physvib_world world, const physvib_event& event);
    /// The peak that left for each of `actuators` in the last second, 1: full scale; empty: not all of it
    /// left.
    std::vector<double> left(int actuators) const;

private:
    physvib_live live = nullptr;
    physvib_int64 startNs = 0; ///< session time of the world's time 0
};

/// Pulses of the two hands of an XR interface, in the hertz of what is felt. Each frame sends how strong the
/// strongest hit still rings, so that a weak one never ends a strong one.
class XrHands {
public:
    static constexpr const char* names[] = {"left_hand", "right_hand"}; ///< Godot's trackers, and parts
    /// On the hand that the event's part names; otherwise on both.
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

/// The hits as sound, left and right by their place, by a player of Godot's that a renderer fills.
class Sound {
public:
    Sound() = default;
    ~Sound();
    Sound(const Sound&) = delete;
    Sound& operator=(const Sound&) = delete;
    /// A child of `world`, a node, on that bus. Returns the error; empty: it will play.
    std::string open(GDExtensionObjectPtr world, const std::string& bus, double fieldWidthMetres,
                     double fieldHeightMetres);
    void play(physvib_event event);
    void update(); ///< once a frame: what Godot has played since is filled up again
    void rest();   ///< it stops until the next update

private:
    std::uint64_t player = 0; ///< Godot's number of it: it goes with the world
    physvib_renderer renderer = nullptr;
    double rate = 0.0, filled = 0.0; ///< frames
    std::int64_t later = 0;          ///< ns from the world's time to the stream's
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
    explicit Outputs(GDExtensionObjectPtr of); ///< `of`: the world's node
    ~Outputs();
    Outputs(const Outputs&) = delete;
    Outputs& operator=(const Outputs&) = delete;

    /// Opens outputs anew only if others are wanted, or elsewhere in the field.
    void configure(const OutputSettings& settings);
    void play(physvib_world world, const physvib_event& event);
    /// Once a frame: commands of the motors. `gameSeconds`: of the frame, as the game has them.
    void update(double gameSeconds);
    /// What left the first device in the last second, see Live.
    std::vector<double> left() const;
    void rest();  ///< the motors stop until the next update
    void close(); ///< all motors stop, the devices are closed

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
    unsigned rumbling = 0;                      ///< bit j: the motors of controller j have a command
    double clockSeconds = 1.0, timeScale = 1.0; ///< of the player, whose motors know no slow motion
    std::int64_t lastUpdate = 0;                ///< us of the system
};

} // namespace physvib::godot
