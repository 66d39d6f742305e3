// SPDX-License-Identifier: MIT
// Layouts as JSON: where the enchanters sit, what they are called, and what drives them.
#pragma once
#include "Core/EnchanterLayout.h"
#include "Io/Result.h"
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// What a layout file says of one enchanter besides its place.
struct EnchanterDescription {
    std::string label;             ///< unique in its layout, not empty
    std::string actuator = "none"; ///< name of an actuator profile
    double fullScaleG = 1.0;       ///< acceleration, in g, at an amplitude of 1
    bool operator==(const EnchanterDescription&) const = default;
};

/// A layout with names; enchanters[j] sits at geometry.places[j], and there are geometry.count of them.
struct LayoutDescription {
    std::string name;
    EnchanterLayout geometry;
    std::vector<EnchanterDescription> enchanters;
};

/// A layout without a file, e.g. a preset: labels A, B, C..., everything else by default. Any thread.
LayoutDescription describeLayout(std::string name, const EnchanterLayout& geometry);

/// The preset of that name, which there is; its enchanters keep what drove those of `before`. Any thread.
LayoutDescription presetLayout(std::string_view name, const std::vector<EnchanterDescription>& before = {});

/// A preset by its name, else the layout of the file. M only.
Result<LayoutDescription> findLayout(const std::string& nameOrPath);

/// The layout that `text` describes; or, of the first thing that is wrong, one line
/// `name: enchanters[3].x_m: expected a number, found a string`. Required: extent_m (both > 0), enchanters (1
/// to limits::maxEnchanters), and of each x_m and y_m within the extent. A missing label becomes the first of
/// A, B, C... that no other enchanter has. Unknown and repeated fields are errors. Any thread.
Result<LayoutDescription> readLayout(std::string_view text, std::string_view name);

/// The same of a file. M only.
Result<LayoutDescription> loadLayout(const std::filesystem::path& path);

/// `layout` as JSON, one enchanter per line; readLayout gives it back bit for bit. Any thread.
std::string layoutJson(const LayoutDescription& layout);

} // namespace physvib
