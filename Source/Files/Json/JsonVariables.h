// SPDX-License-Identifier: MIT
// A scene file's variables: named choices, each of which replaces some of the file's values. For the .cpp
// files of Files.
#pragma once
#include "Files/SceneFile.h"
#include "Files/Json/StrictJson.h"
#include <vector>

namespace physvib {

/// Takes "variables" out of `root`, and replaces what the chosen ones say:
///   [{ "name": "height", "default": "1", "choices": [{ "value": "1", "set": { POINTER: VALUE, ... } }, ...]
///   }]
/// A POINTER (JSON Pointer, RFC 6901) names a value that the file has. Variables act in their order. Throws
/// JsonError.
std::vector<SceneVariable> applyVariables(Json& root, const SceneSettings& settings);

} // namespace physvib
