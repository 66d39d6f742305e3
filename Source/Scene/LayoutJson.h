// SPDX-License-Identifier: MIT
// Reads and writes a layout as part of another JSON file. Included by .cpp files only.
#pragma once
#include "Io/Json/FieldJson.h"
#include "Scene/LayoutFile.h"

namespace physvib {

/// The layout in a JSON object. Throws JsonError.
LayoutDescription readCustom(const JsonField& json, const Custom<LayoutDescription>&);
OrderedJson writeCustom(const Custom<LayoutDescription>&, const LayoutDescription& layout);

} // namespace physvib
