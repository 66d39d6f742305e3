// SPDX-License-Identifier: GPL-3.0-or-later
// What --layout means everywhere.
#pragma once
#include "Files/LayoutFile.h"
#include <string>

namespace physvib {

/// A preset, or the layout file at that path.
inline Result<LayoutDescription> layoutNamed(const std::string& name) {
    EnchanterLayout preset;
    if (layoutPreset(name, preset)) return describeLayout(name, preset);
    return loadLayout(name);
}

} // namespace physvib
