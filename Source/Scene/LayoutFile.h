// SPDX-License-Identifier: MIT
// Actuator layouts as JSON: places, labels, actuator profiles and full scales; and the layout that --layout
// names: a preset, a special layout or a file. Files call an actuator "enchanter", as the thesis does.
#pragma once
#include "Core/EnchanterLayout.h"
#include "Core/EventShaping.h"
#include "Io/Result.h"
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {
/// Properties of one actuator besides its place.
struct ActuatorDescription {
    std::string label;             ///< unique in its layout, not empty
    std::string actuator = "none"; ///< name of an actuator profile
    double fullScaleG = 1.0;       ///< acceleration, in g, at an amplitude of 1
    std::string part{};            ///< name of the part of the body that it is on; empty: none
    bool operator==(const ActuatorDescription&) const = default;
};

/// A named layout; actuators[j] describes the actuator at geometry.places[j], j < geometry.count.
struct LayoutDescription {
    std::string name;
    ActuatorLayout geometry;
    std::vector<ActuatorDescription> actuators;
};

/// A layout without a file, e.g. a preset: labels A, B, C..., parts as numbered, else default. Any thread.
LayoutDescription describeLayout(std::string name, const ActuatorLayout& geometry);

/// The preset of that name, which must exist, with profile and full scale of `previous`. Any thread.
LayoutDescription presetLayout(std::string_view name, const std::vector<ActuatorDescription>& previous = {});

/// Copies profile and full scale from `previous` to the actuators of the same number. Any thread.
void copyActuatorProperties(LayoutDescription& layout, const std::vector<ActuatorDescription>& previous);

/// A preset by name, else the layout of the file. Message thread only.
Result<LayoutDescription> findLayout(const std::string& nameOrPath);

/// The layout in `text`; or, for the first error, one line `name: enchanters[3].x_m: expected a number, found
/// a string`. Required: extent_m (both > 0), enchanters (1 to limits::maxActuators), and x_m and y_m of each
/// within the extent. z_m and part may be missing. A missing label becomes the first unused one of A, B, C...
/// Unknown and repeated fields are errors. Any thread.
Result<LayoutDescription> readLayout(std::string_view text, std::string_view name);

/// Reads a file, with the checks and errors of readLayout(). Message thread only.
Result<LayoutDescription> loadLayout(const std::filesystem::path& path);

/// `layout` as JSON, one actuator per line; readLayout restores it bit for bit. Any thread.
std::string layoutJson(const LayoutDescription& layout);

/// Minimum full scale of an actuator for the studies: their fixed level, and 1 dB for the limiter.
constexpr double minStudyFullScaleG = 1.122018454301963 * RenderingMethod::fixedLevelG;

/// The layout that --layout names: a preset, study1, dualsense, or the file at that path. study1 is phone1
/// with actuators of 2 g: an assumption, to be replaced by a layout of the real set-up. dualsense: the coils
/// in its left and right grip; distance and full scale are assumed (Docs/pads.md). Message thread.
inline Result<LayoutDescription> resolveLayout(const std::string& name) {
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
    for (ActuatorDescription& actuator : layout.actuators) actuator.fullScaleG = studyFullScaleG;
    return layout;
}

} // namespace physvib
