// SPDX-License-Identifier: MIT
// What is played in a trial, as events for the renderer: amplitudes in g, times from 0.
#pragma once
#include "Core/CollisionEvent.h"
#include "Core/EnchanterLayout.h"
#include "Core/PhantomPanner.h"
#include "Stimuli/FieldPlace.h"
#include "Stimuli/PulsePattern.h"
#include <vector>

namespace physvib {

/// The vibration of all stimuli of a set (thesis 3.2.1, Eq. 4.1).
struct Carrier {
    double frequencyHz = 205.0; ///< resonance of the thesis' LRA
    double levelG = 1.0;        ///< peak acceleration of an enchanter at gain 1
};

/// Events in time order, and how they are spread over the enchanters. Amplitude 1 is 1 g: a channel's samples
/// divided by its enchanter's full scale (in g) are what drives it.
struct Stimulus {
    std::vector<CollisionEvent> events;
    PhantomPanner panner;
    double seconds = 0.0; ///< from 0 to the last end
};

/// Each pulse a rectangular burst on one enchanter alone, whatever the layout looks like. `enchanters` 1 to
/// 26, at least those that the pattern names. M only (allocates).
Stimulus patternStimulus(const PulsePattern& pattern, int enchanters, const Carrier& carrier,
                         double gapSeconds = pulseGapSeconds);

/// A stationary phantom at `place` of the layout's extent, all enchanters in phase (Eq. 4.1 to 4.3). M only
/// (allocates).
Stimulus phantomStimulus(const FieldPlace& place, const EnchanterLayout& layout, PanningLaw law,
                         double exponent, const Carrier& carrier, double seconds = 1.0);

/// A layout of `count` enchanters in which each one's own place has gain 1 there and 0 at all others: exactly
/// for up to four, below -250 dB for more. Any thread.
EnchanterLayout isolatingLayout(int count) noexcept;

} // namespace physvib
