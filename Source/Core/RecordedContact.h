// SPDX-License-Identifier: MIT
// The recording of one material's contact, as a renderer plays it.
#pragma once
#include <span>

namespace physvib {

/// Known by the frequency that its events have. The samples belong to somebody else and outlive whoever plays them; they are
/// at the renderer's rate.
struct RecordedContact {
    double frequencyHz = 0.0;
    std::span<const float> samples; ///< of an event of amplitude 1
};

} // namespace physvib
