// SPDX-License-Identifier: MIT
// Recordings of contacts that a renderer plays instead of modes, one per material.
#pragma once
#include "Core/SoundNumber.h"
#include <span>

namespace physvib {

/// A recording is found by the number of its sound or, if it has none, by the frequency of its events. The
/// caller keeps the samples alive as long as the renderer; they are at the renderer's rate.
struct RecordedContact {
    double frequencyHz = 0.0;
    std::span<const float> samples; ///< for an event of amplitude 1
    SoundNumber sound = 0;          ///< 0: of all events of that frequency whose own sound has no recording
};

/// The recordings of a renderer; without any, all events play modes.
struct RecordedContacts {
    std::span<const RecordedContact> list{}; ///< at the renderer's rate
    bool othersAreModes = false; ///< events without a recording play their mode; if false they are rejected
};

} // namespace physvib
