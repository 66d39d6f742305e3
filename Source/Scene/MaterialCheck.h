// SPDX-License-Identifier: MIT
// Validates materials alone, for scenes and for material tables, which need no shapes and no Box2D.
#pragma once
#include "Scene/Scene.h"
#include <string>
#include <vector>

namespace physvib {

/// Empty if all are valid; else one line that names the field, as files spell it, and what was expected:
/// ranges, and a name of its own for each. Any thread.
std::string validateMaterials(const std::vector<Material>& materials);

/// The same of the names alone. Events carry the number of a material's name, so two names must not share
/// one. Any thread.
std::string checkMaterialNames(const std::vector<Material>& materials);

} // namespace physvib
