// SPDX-License-Identifier: MIT
// Reads a layout that is embedded in another JSON file. For .cpp files that read JSON.
#pragma once
#include "Io/Json/JsonField.h"
#include "Scene/LayoutFile.h"

namespace physvib {

/// The layout in a JSON object. Throws JsonError.
LayoutDescription readLayoutFields(const JsonField& root);

} // namespace physvib
