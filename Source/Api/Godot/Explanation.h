// SPDX-License-Identifier: MIT
// Replaces the C names in explanations of physvib.h by those of Godot's inspector.
#pragma once

#include <string>
#include <string_view>

namespace physvib::godot {

/// The sentence of physvib_world_explain, with properties and nodes of Godot instead of names of C. Any
/// thread.
std::string inGodotsWords(std::string_view sentence);

} // namespace physvib::godot
