// SPDX-License-Identifier: GPL-3.0-or-later
// A plug-in instance's state as settings of its renderer and session, edits of it, and the built-in presets.
#pragma once
#include "Live/Documents/PluginState.h"
#include "Live/Session/Session.h"
#include "MidiMap.h"
#include <optional>
#include <string>
#include <vector>

namespace physvib {

inline int enchantersOf(const PluginState& state) noexcept { return state.layout.geometry.count; }

/// As many strips as there are enchanters, and no equaliser beyond. Any thread.
void fitToLayout(PluginState& state);

/// Arranges the actuators as that layout preset; they keep their profiles and strips. M only.
void usePreset(PluginState& state, std::string_view name);

/// Replaces the scene. Note rules keep their materials and bodies by name, or are left out. Any thread.
void useScene(PluginState& state, Scene scene);

/// True if a take of `a` can play on with `b`: only the mix differs. Any thread.
bool isSameTake(const PluginState& a, const PluginState& b);

/// Any thread.
PhantomPanner pannerOf(const PluginState& state, PanningLaw law, double exponent) noexcept;
SessionSetup sessionSetupOf(const PluginState& state);

/// Whether anything can ever move: bodies, a script, inputs of the scene, notes that drop bodies. Without,
/// all is rendered in the call, without the output latency of a world. Any thread.
bool hasWorld(const PluginState& state) noexcept;

/// The value in the parameter's unit; its default if the state has none. Any thread.
double valueIn(const PluginState& state, Parameter which);
/// Sets it, clamped to the parameter's range. Any thread.
void setParameter(PluginState& state, Parameter which, double value);

/// Whether a parameter changes what such a state plays, now or by a note: else it is not shown. Any thread.
bool uses(const PluginState& state, const NoteKnobs& knobs, Parameter which) noexcept;

/// Infinite: a world goes on by itself. Without one, from a strike at full scale until it has fallen out of
/// hearing, at the smallest decay of the scene. Any thread.
double tailSeconds(const PluginState& state, const NoteKnobs& knobs = {}) noexcept;

/// A parameter's value in a state: choices by word, so that others may join (decision 34). Any thread.
ParameterValue stateValue(const ParameterRow& row, double value);
/// The value in the parameter's unit; none if the row has no such word. Any thread.
std::optional<double> valueOfState(const ParameterRow& row, const ParameterValue& value);

/// What is wrong with a state's parameters: ids and words that are not there; empty: nothing. Any thread.
std::string faultOfParameters(const PluginState& state);

/// Names of presets: the built-in scenes, whose places hosts keep, then instruments, without bodies. M only.
const std::vector<std::string>& presetNames();

/// A preset's name in words: built-in worlds are named as their files are. Any thread.
std::string shownName(std::string name);

/// The place of the preset that a state plays; its own are shown as the first. Any thread.
int presetOf(const PluginState& state);

/// `state` as that preset has it, whatever was chosen before: with its own voice, notes and parameters of
/// notes, on as many actuators as there are outputs (0: as it is made for). A scene keeps a layout of one's
/// own that has outputs enough. M only.
void useBuiltIn(PluginState& state, int index, int outputs = 0);

/// Other places for as many actuators as there are outputs, by the arrangement of the preset that it plays;
/// they keep what drives them and their strips. M only.
void rearrange(PluginState& state, int outputs);

/// The strike level in dB of the state's preset, at least the parameter's default. M only.
double usualStrikeDb(const PluginState& state);

/// What a new instance plays: notes and beats, nothing by itself. M only.
PluginState newPluginState(int outputs = 4);

} // namespace physvib
