// SPDX-License-Identifier: MIT
// A session on a board beside its device: each collision is felt on both at the same moment.
//
// The device's blocks say when a moment of the session is felt (FeltClock); the link knows which frame of the
// board that is. Both play the same events from the same panner; the device's master level and silence are
// the board's as well. Controls act when they are felt on the device, but for strikes on their way to the
// board: a stop forgets those.
#pragma once
#include "Core/EventQueue.h"
#include "Core/PhantomPanner.h"
#include "Live/Session/BoardLink.h"
#include "Live/Session/FeltClock.h"
#include "Live/Session/FeltOutput.h"
#include "Live/Session/Sink.h"
#include "Wire/BoardPath.h"
#include "Wire/BoardSteps.h"
#include <array>
#include <optional>
#include <vector>

namespace physvib {

/// Works on L while it follows a device.
class BoardOutput final : public Sink, private BoardSource {
public:
    /// For a board that is not waited for: the link needs 20 to 40 ms. More than that is told as trouble.
    static constexpr double usualLatencySeconds = 0.05;

    /// The board at `port`, or anyBoard; `panner`: the session's, of at most four. It has to know what it
    /// plays `latencySeconds` before, or as long as the link says when it is ready. M.
    BoardOutput(std::string port, const PhantomPanner& panner, double latencySeconds = 0.0);
    ~BoardOutput() override { follow(nullptr); }

    std::string awaitReady(const std::function<bool()>& goesOn) override;
    double latencySeconds() const noexcept override { return latencySeconds_; }
    void follow(FeltOutput* device) override;
    void made(const CollisionEvent& event) noexcept override;
    void posted(const RenderControl& control) noexcept override { controls_.push(control); }
    SinkState state() const override;
    std::string summary(const std::function<bool()>& goesOn) const override;

    /// Collisions that the queue to the link had no room for. Any thread.
    std::uint64_t untold() const noexcept { return events_.overflows() + controls_.overflows(); }
    /// Any thread.
    BoardLinkStatus status() const { return link_.status(); }

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

    // of each, the leg that sounds and the next
    static constexpr std::ptrdiff_t mostPaths = limits::board::maxLegs / 2;

    const std::string port_; // as it is wanted
    BoardLink link_;
    double latencySeconds_;
    bool isAwaited_ = false;                  // so that is what the board needs
    wire::Telemetry before_;                  // when it became ready: a board counts on from call to call
    EventQueue<CollisionEvent, 1024> events_; // in session time, as the renderer gets them; L reads
    EventQueue<RenderControl, 256> controls_;
    FeltOutput* device_ = nullptr; // M, while L is not in feed()

    // L
    int rateHz_ = 0; // of the session
    FeltClock clock_;
    PhantomPanner panner_;
    std::vector<RenderControl> layouts_, others_; // that wait for their time
    std::vector<BoardPath> paths_;  // what moves, until its end is felt: another may go on where it is over
    std::vector<BoardSteps> steps_; // what moves, beyond those, or on a board that has no legs
    std::array<double, limits::board::channels> gains_{1.0, 1.0, 1.0, 1.0};
    std::optional<std::array<double, limits::board::channels>> sent_; // to the link
    std::array<bool, limits::board::channels> muted_{};
};

} // namespace physvib
