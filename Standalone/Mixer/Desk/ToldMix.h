// SPDX-License-Identifier: GPL-3.0-or-later
// Tracks which part of the mixer state the session has received.
#pragma once
#include "Live/Documents/Mix.h"
#include "Live/Session/Session.h"
#include <array>
#include <vector>

namespace physvib {

/// Message thread only.
class ToldMix {
public:
    /// Initial state: the session was created with `panner` and default strips.
    explicit ToldMix(const PhantomPanner& panner)
        : panner_{panner} {}

    /// Posts all differences. If the session's queue is full, the rest is posted by the next call.
    void tell(Session& session, const Mix& mix);

    /// Sends changed lanes; the session itself then controls strips with a lane.
    void follow(Session& session, const Mix& mix);

private:
    PhantomPanner panner_;
    std::vector<bool> follows_; // by strip
    std::array<ToldStrip, limits::maxEnchanters> strips_{};
};

} // namespace physvib
