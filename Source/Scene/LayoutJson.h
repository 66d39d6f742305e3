// SPDX-License-Identifier: MIT
// A layout as part of another file. For the .cpp files of modules with files.
#pragma once
#include "Io/Json/FieldJson.h"
#include "Scene/LayoutFile.h"

namespace physvib {

/// The layout in a JSON object. Throws JsonError.
LayoutDescription readKind(const JsonField& json, const Own<LayoutDescription>&);
OrderedJson writeKind(const Own<LayoutDescription>&, const LayoutDescription& layout);

} // namespace physvib
