// SPDX-License-Identifier: MIT
// Converts a task of a sweep design to the text of its `render` call.
#pragma once
#include "Io/Text/NumberText.h"
#include "Lab/Files/SweepFile.h"
#include "Lab/Study/Protocol.h"
#include <algorithm>
#include <string>
#include <string_view>

namespace physvib {

/// Kind of a word in a design: a scene, or the value of a scene variable or of an option.
enum class SweepWord { scene, variable, option };

/// True if a call can set a variable with that name. Any thread.
inline bool isSweepVariable(std::string_view name) {
    return !name.empty() && name.find('=') == name.npos && std::ranges::all_of(name, isPlainCharacter);
}

/// Empty, or why a call may not contain that word. Users copy calls from tables into a shell, and a design
/// can be an untrusted file, like a protocol. Any thread (allocates).
inline std::string sweepWordFault(SweepWord kind, const std::string& name, const std::string& word) {
    if (word.empty() || !std::ranges::all_of(word, isPlainCharacter))
        return "expected letters, digits and _-+.,:=/%, found " + inQuotes(word);
    if (kind == SweepWord::scene && word.starts_with('-'))
        return "expected the name of a scene, found " + inQuotes(word);
    const char* const before = kind == SweepWord::scene ? "" : kind == SweepWord::variable ? "--set " : "--";
    return callFault(std::string{"render "} + before + (kind == SweepWord::scene ? word : name + '=' + word));
}

/// The complete call of the task's render, "render SCENE ...". Any thread (allocates).
inline std::string sweepCall(const SweepTask& task, const SweepScene& scene, const SweepDesign& design) {
    std::string call = "render " + task.scene;
    for (std::size_t v = 0; v < task.variables.size(); ++v)
        call += " --set " + scene.variables[v].name + '=' + task.variables[v];
    call += " --seed=" + std::to_string(task.seed);
    for (std::size_t f = 0; f < task.options.size(); ++f) {
        call += " --" + design.factors[f].name + '=' + task.options[f];
        if (design.factors[f].name == "method" && task.options[f] == "SV")
            for (const std::string& sound : design.sounds) call += " --sound " + sound;
    }
    return call;
}

} // namespace physvib
