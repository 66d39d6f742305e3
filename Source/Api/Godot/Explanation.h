// SPDX-License-Identifier: MIT
// Replaces the C names in explanations of physvib.h by those of Godot's inspector.
#pragma once
#include <string>
#include <string_view>

namespace physvib::godot {
/// Translates a sentence of physvib_world_explain() to properties and nodes of Godot. Any thread.
std::string translateForGodot(std::string_view sentence);

} // namespace physvib::godot
