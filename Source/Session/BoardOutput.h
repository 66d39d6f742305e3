// SPDX-License-Identifier: MIT
// A session on a board beside its device: each collision is felt on both at the same moment.
//
// The device's blocks say when a moment of the session is felt (FeltClock); the link knows which frame of the board that
// is. Both play the same events from the same panner; the device's master level and silence are the board's as well.
// Controls act when they are felt on the device, but for strikes on their way to the board: a stop forgets those.
#pragma once
#include "Session/BoardLink.h"
#include "Session/FeltClock.h"
#include "Session/FeltOutput.h"
#include "Session/Session.h"
#include "Wire/BoardSteps.h"
#include <array>
#include <optional>
#include <vector>

namespace physvib {

/// Works on L while it lives.
class BoardOutput final : private BoardSource {
public:
    /// All outlive it; the setup of `session` has its boardSeconds, its channels and this panner (of at most four). M.
    BoardOutput(Session& session, FeltOutput& device, BoardLink& link, const PhantomPanner& panner);

    /// What plays on the board stops. M.
    ~BoardOutput() override;

    /// Collisions that the queue to the link had no room for. Any thread.
    std::uint64_t untold() const noexcept { return told_.events.overflows() + told_.controls.overflows(); }

private:
    void feed() override;
    void takeControls();
    void apply(const RenderControl& control);
    void setGains();
    void strike(const CollisionEvent& event);
    void takeSteps();

    ToldEvents& told_;
    FeltOutput& device_;
    BoardLink& link_;

    // L
    FeltClock clock_;
    PhantomPanner panner_;
    std::vector<RenderControl> layouts_, others_; // that wait for their time
    std::vector<BoardSteps> moving_;
    std::array<double, limits::board::channels> gains_{1.0, 1.0, 1.0, 1.0};
    std::optional<std::array<double, limits::board::channels>> sent_; // to the link
    std::array<bool, limits::board::channels> muted_{};
};

} // namespace physvib
