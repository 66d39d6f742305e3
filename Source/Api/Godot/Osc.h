// SPDX-License-Identifier: MIT
// Sends events to a program that speaks Open Sound Control. For Godot's main thread.
#pragma once

#include "Api/Godot/Binding.h"

#include <physvib/physvib.h>

#include <string>

namespace physvib::godot {

class Osc {
public:
    /// `address`: such as 127.0.0.1:9000. Returns the error; empty: it will send. Waits for a host's address.
    std::string open(const std::string& address);
    /// As /physvib/strike of Docs/messages.md: now, at its place in metres of the field.
    void play(const physvib_event& event) const;

private:
    Value peer; ///< Godot's PacketPeerUDP
};

} // namespace physvib::godot
