// SPDX-License-Identifier: MIT
// The recordings of materials' contacts, as a renderer plays them.
#pragma once
#include <span>

namespace physvib {

/// Known by the frequency that its events have. The samples belong to somebody else and outlive whoever plays
/// them; they are at the renderer's rate.
struct RecordedContact {
    double frequencyHz = 0.0;
    std::span<const float> samples; ///< of an event of amplitude 1
};

/// What events play instead of modes; none: modes.
struct RecordedContacts {
    std::span<const RecordedContact> list{}; ///< at the renderer's rate
    bool othersAreModes = false; ///< events that have none of them play their mode; else they are rejected
};

} // namespace physvib
