// SPDX-License-Identifier: MIT
// Resolves the value of --layout: presets, special layouts, or a file.
#pragma once
#include "Core/EventShaping.h"
#include "Scene/LayoutFile.h"
#include <string>

namespace physvib {

/// Minimum full scale of an actuator for the studies: their fixed level plus 1 dB of headroom below the
/// limiter.
constexpr double leastStudyFullScaleG = 1.122018454301963 * RenderingMethod::fixedLevelG;

/// A preset, or the layout file at that path. study1 is phone1 with actuators of 2 g: an assumption, to be
/// replaced by a layout of the real set-up. dualsense is its two coils, left and right grip; their distance
/// and full scale of 1 g are assumed (Docs/pads.md).
inline Result<LayoutDescription> layoutNamed(const std::string& name) {
    constexpr double studyFullScaleG = 2.0;
    if (name == "dualsense") {
        LayoutDescription grips = presetLayout("phone2");
        grips.name = name;
        grips.geometry = {0.11, 0.05, 2, {}};
        grips.geometry.places[0] = {0.0, 0.025}, grips.geometry.places[1] = {0.11, 0.025};
        return grips;
    }
    if (name != "study1") return findLayout(name);
    LayoutDescription layout = presetLayout("phone1");
    layout.name = name;
    for (EnchanterDescription& enchanter : layout.enchanters) enchanter.fullScaleG = studyFullScaleG;
    return layout;
}

} // namespace physvib
