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

/// `state` as that preset has it: a scene keeps layout, notes' voice and parameters, an instrument has its
/// own. M only.
void takePlugInPreset(PluginState& state, int index);

/// What a new instance plays: notes and beats on four enchanters, nothing by itself. M only.
PluginState newPluginState();

} // namespace physvib
