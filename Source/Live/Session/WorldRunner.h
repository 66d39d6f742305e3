// SPDX-License-Identifier: MIT
// Steps a session's physics world up to session time, and queues its events for the renderer.
#pragma once
#include "Core/CollisionEvent.h"
#include "Core/EventQueue.h"
#include "Live/Documents/SessionLog.h"
#include "Live/Session/CallbackInputs.h"
#include "Live/Session/DevicePulse.h"
#include "Live/Session/SessionSetup.h"
#include "Live/Session/SessionWorld.h"
#include "Live/Session/Sink.h"
#include "Live/Session/Timeline.h"
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

namespace physvib {

// Events that were scheduled for a later time and can still be cancelled.

/// In session time. One thread at a time: Session guards it by its world mutex.
class WaitingStrikes {
public:
    static constexpr std::size_t most = 65'536; ///< an hour of one every 50 ms

    /// False, and nothing has changed, if there would be too many.
    bool add(std::span<const CollisionEvent> strikes) {
        if (waiting_.size() + strikes.size() > most) return false;
        for (const CollisionEvent& strike : strikes)
            waiting_.insert(std::ranges::upper_bound(waiting_, strike.timeNs, {}, &CollisionEvent::timeNs),
                            strike);
        return true;
    }

    /// Moves the events up to `untilNs` to the end of `due`.
    void take(std::int64_t untilNs, std::vector<CollisionEvent>& due) {
        if (waiting_.empty() || waiting_.front().timeNs > untilNs) return;
        const auto end = std::ranges::upper_bound(waiting_, untilNs, {}, &CollisionEvent::timeNs);
        due.insert(due.end(), waiting_.begin(), end);
        waiting_.erase(waiting_.begin(), end);
    }

    /// Cancels the events from `fromNs` on.
    void forget(std::int64_t fromNs) {
        waiting_.erase(std::ranges::lower_bound(waiting_, fromNs, {}, &CollisionEvent::timeNs),
                       waiting_.end());
    }

    std::size_t size() const noexcept { return waiting_.size(); }

private:
    std::deque<CollisionEvent> waiting_; // in time order; most come at the end, all go at the front
};

/// Part of a session. Its mutex is the world mutex.
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
    /// It is paused, and no single step is asked for. Any thread.
    bool isStill() const noexcept {
        return slowness() == 0 && stepsWanted_.load(std::memory_order_relaxed) == 0;
    }

    /// One step of a paused world. Any thread, wait-free.
    void stepOnce() noexcept { stepsWanted_.fetch_add(1, std::memory_order_relaxed); }

    /// Time lost in stalls. Any thread.
    std::int64_t slippedNs() const noexcept { return slippedNs_.load(std::memory_order_relaxed); }

    /// Time of the current scene run, and its number, from 1. Any thread, wait-free.
    std::int64_t sceneNs() const noexcept { return sceneNs_.load(std::memory_order_relaxed); }
    std::size_t take() const noexcept { return take_.load(std::memory_order_relaxed); }

    /// Numbers of live inputs and bodies, to watch that neither grows without bound. Any thread but R.
    SessionSize size() const;

    /// Poses of the bodies of sceneCast() in the last step; returns their session time, which is felt the
    /// output latency later. Without a log, bodies that inputs spawned are not identified, and removed ones
    /// are left out. Does not wait for a long step; then the poses are those before it. Any thread but R.
    std::int64_t readPoses(std::vector<BodyPose>& poses) const;

    /// When the next step is due, by the blocks so far: steadyNs(). D.
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
    bool popOrStep(CollisionEvent& event, std::int64_t endNs);             // R, in runOffline
    template <class Render>
    void runOffline(std::int64_t endNs, Render render) { // R in a non-realtime block: steps the world to
                                                         // `endNs`, in `render` and after it
        const std::lock_guard lock{mutex_};
        beginOffline(endNs);
        render();
        while (world_.timeNs() < endNs) moveWorld(endNs);
        handOver();
    }

    // For Scheduler, with the input mutex held:
    std::shared_ptr<const Scene> scene(std::size_t& take); // the current scene run's, with its number
    bool addInputs(std::size_t take, std::span<const Action> actions); // false: another run is current
    void strike(std::span<const CollisionEvent> events);
    bool schedule(std::span<const CollisionEvent> events); // false: too many
    void forgetScheduled(std::int64_t fromNs, std::int64_t nowNs);
    std::int64_t moveLog(SessionLog& log); // returns the session time up to which the world has been stepped

    // With the world mutex held:
    int catchUp(std::int64_t nowNs, const StepWatch& keepGoing = {});
    void beginOffline(std::int64_t endNs);
    void moveWorld(std::int64_t untilNs);
    void startRequestedRun();
    void publishScene() noexcept;
    void dropWaiting();
    void takeDue(std::int64_t untilNs);
    bool handOver();
    void showPoses() const; // to readers that do not wait for a step

    const SessionSetup& setup_;
    const Timeline& time_;
    DevicePulse& pulse_;
    CallbackInputs& callback_;
    SinkSet& sinks_;
    GrowingQueue<CollisionEvent, 48, 90> queue_; // from the thread that holds the world mutex; made_ keeps
                                                 // what does not fit
    std::atomic<std::int64_t> steppedNs_{0}; // session time of the world up to which all events are queued
    std::atomic<std::int64_t> sceneNs_{0};   // of the current scene run
    std::atomic<std::size_t> take_{0};
    std::atomic<std::int64_t> slippedNs_{0}, restartFrame_{-1}; // restartFrame_: -1, not requested
    std::atomic<int> slowness_{1}, stepsWanted_{0};
    std::atomic<bool> offline_{false}, isDriven_{false}; // isDriven_: the world has been stepped
    std::atomic<std::uint64_t> drops_{0};

    mutable std::mutex mutex_; // guards the following members
    SessionWorld world_;
    std::vector<CollisionEvent> made_; // events that did not fit the queue yet, from handed_ on
    std::size_t handed_ = 0;
    WaitingStrikes waiting_;
    DevicePulse::Return returns_;       // after which nothing that waited is left
    std::vector<CollisionEvent> begun_; // scheduled events that have begun, for the log

    mutable std::mutex stateMutex_; // locked after all others; guards the following members
    SessionState state_;
    bool isNew_ = false;

    mutable std::atomic<bool> isShown_{false}; // a reader did not get the mutex: each step copies the poses
    mutable std::mutex shownMutex_;            // held while copying; guards the following members
    mutable std::vector<BodyPose> shown_;
    mutable std::int64_t shownNs_ = 0;
};

} // namespace physvib
