// SPDX-License-Identifier: GPL-3.0-or-later
// What distinguishes the modules of one plug-in, and hosts know them by. All else is compiled once for all of
// them.
#pragma once

namespace physvib {

struct ModuleIdentity {
    /// One output bus of 1 to 16 channels, or many of one or two for hosts that support no wider ones.
    enum class Buses { oneBus, manyBuses };
    const char* name;
    Buses buses;
    int channels;   ///< of the one bus
    int musicPorts; ///< LV2's for music; 0: none
    const char* lv2Uri;
};

/// Of this module (Module.cpp). Constant-initialised: there before any other static. Any thread.
extern const ModuleIdentity moduleIdentity;

} // namespace physvib
