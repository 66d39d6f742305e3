// SPDX-License-Identifier: MIT
// Recordings of contacts that a renderer plays instead of modes, one per material.
#pragma once
#include <span>

namespace physvib {

/// A recording is found by the frequency of its events. The caller keeps the samples alive as long as the
/// renderer; they are at the renderer's rate.
struct RecordedContact {
    double frequencyHz = 0.0;
    std::span<const float> samples; ///< for an event of amplitude 1
};

/// The recordings of a renderer; without any, all events play modes.
struct RecordedContacts {
    std::span<const RecordedContact> list{}; ///< at the renderer's rate
    bool othersAreModes = false; ///< events without a recording play their mode; if false they are rejected
};

} // namespace physvib
