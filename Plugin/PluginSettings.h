// SPDX-License-Identifier: GPL-3.0-or-later
// Functions on a plug-in state: its session's settings, changes of it, its parameters, and built-in presets.
#pragma once
#include "Live/Documents/PluginState.h"
#include "Live/Session/Session.h"
#include "MidiMap.h"
#include <optional>
#include <string>
#include <vector>

namespace physvib {

inline int actuatorCount(const PluginState& state) noexcept { return state.layout.geometry.count; }

/// Resizes the strips to the number of actuators and clears equalisers beyond it. Any thread.
void fitToLayout(PluginState& state);

/// Arranges the actuators as in the layout preset `name`; they keep their profiles and strips. M only.
void applyLayoutPreset(PluginState& state, std::string_view name);

/// Replaces the scene. Note rules whose material or body it has not, by name, are removed. Any thread.
void setScene(PluginState& state, Scene scene);

/// True if a run of state `a` can play on with state `b`, because only the mix differs. Any thread.
bool canKeepPlaying(const PluginState& a, const PluginState& b);

/// The panner and the session settings of a state. Any thread.
PhantomPanner makePanner(const PluginState& state, PanningLaw law, double exponent) noexcept;
SessionSetup makeSessionSetup(const PluginState& state);

/// True if anything can ever move: the scene has bodies, a script or inputs, or a note spawns bodies. If not,
/// no world is stepped, and L has no steps. Any thread.
bool hasWorld(const PluginState& state) noexcept;

/// A parameter's value in its unit; its default if the state has none. Any thread.
double parameterValue(const PluginState& state, Parameter which);
/// Sets a parameter's value, clamped to its range. Any thread.
void setParameter(PluginState& state, Parameter which, double value);

/// True if a parameter has an effect on what such a state plays; the window shows only these. Any thread.
bool isParameterUsed(const PluginState& state, const NoteKnobs& knobs, Parameter which) noexcept;

/// How long the output goes on after the last input: infinite with a world; else the time in which a strike
/// at full scale decays to nothing, at the smallest decay of the scene. Any thread.
double tailSeconds(const PluginState& state, const NoteKnobs& knobs = {}) noexcept;

/// A parameter's value as in a state: choices by word, so that others can join (decision 34). Any thread.
ParameterValue toStateValue(const ParameterRow& row, double value);
/// The reverse: the value in the parameter's unit; none if the row has no such word. Any thread.
std::optional<double> fromStateValue(const ParameterRow& row, const ParameterValue& value);

/// The first unknown id or word among a state's parameters, as an error line; empty: none. Any thread.
std::string parameterError(const PluginState& state);

/// Names of presets: the built-in scenes, whose indices hosts store, then instruments, without bodies. M
/// only.
const std::vector<std::string>& presetNames();

/// A preset's name for people: those of built-in scenes are file names. Any thread.
std::string displayName(std::string name);

/// Index of the preset whose scene a state has; 0 if it is none of them. Any thread.
int findPresetIndex(const PluginState& state);

/// Sets scene, voice, notes and note parameters to those of preset `index`, on `outputs` actuators (0: as
/// many as it is made for). A scene keeps a custom layout if there are outputs for it. M only.
void applyBuiltInPreset(PluginState& state, int index, int outputs = 0);

/// Arranges `outputs` actuators anew, as the state's preset arranges them; they keep their profiles and
/// strips. M only.
void rearrange(PluginState& state, int outputs);

/// The strike level in dB of the state's preset, at least the parameter's default. M only.
double presetStrikeDb(const PluginState& state);

/// The state of a new instance: the first instrument, which plays only by notes and beats. M only.
PluginState newPluginState(int outputs = 4);

} // namespace physvib
