// SPDX-License-Identifier: MIT
// Interface of a source of samples, such as incoming audio, that a session mixes with the rendered events.
#pragma once
#include <cstdint>

namespace physvib {

/// Mixed before the actuators' own stages: level, equaliser, delay and limiter act on all samples alike.
class AddedSamples {
public:
    /// The renderer's frames from `frame` on (session time in frames), at most limits::tileFrames. One
    /// pointer per channel of the session; null: silence. Valid until the next call. Render thread (R),
    /// wait-free.
    virtual const float* const* at(std::int64_t frame, int frames) noexcept = 0;

protected:
    ~AddedSamples() = default;
};

} // namespace physvib
