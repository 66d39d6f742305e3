// SPDX-License-Identifier: MIT
// Designs of sweeps as JSON: many renders as what differs between them, each to be had by its number.
#pragma once
#include "Io/Result.h"
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// The version of the format that is read.
constexpr int sweepFormatVersion = 1;

/// What is varied: an option of `physvib render` without its dashes, or a variable of a scene.
struct SweepFactor {
    std::string name;
    std::string place; ///< in the file, for messages
    std::vector<std::string> values;
};

struct SweepScene {
    std::string name; ///< of a built-in scene, or a path
    std::vector<SweepFactor> variables;
};

/// Seeds one by one, or so many from the first on.
struct SweepSeeds {
    std::vector<std::uint32_t> list;
    std::uint32_t first = 1, count = 0;
    std::uint64_t size() const noexcept { return list.empty() ? count : list.size(); }
    std::uint32_t at(std::uint64_t index) const noexcept {
        return list.empty() ? first + static_cast<std::uint32_t>(index) : list[index];
    }
};

/// One render: the values that are its own, in the order of its design.
struct SweepTask {
    std::string scene;
    std::vector<std::string> variables, options; ///< of the scene's variables, of the design's factors
    std::uint32_t seed = 1;
    std::string call; ///< "render SCENE ...": the words that make it, without the name of the program
};

/// Every combination; what stands later in the file changes first, seeds before all others.
struct SweepDesign {
    std::string name;
    std::vector<SweepScene> scenes;
    std::vector<SweepFactor> factors; ///< of all scenes
    std::vector<std::string> sounds;  ///< "HZ=FILE.wav", of each task whose method is SV
    SweepSeeds seeds;

    /// How many tasks it has. Any thread.
    std::uint64_t size() const noexcept;
    /// One of them, from 0 on. Any thread.
    SweepTask task(std::uint64_t index) const;
};

/// The design that `text` describes, of 1 to limits::maxSweepTasks tasks; or, of the first thing that is
/// wrong, one line `name: laws[1]: expected ...`. Whether `render` knows an option's value is not asked here.
/// Any thread.
Result<SweepDesign> readSweep(std::string_view text, std::string_view name);

} // namespace physvib
