// SPDX-License-Identifier: MIT
// The physics world of a session, its scheduled events, and WorldRunner, which steps it up to session time.
#pragma once
#include "Core/CollisionEvent.h"
#include "Core/EventQueue.h"
#include "Core/EventShaping.h"
#include "Live/Documents/SessionLog.h"
#include "Live/Session/OutputClock.h"
#include "Live/Session/SessionSetup.h"
#include "Live/Session/Sink.h"
#include "Live/Session/Timeline.h"
#include "Scene/SceneEdits.h"
#include "Scene/World/Simulation.h"
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

namespace physvib {
class CallbackInputs;

// The physics world of a session in session time: consecutive scene runs with stalls and live inputs, and
// their log.

/// Keeps log entries until they are read, and none if not logged. One thread at a time, by Session's mutex.
class SessionWorld {
public:
    /// `run` sets step rate, timing and location; each scene run has its own seed.
    explicit SessionWorld(const RunSettings& run, const EventShaping& shaping = {}, bool isLogged = true)
        : run_{run}
        , shaper_{shaping}
        , isLogged_{isLogged} {}

    /// Starts a new scene run at `sessionNs`. Throws what Simulation throws; then nothing has changed.
    void start(std::int64_t sessionNs, std::shared_ptr<const Scene> scene, std::uint32_t seed);

    /// Restarts the current scene as the first run, at that session time, with an empty log.
    void reset(std::int64_t sessionNs = 0);

    /// Session time up to which the world has been stepped.
    std::int64_t timeNs() const noexcept { return originNs_ + world_->timeNs(); }

    /// World time of the current run.
    std::int64_t sceneNs() const noexcept { return world_->timeNs(); }

    /// One step; appends its events, shaped and in session time.
    void step(std::vector<CollisionEvent>& events);

    /// Delays the world by `lengthNs` of session time.
    void addStall(std::int64_t lengthNs);

    /// Adds a valid input that acts at `sessionNs`, or in the next step if that is past.
    void addInput(std::int64_t sessionNs, Action action);

    /// Sets the script's position at that time, and its rate (ScriptPace). Not logged.
    void setPace(std::int64_t sessionNs, double scriptSeconds, double rate);

    /// The current run, with the inputs and stalls that have not been read.
    const SceneRun& currentRun() const noexcept { return currentRun_; }
    std::size_t runCount() const noexcept { return runCount_; }
    /// Bodies in Box2D's world; inputs that are pending or have not been read.
    SessionSize size() const noexcept;
    void readPoses(std::vector<BodyPose>& poses) const; ///< see WorldRunner
    std::uint64_t drops() const noexcept { return dropsBefore_ + world_->drops(); }

    /// Moves new log entries to `log`, which is empty at the first call. Costs as many as are new.
    void moveLog(std::vector<SceneRun>& log);

private:
    RunSettings run_;
    EventShaper shaper_;
    bool isLogged_;
    std::vector<SceneRun> endedRuns_; // runs that are not completely read
    SceneRun currentRun_;             // its last stall stays after reading, because it may grow
    bool isStartRead_ = false;        // the reader has got the start of the oldest run
    std::size_t runCount_ = 0;
    std::unique_ptr<Simulation> world_;
    std::int64_t originNs_ = 0;                 // session time - world time
    std::int64_t steps_ = 0, stalledStep_ = -1; // steps of the run; step after which it was last stalled
    std::uint64_t dropsBefore_ = 0;
};

// Events that were scheduled for a later time and can still be cancelled.

/// All times are session time. One thread at a time: Session guards it by its world mutex.
class ScheduledEvents {
public:
    static constexpr std::size_t maxEvents = 65'536; ///< an hour of one every 50 ms

    /// False, and nothing has changed, if there would be too many.
    bool add(std::span<const CollisionEvent> strikes) {
        if (waiting_.size() + strikes.size() > maxEvents) return false;
        for (const CollisionEvent& strike : strikes)
            waiting_.insert(std::ranges::upper_bound(waiting_, strike.timeNs, {}, &CollisionEvent::timeNs),
                            strike);
        return true;
    }

