// SPDX-License-Identifier: GPL-3.0-or-later
// Outputs of the strips: what the mixer state says is what the device plays.
#pragma once
#include "Live/Documents/Strip.h"
#include <cstddef>
#include <span>
#include <vector>

namespace physvib {

class Desk;

/// Sets the strips' outputs to those that are played, by actuator. Any thread.
void takeOutputs(const std::vector<int>& played, std::span<Strip> strips);

/// Reports strips that lost their output to another one, with a button that gives them free outputs. Message
/// thread only.
void reportWithout(Desk& desk, const std::vector<std::size_t>& strips);

} // namespace physvib
