// SPDX-License-Identifier: MIT
// What is played sample by sample beside what events excite: music that has come in.
#pragma once
#include <cstdint>

namespace physvib {

/// Added before the actuators' own stages: level, equaliser, delay and limiter act on it as on everything
/// else.
class AddedSamples {
public:
    /// The renderer's frames from `frame` on, which is session time in frames; at most limits::tileFrames of
    /// them. A pointer for each of the session's channels; null: silence. Valid until the next call. R,
    /// wait-free.
    virtual const float* const* at(std::int64_t frame, int frames) noexcept = 0;

protected:
    ~AddedSamples() = default;
};

} // namespace physvib
