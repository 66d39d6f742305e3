// SPDX-License-Identifier: MIT
// Steps the world of a session up to session time, and queues what it makes for the renderer.
#pragma once
#include "Core/EventQueue.h"
#include "Live/Documents/SessionLog.h"
#include "Live/Session/CallbackInputs.h"
#include "Live/Session/SessionSetup.h"
#include "Live/Session/SessionWorld.h"
#include "Live/Session/SinkSet.h"
#include "Live/Session/Timeline.h"
#include "Live/Session/WaitingStrikes.h"
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

namespace physvib {

/// Part of a session. Its mutex is the world's.
class WorldRunner {
public:
    /// Plays another scene, as a new take, from the next step on; a state equal to state() changes nothing.
    /// Empty, or what is wrong with the scene, and nothing is done. Any thread but R.
    std::string setState(SessionState state);

    /// What is played, or will be from the next step on. Any thread but R.
    SessionState state() const;

    /// The scene starts anew when frame `offset` of the next block is the present, as a new take. R,
    /// wait-free, or M.
    void restart(std::int64_t offset = 0) noexcept {
        restartFrame_.store(time_.framesRendered() + offset, std::memory_order_release);
    }

    /// How fast the world goes from its next step on: each step takes `slowness` times its time; 0: it stands
    /// still. What has been struck rings on; a slower world is logged as stalls. Any thread, wait-free.
    void setSlowness(int slowness) noexcept {
        slowness_.store(std::max(0, slowness), std::memory_order_relaxed);
    }
    int slowness() const noexcept { return slowness_.load(std::memory_order_relaxed); }

    /// One step of a world that stands still. Any thread, wait-free.
    void stepOnce() noexcept { stepsWanted_.fetch_add(1, std::memory_order_relaxed); }

    /// Time that was given up after stalls. Any thread.
    std::int64_t slippedNs() const noexcept { return slippedNs_.load(std::memory_order_relaxed); }

    /// How far the scene has come that runs, and the number of its take, from 1. Any thread, wait-free.
    std::int64_t sceneNs() const noexcept { return sceneNs_.load(std::memory_order_relaxed); }
    std::size_t take() const noexcept { return take_.load(std::memory_order_relaxed); }

    /// Live inputs and bodies that the world holds now: for those who watch that neither grows without end.
    /// Any thread but R.
    SessionSize size() const;

    /// Where the bodies of sceneCast() are, as far as the world has been stepped: the session time of that, L
    /// before it is felt. Without a log nobody knows what inputs have spawned, and what is gone is left out.
    /// A step that takes long is not waited for: then they are where they were before it. Any thread but R.
    std::int64_t readPoses(std::vector<BodyPose>& poses) const;

    /// Collisions lost in the physics step. Any thread, wait-free.
    std::uint64_t drops() const noexcept { return drops_.load(std::memory_order_relaxed); }

private:
    friend class Session;
    friend class Scheduler;

    /// All outlive it. Throws std::invalid_argument if the scene is not valid.
    WorldRunner(const SessionSetup& setup, const Timeline& time, CallbackInputs& callback, SinkSet& sinks);

    // For the session.
    void prepare(); // the scene is at its start; the world mutex is held, as by the next
    void resume(const FrameClock& clock);      // session time goes on by that clock
    int advance(const StepWatch& goesOn);      // D
    bool beginBlock(RenderMode mode) noexcept; // R; false: nobody has stepped the world yet
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

    // For the scheduler, who holds the inputs' mutex.
    std::shared_ptr<const Scene> scene(std::size_t& take); // of the take that runs, with its number
    bool addInput(std::size_t take, Action& action);       // false: another one runs
    void strike(std::span<const CollisionEvent> events);
    bool schedule(std::span<const CollisionEvent> events); // false: too many
    void forgetScheduled(std::int64_t fromNs, std::int64_t nowNs);
    std::int64_t moveLog(SessionLog& log); // session time up to which the world has been stepped

    // The world mutex is held.
    int catchUp(const StepWatch& goesOn = {});
    void beginOffline(std::int64_t endNs);
    void moveWorld(std::int64_t untilNs);
    void takeUp();
    void tellScene() noexcept;
    void takeDue(std::int64_t untilNs);
    bool handOver();
    void showPoses() const; // to those who do not wait for a step

    const SessionSetup& setup_;
    const Timeline& time_;
    CallbackInputs& callback_;
    SinkSet& sinks_;
    EventQueue<CollisionEvent, 4096> queue_; // from whoever holds the world, who keeps what finds no room
    std::atomic<std::int64_t> steppedNs_{0}; // session time of the world up to which all is in the queue
    std::atomic<std::int64_t> sceneNs_{0};   // of the take that runs
    std::atomic<std::size_t> take_{0};
    std::atomic<std::int64_t> slippedNs_{0}, restartFrame_{-1}; // the latter: -1, not wanted
    std::atomic<int> slowness_{1}, stepsWanted_{0};
    std::atomic<bool> offline_{false}, isDriven_{false}; // the latter: somebody has begun to step the world
    std::atomic<std::uint64_t> drops_{0};

    mutable std::mutex mutex_; // guards what follows
    SessionWorld world_;
    std::vector<CollisionEvent> made_; // events that the queue had no room for yet, from handed_ on
    std::size_t handed_ = 0;
    WaitingStrikes waiting_;
    std::vector<CollisionEvent> begun_; // of those that waited, for the log

    mutable std::mutex stateMutex_; // taken after all others; guards what follows
    SessionState state_;
    bool isNew_ = false;

    mutable std::atomic<bool> isShown_{false}; // a reader has not got the world's mutex: after each step,
                                               // poses are copied
    mutable std::mutex shownMutex_;            // held for a copy; guards what follows
    mutable std::vector<BodyPose> shown_;
    mutable std::int64_t shownNs_ = 0;
};

} // namespace physvib
