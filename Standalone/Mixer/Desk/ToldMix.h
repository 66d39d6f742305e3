// SPDX-License-Identifier: GPL-3.0-or-later
// What of a mix its session plays by already.
#pragma once
#include "Live/Documents/Mix.h"
#include "Live/Session/Session.h"
#include <array>
#include <vector>

namespace physvib {

/// M only.
class ToldMix {
public:
    /// The session has been made with `panner`, and its strips as they are at first.
    explicit ToldMix(const PhantomPanner& panner)
        : panner_{panner} {}

    /// Posts as little as the session does not know yet. What finds no room is left for the next call.
    void tell(Session& session, const Mix& mix);

    /// The mix is another: what has a lane in it is told by the session itself.
    void follow(Session& session, const Mix& mix);

private:
    PhantomPanner panner_;
    std::vector<bool> follows_; // per strip
    std::array<ToldStrip, limits::maxEnchanters> strips_{};
};

} // namespace physvib