    /// Moves the events up to `untilNs` to the end of `due`.
    void moveDue(std::int64_t untilNs, std::vector<CollisionEvent>& due) {
        if (waiting_.empty() || waiting_.front().timeNs > untilNs) return;
        const auto end = std::ranges::upper_bound(waiting_, untilNs, {}, &CollisionEvent::timeNs);
        due.insert(due.end(), waiting_.begin(), end);
        waiting_.erase(waiting_.begin(), end);
    }

    /// Cancels the events from `fromNs` on.
    void cancelFrom(std::int64_t fromNs) {
        waiting_.erase(std::ranges::lower_bound(waiting_, fromNs, {}, &CollisionEvent::timeNs),
                       waiting_.end());
    }

    std::size_t size() const noexcept { return waiting_.size(); }

private:
    std::deque<CollisionEvent> waiting_; // in time order; most are added at the end, all leave at the front
};

/// The part of a session that steps the world and queues its events. Its mutex is the world mutex.
class WorldRunner {
public:
    /// Plays another scene as a new scene run from the next step on; a state equal to state() changes
    /// nothing. Empty, or the scene's error, and nothing is done. Any thread but the render thread (R).
    std::string setState(SessionState state);

    /// The state that is played, or will be from the next step on. Any thread but R.
    SessionState state() const;

    /// Restarts the scene, as a new scene run, when frame `offset` of the next block is the present. R,
    /// wait-free, or the message thread (M).
    void restart(std::int64_t offset = 0) noexcept {
        restartFrame_.store(time_.framesRendered() + offset, std::memory_order_release);
    }

    /// Speed of the world from its next step on: each step takes `slowness` times its time; 0: paused.
    /// Sounding modes continue; slow motion is logged as stalls. Any thread, wait-free.
    void setSlowness(int slowness) noexcept {
        slowness_.store(std::max(0, slowness), std::memory_order_relaxed);
    }
    int slowness() const noexcept { return slowness_.load(std::memory_order_relaxed); }
    /// Whether the world is paused and no single step is requested, or has failed. Any thread.
    bool isPaused() const noexcept {
        return hasFailed() || (slowness() == 0 && requestedSteps_.load(std::memory_order_relaxed) == 0);
    }

    /// True if a step failed: the world stands still until it starts anew. Any thread, wait-free.
    bool hasFailed() const noexcept { return hasFailed_.load(std::memory_order_relaxed); }
    /// Calls `step`; if it throws (at worst for lack of memory), this world alone fails. The threads that
    /// step it.
    template <class Step>
    void tryTo(Step step) noexcept {
        try {
            step();
        } catch (const std::exception&) {
            hasFailed_.store(true, std::memory_order_relaxed);
        }
    }

    /// Requests one step of a paused world. Any thread, wait-free.
    void stepOnce() noexcept { requestedSteps_.fetch_add(1, std::memory_order_relaxed); }

    /// Time lost in stalls. Any thread.
    std::int64_t stalledNs() const noexcept { return stalledNs_.load(std::memory_order_relaxed); }

    /// Time of the current scene run, and its number, from 1. Any thread, wait-free.
    std::int64_t sceneNs() const noexcept { return sceneNs_.load(std::memory_order_relaxed); }
    std::size_t runNumber() const noexcept { return runNumber_.load(std::memory_order_relaxed); }

    /// Numbers of live inputs and bodies, to watch that neither grows without bound. Any thread but R.
    SessionSize size() const;

    /// Poses of the bodies of allBodies() in the last step; returns their session time, which is felt the
    /// output latency later. Without a log, bodies that inputs spawned are not identified, and removed ones
    /// are left out. Does not wait for a long step; then the poses are those before it. Any thread but R.
    std::int64_t readPoses(std::vector<BodyPose>& poses) const;

    /// Time on the steady clock at which the next step is due, estimated from the device's blocks. D.
    std::int64_t nextStepNs() const;

    /// Collisions lost in physics steps because buffers were full. Any thread, wait-free.
    std::uint64_t drops() const noexcept { return drops_.load(std::memory_order_relaxed); }

private:
    friend class Session;
    friend class Scheduler;

