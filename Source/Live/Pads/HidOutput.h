// SPDX-License-Identifier: MIT
// Sink that finds a controller among the system's raw devices, and sends it the reports of a feed while a
// device plays.
#pragma once
#include "Live/Pads/HidFeed.h"
#include "Live/Session/OutputClock.h"
#include <atomic>
#include <thread>

namespace physvib {

/// Counts of what was sent, for display and tests.
struct HidCounts {
    std::uint64_t reports = 0, connections = 0;
};

/// Its own thread owns the controller and writes to it without a lock, as the system may hold a write for
/// seconds. M waits for that thread in the destructor, and for its silence, a moment at most, in follow().
class HidOutput final : public Sink {
public:
    /// `where`: anyPad, or part of a controller's name or node. M.
    HidOutput(const std::string& where, std::unique_ptr<HidFeed> feed);
    ~HidOutput() override;

    std::string awaitReady(const std::function<bool()>& keepGoing) override;
    double latencySeconds() const noexcept override { return leadSeconds_; } ///< 0 until one is there
    void follow(OutputClock* device) override;
    void made(const CollisionEvent& event) noexcept override { feed_->made(event); }
    void posted(const RenderControl& control) noexcept override { feed_->posted(control); }
    void rendered(const RenderedBlock& block) noexcept PHYSVIB_NONBLOCKING override {
        feed_->rendered(block);
    }
    SinkState state() const override;
    std::string summary(const std::function<bool()>& keepGoing) const override;

    HidCounts counts() const; ///< any thread

private:
    void run();
    void connect();
    std::optional<PadReport> due(std::int64_t nowNs);
    void write(const PadReport& report);
    bool send(const PadReport& report);
    void sendAll(std::span<const PadReport> reports);
    void rest();
    std::string label() const { return std::string{feed_->kind().name}; }
    std::string troubleNow() const;

    const std::string where_;
    const std::unique_ptr<HidFeed> feed_;

    std::unique_ptr<HidDevice> pad_; // the thread's alone, as the next two lines
    std::int64_t looksNs_ = 0;       // steady clock
    bool hasSent_ = false;           // since it was switched on

    FollowedDevice device_; // its mutex guards the members below, used by the thread and M
    std::string node_;      // of the controller; empty: there is none
    std::string lastName_, refusal_{"none is there"};
    HidCounts counts_;

    std::atomic<double> leadSeconds_{0.0};
    std::atomic<bool> stop_{false};
    std::thread thread_; // last: it uses the other members
};

} // namespace physvib
