// SPDX-License-Identifier: MIT
// JSON designs of parameter sweeps: many renders defined by their varied parameters, each accessible by
// number.
#pragma once
#include "Io/Result.h"
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// Version of the format that can be read.
constexpr int sweepFormatVersion = 1;

/// A varied parameter: an option of `physvib render` without its dashes, or a variable of a scene.
struct SweepFactor {
    std::string name;
    std::string place; ///< location in the file, for messages
    std::vector<std::string> values;
};

struct SweepScene {
    std::string name; ///< name of a built-in scene, or a path
    std::vector<SweepFactor> variables;
};

/// Seeds as a list, or as a first seed and a count.
struct SweepSeeds {
    std::vector<std::uint32_t> list;
    std::uint32_t first = 1, count = 0;
    std::uint64_t size() const noexcept { return list.empty() ? count : list.size(); }
    std::uint32_t at(std::uint64_t index) const noexcept {
        return list.empty() ? first + static_cast<std::uint32_t>(index) : list[index];
    }
};

/// One render: its values, in the order of the design.
struct SweepTask {
    std::string scene;
    std::vector<std::string> variables, options; ///< values of the scene's variables and of the design's
                                                 ///< factors
    std::uint32_t seed = 1;
    std::string call; ///< "render SCENE ...": the arguments without the program name
};

/// Every combination of values. Later entries of the file vary faster, and seeds fastest.
struct SweepDesign {
    std::string name;
    std::vector<SweepScene> scenes;
    std::vector<SweepFactor> factors; ///< factors common to all scenes
    std::vector<std::string> sounds;  ///< "HZ=FILE.wav", for each task whose method is SV
    SweepSeeds seeds;

    /// Number of tasks. Any thread.
    std::uint64_t size() const noexcept;
    /// The task with that number, from 0. Any thread.
    SweepTask task(std::uint64_t index) const;
};

/// Parses a design of 1 to limits::maxSweepTasks tasks; otherwise one line on the first error, `name:
/// laws[1]: expected ...`. Option values are not checked against `render` here. Any thread.
Result<SweepDesign> readSweep(std::string_view text, std::string_view name);

} // namespace physvib
