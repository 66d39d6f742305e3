// SPDX-License-Identifier: GPL-3.0-or-later
// Who hears what a render makes, besides its files.
#pragma once

namespace physvib {

struct LoadedRender;

/// M only; on the thread of the render.
class RenderListener {
public:
    virtual ~RenderListener() = default;

    /// The inputs are read and the events known; `job` lives until the render is over.
    virtual void begin(const LoadedRender& job) = 0;

    /// The next frames of every channel, as the WAV gets them.
    virtual void take(const float* const* channels, int frames) = 0;
};

} // namespace physvib
