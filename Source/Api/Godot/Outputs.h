// SPDX-License-Identifier: MIT
// Where a world's events are felt: controllers and phones through Godot, other devices through
// libphysvib-live. For Godot's main thread.
#pragma once
#include "Api/Godot/Binding.h"
#include <array>
#include <memory>
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

class Live;

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

struct OutputSettings {
    std::vector<std::string> names; ///< controllers, phone, xr, osc:HOST:PORT, or a device of libphysvib-live
    bool isSilent;
    physvib_layout layout;
    double levelDb, fieldWidthMetres, fieldHeightMetres;
    std::string sessionFile; ///< of the first device; empty: none
};

class Outputs {
public:
    Outputs();
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

    OutputSettings settings{};
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
