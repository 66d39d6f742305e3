// SPDX-License-Identifier: MIT
// A session on a game controller beside its device: hits are felt at the same moment, as far as motors can.
//
// The device's blocks say when a moment of the session is felt (FeltClock). Each command of the motors has a
// session time, so the commands are those of an offline render, to the last one, while events come in time. A
// command lasts 200 ms at most and is sent again before; so motors stop soon, whatever becomes of the
// program.
#pragma once
#include "Core/EventQueue.h"
#include "Core/Pads/PadMotors.h"
#include "Live/Pads/GamePads.h"
#include "Live/Session/FeltClock.h"
#include "Live/Session/FeltOutput.h"
#include "Live/Session/Sink.h"
#include "Scene/PadFile.h"
#include <atomic>
#include <mutex>
#include <thread>

namespace physvib {

/// What a controller has been sent so far, for people and tests.
struct PadCounts {
    std::uint64_t events = 0, commands = 0, repeats = 0; ///< repeats: commands again, before they time out
    std::uint64_t late = 0;    ///< commands that the next one overtook before they were sent
    std::uint64_t refused = 0; ///< by the controller
    std::uint64_t connections = 0;
};

/// Its own thread asks the controller; nobody waits for it but M.
class PadOutput final : public Sink {
public:
    /// `where`: a name or anyPad, then, if it is not the one that suits the controller, "@" and a profile's
    /// name or file. M.
    PadOutput(const std::string& where, const PhantomPanner& panner);
    ~PadOutput() override;

    std::string awaitReady(const std::function<bool()>& goesOn) override;
    double latencySeconds() const noexcept override { return leadSeconds_; }
    void follow(FeltOutput* device) override;
    void made(const CollisionEvent& event) noexcept override { events_.push(event); }
    void posted(const RenderControl& control) noexcept override { controls_.push(control); }
    SinkState state() const override;
    std::string summary(const std::function<bool()>& goesOn) const override;

    PadCounts counts() const; ///< any thread

private:
    void run();
    void connect(GamePads& pads);
    void adopt(std::unique_ptr<GamePad> pad);
    void feed(std::int64_t nowNs);
    void takeControls(std::int64_t sessionNs);
    void takeEvents();
    void command(std::int64_t sessionNs, std::int64_t nowNs);
    void send(const PadCommand& command, std::int64_t nowNs);
    void rest();
    void begin();
    std::string troubleNow() const;

    std::string name_;
    bool isProfileGiven_ = false;
    EventQueue<CollisionEvent, 1024> events_; // in session time
    EventQueue<RenderControl, 256> controls_;
    std::atomic<double> leadSeconds_{0.0};

    mutable std::mutex mutex_; // all below; its thread and M
    PadProfile profile_;
    std::string fault_; // nothing can be played, now or later
    FeltOutput* device_ = nullptr;
    std::unique_ptr<GamePad> pad_;
    std::string lastName_; // of the controller that was there
    PadMotors motors_{PadLaw{}};
    FeltClock clock_;
    const PhantomPanner first_; // of the session
    PhantomPanner grips_;
    std::vector<RenderControl> layouts_, stops_; // that wait for their time
    PadCommand sent_;
    std::int64_t sentNs_ = 0, looksNs_ = 0, playedNs_ = 0; // steady; steady; session
    PadCounts counts_;

    std::atomic<bool> stop_{false};
    std::thread thread_; // last: the others outlive it
};

} // namespace physvib
