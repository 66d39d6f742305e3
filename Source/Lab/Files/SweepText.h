// SPDX-License-Identifier: MIT
// Converts a task of a sweep design to the text of its `render` call.
#pragma once
#include "Lab/Files/SweepFile.h"
#include <string>
#include <string_view>

namespace physvib {

/// Kind of a word in a design: a scene, or the value of a scene variable or of an option.
enum class SweepWord { scene, variable, option };

/// True if a call can set a variable with that name. Any thread.
bool isSweepVariable(std::string_view name);

/// Empty, or why a call may not contain that word. Users copy calls from tables into a shell, and a design
/// can be an untrusted file, like a protocol. Any thread (allocates).
std::string sweepWordFault(SweepWord kind, const std::string& name, const std::string& word);

/// The complete call of the task's render, "render SCENE ...". Any thread (allocates).
std::string sweepCall(const SweepTask& task, const SweepScene& scene, const SweepDesign& design);

} // namespace physvib
