// SPDX-License-Identifier: GPL-3.0-or-later
// Outputs of the strips: what the mixer state says is what the device plays.
#pragma once
#include "Live/Documents/Strip.h"
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace physvib {

class Desk;
struct DeviceChoice;

/// Sets the strips' outputs to those that are played, by actuator. Any thread.
void takeOutputs(const std::vector<int>& played, std::span<Strip> strips);

/// Leaves to listeners and measuring devices what they use: strips from number `first` on, which are new, get
/// other outputs. Headphones have two. Returns the strips without one. Any thread.
std::vector<std::size_t> placeNew(const DeviceChoice& choice, std::span<Strip> strips, std::size_t first);

/// Opens a device as headphones: the first actuator is heard left and the second right, at the level at which
/// a monitor begins, or lower. Result as Desk::open(). Message thread only.
std::string useHeadphones(Desk& desk, DeviceChoice choice);

/// Reports strips for which headphones have no output. Message thread only.
void reportNoEar(Desk& desk, const std::vector<std::size_t>& strips);

/// Reports strips that lost their output to another one, with a button that gives them free outputs. Message
/// thread only.
void reportWithout(Desk& desk, const std::vector<std::size_t>& strips);

} // namespace physvib
