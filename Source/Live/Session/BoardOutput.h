// SPDX-License-Identifier: MIT
// Sink that plays a session on a vibration board together with the audio device: each collision is felt on
// both at the same time.
//
// SessionClock converts session time to the time at which the device plays it; the link converts that to a
// frame of the board. Both use the same events and panner; the device's master level and mute apply to the
// board too. Controls act when they are felt on the device, except that a stop discards events in transit to
// the board.
#pragma once
#include "Core/ControlQueue.h"
#include "Core/PhantomPanner.h"
#include "Live/Documents/SessionLog.h"
#include "Live/Session/BoardLink.h"
#include "Live/Session/OutputClock.h"
#include "Live/Session/Sink.h"
#include "Wire/BoardPath.h"
#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace physvib {
/// A vibration board as a sink. Its feed() runs on the link thread while it follows a device.
class BoardOutput final : public Sink {
public:
    /// Latency for a board that is not awaited: a link needs 20 to 40 ms. One that needs more is an error.
    static constexpr double defaultLatencySeconds = 0.05;

    /// `port` may be anyBoard; `panner` is the session's, of at most four actuators. Events must be known at
    /// least `latencySeconds` ahead, or what an awaited link needs, or defaultLatencySeconds once a board has
    /// answered: a missing board delays nothing. Message thread (M).
    BoardOutput(std::string port, const PhantomPanner& panner, double latencySeconds = 0.0);
    ~BoardOutput() override { follow(nullptr); }

    std::string awaitReady(const std::function<bool()>& keepGoing) override;
    double latencySeconds() const noexcept override {
        return isAwaited_ || !link_.hasConnected() ? latencySeconds_
                                                   : std::max(latencySeconds_, defaultLatencySeconds);
    }
    void follow(OutputClock* device) override;
    void onCollision(const CollisionEvent& event) noexcept override;
    void onControl(const RenderControl& control) noexcept override { controls_.push(control); }
    SinkState state() const override;
    std::string summary(const std::function<bool()>& keepGoing) const override;

    /// Events and controls dropped because a queue to the link was full. Any thread.
    std::uint64_t droppedInQueues() const noexcept { return events_.overflows() + controls_.overflows(); }
    /// Any thread.
    BoardLinkStatus status() const { return link_.status(); }

private:
    void feed();
    void processControls();
    void apply(const RenderControl& control);
    void setGains();
    void pushStrike(const CollisionEvent& event);
    void startPath(const CollisionEvent& event);
    void applyDueLayouts(std::int64_t timeNs);
    PathGains::Gains gainsAt(const CollisionEvent& event) const noexcept;
    void sendSteps();
    void sendSegments();
    void sendSegment(BoardPath& path);

    // two per moving tone: the sounding segment and the next
    static constexpr std::ptrdiff_t maxPaths = limits::board::maxSegments / 2;

    const std::string port_; // as requested
    BoardLink link_;
    double latencySeconds_;
    bool isAwaited_ = false;           // true: latencySeconds_ is what the board needs
    wire::Telemetry telemetryAtStart_; // telemetry when it became ready: a board's counters are never reset
    EventQueue<CollisionEvent, 1024> events_; // in session time, as the renderer's; the link thread reads
    ControlQueue<256> controls_;
    OutputClock* device_ = nullptr; // set by M, while the link thread is not in feed()

    // Link thread:
    int rateHz_ = 0; // of the session
    SessionClock clock_;
    PhantomPanner panner_;
    std::vector<PannerChange> pendingPanners_; // panners and other controls for later times
    std::vector<RenderControl> pendingControls_;
    std::vector<BoardPath> paths_;  // tones sent as segments, until they end: the next may continue them
    std::vector<BoardSteps> steps_; // tones sent as series of events, for lack of segments
    std::array<double, limits::board::channels> gains_{1.0, 1.0, 1.0, 1.0};
    std::optional<std::array<double, limits::board::channels>> sentGains_; // the last ones that the link got
    std::array<bool, limits::board::channels> isMuted_{};
};

/// State of a board that is wanted at `port` and gets events `latencySeconds` before they are felt, for
/// display. Any thread.
SinkState makeSinkState(const BoardLinkStatus& board, const std::string& port, double latencySeconds);

} // namespace physvib
