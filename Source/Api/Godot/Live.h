// SPDX-License-Identifier: MIT
// An open device of libphysvib-live. That library is loaded when a world names a device, so that games that
// rumble only need none of what it needs. For Godot's main thread.
#pragma once

#include <physvib/physvib-live.h>

#include <string>
#include <vector>

namespace physvib::godot {

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

} // namespace physvib::godot
