// SPDX-License-Identifier: MIT
// The one place where a design of a sweep becomes the words of a call.
#pragma once
#include "Lab/Files/SweepFile.h"
#include <string>
#include <string_view>

namespace physvib {

/// What a word of a design is: a scene, a value of a scene's variable, or of an option.
enum class SweepWord { scene, variable, option };

/// Whether a call can set a variable of that name. Any thread.
bool isSweepVariable(std::string_view name);

/// Empty, or why a call cannot hold that word. Calls stand in tables for somebody to copy into a shell, and a
/// design may be a stranger's: as in a protocol. Any thread (allocates).
std::string sweepWordFault(SweepWord kind, const std::string& name, const std::string& word);

/// "render SCENE ...": all that makes the task's render. Any thread (allocates).
std::string sweepCall(const SweepTask& task, const SweepScene& scene, const SweepDesign& design);

} // namespace physvib
