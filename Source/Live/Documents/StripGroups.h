// SPDX-License-Identifier: MIT
// Effective gain and mute of strips, with their groups and lanes applied.
#pragma once
#include "Live/Documents/Mix.h"
#include <string>
#include <vector>

namespace physvib {

/// The strips as they are sent to the session: with their group's fader and mute applied, without group and
/// lanes. Any thread (allocates), as all functions here.
std::vector<Strip> feltStrips(const Mix& mix);

/// Whether the strip or its group has a lane.
bool hasLane(const Mix& mix, std::size_t strip);

/// The strip's gain at that time of the scene run, in dB: fader, group and both lanes.
double gainDbAt(const Mix& mix, std::size_t strip, double seconds);

/// Maximum of gainDbAt() over time; and the maximum that group and lanes add to the fader, not limited to a
/// fader's range.
double loudestDb(const Mix& mix, std::size_t strip);
double mostAddedDb(const Mix& mix, std::size_t strip);

/// Adds an empty group; returns its index.
int addGroup(Mix& mix, std::string name);
/// An unused name: "Left hand", "Right hand", "Back", then numbers.
std::string freeGroupName(const Mix& mix);
/// Removes a group without changing the output: its strips absorb its fader, mute and lane.
void removeGroup(Mix& mix, int group);

} // namespace physvib
