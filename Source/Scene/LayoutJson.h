// SPDX-License-Identifier: MIT
// A layout as part of another file. For the .cpp files of Files.
#pragma once
#include "Io/Json/JsonField.h"
#include "Scene/LayoutFile.h"

namespace physvib {

/// The layout in a JSON object. Throws JsonError.
LayoutDescription readLayoutFields(const JsonField& root);

} // namespace physvib
