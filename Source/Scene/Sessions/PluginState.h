// SPDX-License-Identifier: MIT
// What an instance of the plug-in plays, and as versioned JSON in its host's session: whole in itself, so that a
// session sounds the same when the built-in scenes have changed.
#pragma once
#include "Core/Actuators/ActuatorEqualiser.h"
#include "Scene/Sessions/Mix.h"
#include "Io/Result.h"
#include "Scene/Scene.h"
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace physvib {

/// The version of the format that is written, and the newest that is read. A new field makes a new version.
/// 2: choices by their words; what version 1 gave every instance as controllers is left out; strips, equalisers, the editor's size.
/// 3: direct strikes. 4: the parameter `beats`.
constexpr int pluginStateVersion = 4;

enum class TransportMode {
    free,         ///< the scene runs whenever the host renders
    restartOnPlay ///< it starts at its seed whenever the transport starts or jumps, and is silent while that stands
};

enum class NoteKind {
    strike, ///< sounds a material at a place, at once
    push,   ///< an impulse on a body of the scene
    spawn   ///< drops a disc of a material at a place
};

inline constexpr std::array<std::string_view, 3> noteKindNames{"strike", "push", "spawn"}; // as NoteKind

/// A note that does not do what the default map says.
struct NoteRule {
    int note = 0; ///< 0 to 127
    NoteKind kind = NoteKind::strike;
    int material = 0;   ///< strike, spawn: index into Scene::materials
    double x = 0.5;     ///< strike, spawn: place in parts of the field, 0 to 1 from the lower left corner
    double y = 0.5;
    std::string object; ///< push: name of a body that the scene starts with
    Vector atFullVelocity; ///< push: N s; spawn: m/s
    double radiusMetres = 0.1; ///< spawn
    bool operator==(const NoteRule&) const = default;
};

/// A controller that moves a parameter over its whole range.
struct ControllerRule {
    int controller = 0; ///< 0 to 119: the others are channel modes
    std::string parameter; ///< its id
    bool operator==(const ControllerRule&) const = default;
};

/// A number in the parameter's unit; the word of a choice, of which version 1 wrote the place.
using ParameterValue = std::variant<double, std::string>;

struct PluginState {
    Scene scene;
    std::uint32_t seed = 1;
    int stepsPerSecond = 100;
    LayoutDescription layout;
    std::vector<Strip> strips;      ///< one per enchanter, which leaves by the channel of its number; those missing are as new ones
    EqualisedActuators equalised{}; ///< per enchanter
    bool limiterEnabled = true;
    TransportMode transport = TransportMode::free;
    bool isDirect = false; ///< strikes by notes are felt the limiter's latency later, not L as collisions are
    std::vector<NoteRule> notes; ///< others: every octave is a material, every note a place from left (C) to right (B)
    std::vector<ControllerRule> controllers;
    int editorWidth = 0, editorHeight = 0; ///< in pixels; 0: as it comes
    std::vector<std::pair<std::string, ParameterValue>> parameters; ///< by their ids
};

/// The state that `text` describes; or, of the first thing that is wrong, one line
/// `name: notes[3].x: expected a number from 0 to 1, found 2`. Parameters and controllers may bear any ids. Any thread.
Result<PluginState> readPluginState(std::string_view text, std::string_view name);

/// `state` as JSON; readPluginState gives all of it back but the scene's variables, bit for bit. Any thread.
std::string pluginStateJson(const PluginState& state);

} // namespace physvib
