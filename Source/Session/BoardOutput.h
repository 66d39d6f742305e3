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
#include "Wire/BoardPath.h"
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
    void move(const CollisionEvent& event);
    void takeLayouts(std::int64_t timeNs);
    PathGains::Gains gainsAt(const CollisionEvent& event, double x, double y) const noexcept;
    void takeSteps();
    void takeLegs();
    void sendLeg(BoardPath& path);

    static constexpr std::ptrdiff_t mostPaths = limits::board::maxLegs / 2; // of each, the leg that sounds and the next

    Session& session_;
    ToldEvents& told_;
    FeltOutput& device_;
    BoardLink& link_;

    // L
    FeltClock clock_;
    PhantomPanner panner_;
    std::vector<RenderControl> layouts_, others_; // that wait for their time
    std::vector<BoardPath> paths_;    // what moves, until its end is felt: another may go on where it is over
    std::vector<BoardSteps> steps_;   // what moves, beyond those, or on a board that has no legs
    std::array<double, limits::board::channels> gains_{1.0, 1.0, 1.0, 1.0};
    std::optional<std::array<double, limits::board::channels>> sent_; // to the link
    std::array<bool, limits::board::channels> muted_{};
};

} // namespace physvib
