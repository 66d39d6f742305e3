// SPDX-License-Identifier: GPL-3.0-or-later
// From the state of an instance to what renders it.
#pragma once
#include "Files/PluginState.h"
#include "Host/Session.h"

namespace physvib {

/// A preset's layout with its name. M only.
LayoutDescription presetLayout(std::string_view name);

/// What a new instance plays: "shake the box" on four enchanters, running free. M only.
PluginState newPluginState();

inline int enchantersOf(const PluginState& state) noexcept { return state.layout.geometry.count; }

/// Any thread.
PhantomPanner pannerOf(const PluginState& state, PanningLaw law, double exponent) noexcept;
SessionSetup sessionSetupOf(const PluginState& state);

/// From a strike at full scale until it has fallen out of hearing, at the smallest decay of the scene. Any thread.
double longestRingSeconds(const PluginState& state) noexcept;

} // namespace physvib