    /// All must outlive it. Throws std::invalid_argument if the scene is not valid.
    WorldRunner(const std::shared_ptr<const SessionSetup>& setup, const Timeline& time, DevicePulse& pulse,
                CallbackInputs& callback, SinkSet& sinks);

    // For Session:
    void prepare();                            // resets the scene; the world mutex is held, also for resume
    void resume(const FrameClock& clock);      // session time continues by that clock
    int advance(const StepWatch& keepGoing);   // world driver (D)
    bool beginBlock(RenderMode mode) noexcept; // R; false: the world has not been stepped yet
    bool pop(CollisionEvent& event) noexcept { return queue_.pop(event); } // R
    bool popOrStep(CollisionEvent& event, std::int64_t endNs) noexcept;    // R, in runOffline
    template <class Render>
    void runOffline(std::int64_t endNs, Render render) { // R in a non-realtime block: steps the world to
                                                         // `endNs`, in `render` and after it
        const std::lock_guard lock{mutex_};
        tryTo([&] { beginOffline(endNs); });
        render();
        tryTo([&] {
            while (world_.timeNs() < endNs) stepWorld(endNs);
            queueEvents();
        });
    }

    // For Scheduler, with the input mutex held:
    std::shared_ptr<const Scene> scene(std::size_t& number); // the current scene run's, with its number
    bool addInputs(std::size_t number, std::span<const Action> actions); // false: another run is current
    void strike(std::span<const CollisionEvent> events);
    bool schedule(std::span<const CollisionEvent> events); // false: too many
    void cancelScheduled(std::int64_t fromNs, std::int64_t nowNs);
    std::int64_t moveLog(SessionLog& log); // returns the session time up to which the world has been stepped

    // With the world mutex held:
    int catchUp(std::int64_t nowNs, const StepWatch& keepGoing = {});
    void beginOffline(std::int64_t endNs);
    void stepWorld(std::int64_t untilNs);
    void startRequestedRun();
    void publishSceneTime() noexcept;
    void dropScheduled();
    void moveDueEvents(std::int64_t untilNs);
    bool queueEvents();
    void publishPoses() const; // to readers that do not wait for a step

    const SessionSetup& setup_;
    const Timeline& time_;
    DevicePulse& pulse_;
    CallbackInputs& callback_;
    SinkSet& sinks_;
    GrowingQueue<CollisionEvent, 48, 90> queue_; // from the thread that holds the world mutex; unqueued_
                                                 // keeps what does not fit
    std::atomic<std::int64_t> steppedNs_{0}; // session time of the world up to which all events are queued
    std::atomic<std::int64_t> sceneNs_{0};   // of the current scene run
    std::atomic<std::size_t> runNumber_{0};
    std::atomic<std::int64_t> stalledNs_{0}, restartFrame_{-1}; // restartFrame_: -1, not requested
    std::atomic<int> slowness_{1}, requestedSteps_{0};
    std::atomic<bool> isOffline_{false}, hasStepped_{false}; // hasStepped_: D or R has stepped it
    std::atomic<bool> hasFailed_{false};
    std::atomic<std::uint64_t> drops_{0};

    mutable std::mutex mutex_; // guards the following members
    SessionWorld world_;
    std::vector<CollisionEvent> unqueued_; // events that did not fit the queue yet, from firstUnqueued_ on
    std::size_t firstUnqueued_ = 0;
    ScheduledEvents scheduled_;
    DevicePulse::PauseHistory seenPauses_;      // the pauses whose events were dropped
    std::vector<CollisionEvent> startedEvents_; // scheduled events that have begun, for the log

    mutable std::mutex stateMutex_; // locked after all others; guards the following members
    SessionState state_;
    bool isStateNew_ = false;

    mutable std::atomic<bool> publishesPoses_{false}; // a reader did not get mutex_: each step copies poses
    mutable std::mutex publishedMutex_;               // held while copying; guards the following members
    mutable std::vector<BodyPose> publishedPoses_;
    mutable std::int64_t publishedNs_ = 0;
};

} // namespace physvib
