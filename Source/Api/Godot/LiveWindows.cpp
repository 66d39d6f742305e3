// SPDX-License-Identifier: MIT
// libphysvib-live is not built for Windows: its devices are refused, and what Godot itself drives plays on.
#include "Api/Godot/Outputs.h"

namespace physvib::godot {

Live::~Live() = default;

std::string Live::open(const std::string& device, const physvib_layout&, double, double, double,
                       const std::string&) {
    return "outputs: " + device +
           ": expected controllers, phone or osc:HOST:PORT, because other devices are not for Windows";
}

void Live::setLevel(double) {}

void Live::play(physvib_world, const physvib_event&) {}

std::vector<double> Live::left(int) const { return {}; }

} // namespace physvib::godot
