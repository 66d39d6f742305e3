// SPDX-License-Identifier: MIT
// Plays a session on a game controller beside the audio device; hits are felt at the same time, as far as
// motors can follow.
//
// SessionClock estimates from the device's blocks when a session time is felt. Each motor command has a
// session time, so the commands equal those of an offline render as long as events arrive in time. A command
// lasts at most 200 ms and is repeated before it ends, so motors stop soon if the program dies.
#pragma once
#include "Core/ControlQueue.h"
#include "Core/Pads/PadMotors.h"
#include "Live/Documents/SessionLog.h"
#include "Live/Pads/GamePads.h"
#include "Live/Session/OutputClock.h"
#include "Live/Session/Sink.h"
#include "Scene/PadFile.h"
#include <atomic>
#include <optional>
#include <thread>

namespace physvib {

/// Counts of what was sent to a controller, for display and tests.
struct PadCounts {
    std::uint64_t events = 0, commands = 0, repeats = 0; ///< repeats: commands sent again before the time-out
    std::uint64_t late = 0;    ///< commands not sent, because a stronger one was due as well
    std::uint64_t refused = 0; ///< commands that the controller refused
    std::uint64_t connections = 0;
};

/// A thread of its own calls SDL without a lock, because a call may take seconds. The message thread (M)
/// waits for it in the destructor, and at most 250 ms for its output to stop in follow().
class PadOutput final : public Sink {
public:
    /// `name`: a controller name or anyPad; optionally followed by "@" and the name or file of a profile,
    /// instead of the one that suits the controller. M.
    PadOutput(const std::string& name, const PhantomPanner& panner);
    ~PadOutput() override;

    std::string awaitReady(const std::function<bool()>& keepGoing) override;
    double latencySeconds() const noexcept override { return leadSeconds_; } ///< 0 until it connects
    void follow(OutputClock* device) override;
    void onCollision(const CollisionEvent& event) noexcept override { events_.push(event); }
    void onControl(const RenderControl& control) noexcept override { controls_.push(control); }
    SinkState state() const override;
    std::string summary(const std::function<bool()>& keepGoing) const override;

    PadCounts counts() const; ///< any thread

private:
    void run();
    void connect(GamePads& pads);
    std::optional<PadCommand> dueCommand(std::int64_t nowNs);
    void processControls(std::int64_t sessionNs);
    void processEvents();
    std::optional<PadCommand> nextCommand(std::int64_t sessionNs, std::int64_t nowNs);
    void send(const PadCommand& command);
    void begin();
    std::string currentError() const;

    std::string nameFilter_;
    bool hasRequestedProfile_ = false;
    EventQueue<CollisionEvent, 4096> events_; // in session time
    ControlQueue<256> controls_;
    std::atomic<double> leadSeconds_{0.0};

    std::unique_ptr<GamePad> pad_; // used by the thread alone, as the next two lines
    PadCommand sentCommand_, latestCommand_;
    std::int64_t sentNs_ = 0, nextSearchNs_ = 0; // steady clock
    std::int64_t strongestUntilNs_ = 0;          // time until which the strongest command stays

    FollowedDevice device_; // its mutex guards the members below, used by the thread and M
    PadProfile profile_;
    std::string error_; // a permanent error: nothing can be played
    std::optional<GamePadInfo> connectedPad_;
    std::string lastName_; // of the last controller
    PadMotors motors_{PadModel{}};
    PhantomPanner gripPanner_;
    std::vector<PannerChange> pendingPanners_; // panners and stops that wait for their time
    std::vector<std::int64_t> stopsNs_;
    PadCounts counts_;

    std::atomic<bool> isStopping_{false};
    std::thread thread_; // last: it uses the other members
};

} // namespace physvib
