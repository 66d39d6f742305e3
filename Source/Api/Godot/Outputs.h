// SPDX-License-Identifier: MIT
// Where a world's events are felt: controllers and phones through Godot, other devices through
// libphysvib-live. For Godot's main thread.
#pragma once

#include "Api/Godot/Osc.h"

#include <physvib/physvib.h>

#include <memory>
#include <string>
#include <vector>

namespace physvib::godot {

class Live;

struct OutputSettings {
    std::vector<Value> names; ///< controllers, phone, osc:HOST:PORT, or a device of libphysvib-live
    bool isSilent;
    physvib_layout layout;
    double levelDb, fieldWidthMetres, fieldHeightMetres;
};

class Outputs {
public:
    Outputs();
    ~Outputs();
    Outputs(const Outputs&) = delete;
    Outputs& operator=(const Outputs&) = delete;

    void configure(const OutputSettings& settings);
    void play(physvib_world world, const physvib_event& event);
    void update(physvib_world world); ///< once a frame: commands of the motors
    void close();                     ///< all motors stop, the device is closed

private:
    std::string open(const std::string& name); ///< returns the error

    OutputSettings settings{};
    physvib_pads pads = nullptr;
    bool hasPhone = false;
    std::vector<std::unique_ptr<Live>> devices;
    std::vector<Osc> receivers;
    unsigned rumbling = 0; ///< bit j: the motors of controller j have a command
};

} // namespace physvib::godot
