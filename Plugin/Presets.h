// SPDX-License-Identifier: GPL-3.0-or-later
// Built-in presets of the plug-in: scenes, and instruments without bodies.
#pragma once
#include "Live/Documents/PluginState.h"
#include <string>
#include <vector>

namespace physvib {

/// The built-in scenes first, whose places hosts have kept, then the instruments. M only.
const std::vector<std::string>& presetNames();

/// The place of the preset that a state plays; its own are shown as the first. Any thread.
int presetOf(const PluginState& state);

/// `state` as that preset has it: a scene keeps notes' voice and parameters, and the layout unless it has
/// more actuators than outputs; an instrument has its own, on as many actuators as there are outputs. 0
/// outputs: as many actuators as it is made for. M only.
void takePlugInPreset(PluginState& state, int index, int outputs = 0);

/// Other places for as many actuators as there are outputs, by the arrangement of the preset that it plays;
/// they keep what drives them and their strips. M only.
void placeAnew(PluginState& state, int outputs);

/// The strike level up to which a file of such a preset is no louder than the preset itself. M only.
double usualStrikeDb(const PluginState& state);

/// What a new instance plays: notes and beats, nothing by itself. M only.
PluginState newPluginState(int outputs = 4);

} // namespace physvib
