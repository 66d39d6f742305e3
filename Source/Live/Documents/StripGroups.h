// SPDX-License-Identifier: MIT
// What of a mix reaches its channels: strips behind their groups and lanes.
#pragma once
#include "Live/Documents/Mix.h"
#include <string>
#include <vector>

namespace physvib {

/// The strips as the session is told of them: with their group's fader and mute, in no group, without lanes.
/// Any thread (allocates), as all of these.
std::vector<Strip> feltStrips(const Mix& mix);

/// Whether a lane of the strip or of its group moves its gain.
bool hasLane(const Mix& mix, std::size_t strip);

/// The strip's gain at that time of the scene, in dB: fader, group and both lanes.
double gainDbAt(const Mix& mix, std::size_t strip, double seconds);

/// The same at its loudest; and what group and lanes add to the fader then, which is not held to a fader's
/// range.
double loudestDb(const Mix& mix, std::size_t strip);
double mostAddedDb(const Mix& mix, std::size_t strip);

/// One group more, with no strips yet; its number.
int addGroup(Mix& mix, std::string name);
/// A name that no group has: "Left hand", "Right hand", "Back", then numbers.
std::string freeGroupName(const Mix& mix);
/// Its strips are felt as before: they take over its fader, mute and lane.
void removeGroup(Mix& mix, int group);

} // namespace physvib
