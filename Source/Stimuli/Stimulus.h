// SPDX-License-Identifier: MIT
// The stimulus of a study's trial as events for the renderer: amplitudes in g, times from 0.
#pragma once
#include "Core/CollisionEvent.h"
#include "Core/EnchanterLayout.h"
#include "Core/PhantomPanner.h"
#include "Stimuli/PulsePattern.h"
#include <vector>

namespace physvib {

// A place on the response field of a study, as a share of its width and height.

/// A place on the response field: x to the right, y downwards, both from 0 to 1.
struct FieldPlace {
    double x = 0.0, y = 0.0;
    bool operator==(const FieldPlace&) const = default;
};

/// Frequency and level of all stimuli of a set (thesis 3.2.1, Eq. 4.1).
struct Carrier {
    double frequencyHz = 205.0; ///< resonance of the thesis' LRA
    double levelG = 1.0;        ///< peak acceleration of an actuator at gain 1
};

/// Events in time order, and their panner. Amplitude 1 is 1 g: the drive of a channel is its samples divided
/// by the actuator's full scale in g.
struct Stimulus {
    std::vector<CollisionEvent> events;
    PhantomPanner panner;
    double seconds = 0.0; ///< from 0 to the end of the last event
};

/// Each pulse is a rectangular burst on one actuator alone, whatever the layout. `enchanters`: number of
/// actuators, 1 to 26, at least those that the pattern names. Message thread (M) only (allocates).
Stimulus patternStimulus(const PulsePattern& pattern, int enchanters, const Carrier& carrier,
                         double gapSeconds = pulseGapSeconds);

/// A stationary phantom at `place` of the layout's extent, all actuators in phase (Eq. 4.1 to 4.3). M only.
Stimulus phantomStimulus(const FieldPlace& place, const EnchanterLayout& layout, PanningLaw law,
                         double exponent, const Carrier& carrier, double seconds = 1.0);

/// A layout of `count` actuators in which each has gain 1 at its own place and 0 at those of all others:
/// exactly for up to four, below -250 dB for more. Any thread.
EnchanterLayout isolatingLayout(int count) noexcept;

// Measured level of a played stimulus.

/// Of the actuator with the highest level, after master level, strips and ceilings.
struct FeltLevel {
    double peakG = 0.0, rmsG = 0.0; ///< rmsG: over the stimulus' duration
    bool operator==(const FeltLevel&) const = default;
};

} // namespace physvib
