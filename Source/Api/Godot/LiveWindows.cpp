// SPDX-License-Identifier: MIT
// LiveDevice on Windows, for which libphysvib-live is not built: open() refuses all devices.
#include "Api/Godot/Outputs.h"

namespace physvib::godot {

LiveDevice::~LiveDevice() = default;

std::string LiveDevice::open(const std::string& device, const physvib_layout&, double, double, double,
                             const std::string&) {
    return "outputs: " + device +
           ": expected controllers, phone or osc:HOST:PORT, because other devices are not for Windows";
}

void LiveDevice::setLevel(double) {}

void LiveDevice::play(physvib_world, const physvib_event&) {}

std::vector<double> LiveDevice::recentPeaks(int) const { return {}; }

} // namespace physvib::godot
