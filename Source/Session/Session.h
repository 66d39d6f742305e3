// SPDX-License-Identifier: MIT
// A world that is felt while it moves: simulation, renderer and the time between them.
// Who may call what when, and why: Docs/threads.md, the threading model.
#pragma once
#include "Core/ClockLaw.h"
#include "Core/HapticRenderer.h"
#include "Core/LatestValue.h"
#include "Session/HeardContacts.h"
#include "Files/SessionLog.h"
#include "Session/SessionSetup.h"
#include "Session/SessionWorld.h"
#include "Session/ToldEvents.h"
#include "Physics/InputCheck.h"
#include "Physics/SceneRun.h"
#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace physvib {

class Session {
public:
    /// M. Throws std::invalid_argument if the scene is not valid.
    explicit Session(const SessionSetup& setup);

    /// Sets L; silence at session time 0, the scene at its start, the log empty. M, while nobody renders or drives.
    void prepare(int sampleRateHz, int maxBlockFrames);

    /// Goes on at another rate and block size: session time and world stay, L is set anew, what rings rings on.
    /// M, while nobody renders.
    void resume(int sampleRateHz, int maxBlockFrames);

    /// L. Any thread after prepare.
    std::int64_t playOutFrames() const noexcept { return playOutFrames_.load(std::memory_order_relaxed); }

    int channels() const noexcept { return setup_.channels; }

    /// Whether render also writes out[channels()], what is heard of each hit, in sync with the others.
    bool hasContactSound() const noexcept { return heard_ != nullptr; }

    /// The largest that a sample of that channel has been allowed to be while the limiter is on. Any thread.
    float ceiling(int channel) const noexcept { return ceilings_[static_cast<std::size_t>(channel)].load(std::memory_order_relaxed); }

    /// Session time in frames, with the block that is being rendered. Any thread.
    std::int64_t framesRendered() const noexcept { return sessionFrames_.load(std::memory_order_relaxed); }

    /// Steps the world up to session time, or until `goesOn` (asked after each step) says no; the number of steps made. D.
    int advance(const StepWatch& goesOn = {});

    /// Writes out[channel][0..frames), and the contact sound's channel behind them if there is one. R; wait-free if `mode` is realtime.
    void render(float* const* out, int frames, RenderMode mode) noexcept;

    /// How many frames L is too short for the next `frames` to be in time, as far as the world has been stepped; 0 or less: it
    /// has as many to spare. R, wait-free.
    std::int64_t framesMissing(int frames) const noexcept;

    /// Instead of render: session time goes on by `frames`, and nothing of it is lost, since L grows by as much. What to play
    /// meanwhile is the caller's. R, wait-free.
    void wait(int frames) noexcept;

    /// L is that much longer from the start. R or M, after prepare and before the first block.
    void lengthen(std::int64_t frames) noexcept;

    /// By how much L has grown since prepare. Any thread.
    std::int64_t framesGrown() const noexcept { return grownFrames_.load(std::memory_order_acquire); }

    /// Acts in the world at session time: it is felt L later, and logged. Empty, or what is wrong with it (see
    /// InputCheck), and nothing is done. Any thread but R.
    std::string act(Action action);

    /// Changes how later events are rendered: acts in the world's time at session time, so it is felt L later, is
    /// logged, and an offline render with the same controls is the same to the bit. The time it was given; -1 if the
    /// queue is full. Any thread but R.
    std::int64_t post(RenderControl control);

    /// From session time on, events play these recordings instead of modes; none: modes. Recordings that sound fade out. Felt
    /// and logged as a control; the time it was given, -1 if the queue is full. M.
    std::int64_t useRecordings(std::vector<ContactRecording> recordings);

    /// Plays another scene, as a new take, from the next step on; a state equal to state() changes nothing. Empty, or
    /// what is wrong with the scene, and nothing is done. Any thread but R.
    std::string setState(SessionState state);

    /// What is played, or will be from the next step on. Any thread but R.
    SessionState state() const;

    /// Strikes apart from the world (a test pulse, a material to be heard): each is felt L after session time plus its
    /// own time, and logged. False, and nothing is played, if one cannot be (see isPlayable). Any thread but R.
    bool play(std::span<const CollisionEvent> strikes);

    /// How fast the world goes from its next step on: each step takes `slowness` times its time; 0: it stands still. What
    /// has been struck rings on. Logged as stalls. Any thread, wait-free.
    void setSlowness(int slowness) noexcept { slowness_.store(std::max(0, slowness), std::memory_order_relaxed); }
    int slowness() const noexcept { return slowness_.load(std::memory_order_relaxed); }
    /// One step of a world that stands still. Any thread, wait-free.
    void stepOnce() noexcept { stepsWanted_.fetch_add(1, std::memory_order_relaxed); }

    /// The scene starts anew when frame `offset` of the next block is the present, as a new take. R, wait-free, or M.
    void restart(int offset = 0) noexcept;

    /// Moves what is new since the last call to the end of `log`, which is the same each time; at first, and after prepare, it is
    /// empty. Session time up to which it tells of the world. Nothing to move unless the setup has a log. Any thread but R, one reader.
    std::int64_t readLog(SessionLog& log);

    /// What is born in the render call itself (MIDI, automation), `frame` frames into the block that is rendered next: it
    /// is felt L later like everything else, at an exact frame. False, and counted, if it found no room. R, wait-free.
    bool strike(CollisionEvent event, int frame) noexcept;
    bool control(RenderControl control, int frame) noexcept;
    bool perform(RenderInput input, int frame) noexcept; ///< acts in the world's next step
    /// Not L later but as soon as it can be: what rings fades, and what happened before is not felt any more. As the others. R, wait-free.
    bool silence(int frame) noexcept;

    /// What has been played, in the renderer's frames (session frame - L). One reader.
    HapticRenderer<DesktopProfile>::PlayedQueue& played() noexcept { return renderer_->played(); }

    /// What the world makes and what is posted, once more: for the one reader of another output. Null unless the setup
    /// has a board. What is born in the render call is not told.
    ToldEvents* told() noexcept { return told_.get(); }

    /// The session time that is rendered first in the next block, to be felt when that leaves the device. R.
    std::int64_t nextFeltNs() const noexcept;

    /// Time that was given up after stalls. Any thread.
    std::int64_t slippedNs() const noexcept { return slippedNs_.load(std::memory_order_relaxed); }

    /// Live inputs and bodies that the world holds now: for those who watch that neither grows without end. Any thread but R.
    SessionSize size() const;

    /// Where the bodies of sceneCast() are, as far as the world has been stepped: the session time of that, L before it is
    /// felt. Without a log nobody knows what inputs have spawned, and what is gone is left out. Any thread but R.
    std::int64_t readPoses(std::vector<BodyPose>& poses) const;

    /// Collisions lost in the physics step. Any thread but R.
    std::uint64_t drops() const;

    /// The newest state. One reader (M).
    SessionStatus status() noexcept { return status_.read(); }

private:
    using Queue = EventQueue<CollisionEvent, 8192>;
    using Controls = EventQueue<RenderControl, 256>;
    using OwnStrikes = EventQueue<CollisionEvent, 1024>; // both ends are R: a dense chord in a block of 8192 frames
    using OwnInputs = EventQueue<RenderInput, 1024>;     // from R to whoever steps the world
    using OwnControls = EventQueue<RenderControl, 128>;  // whoever sends them keeps to a pace
    struct LiveSource;
    struct OfflineSource;
    void setContacts();
    bool popControl(RenderControl& control) noexcept;
    int outputs() const noexcept { return setup_.channels + (heard_ ? 1 : 0); }
    void setLaw(int sampleRateHz, int maxBlockFrames);
    void takeUp();
    void takeOwnInputs();
    void spawnOwn(std::int64_t timeNs, SpawnAction action);
    int catchUp(const StepWatch& goesOn = {});
    void moveWorld(std::int64_t untilNs);
    bool handOver();
    std::int64_t nowNs() const noexcept;
    std::int64_t longestLagNs() const noexcept { return law_.longestLagNs() + sessionNs(framesGrown()); }
    std::int64_t sessionNs(std::int64_t frames) const noexcept;
    void renderBehind(float* const* out, std::int64_t done, int frames, RenderMode mode) noexcept;
    void renderOwnWorld(float* const* out, int frames, std::int64_t endNs);

    SessionSetup setup_;
    ClockLaw law_; // changes while nobody renders, under both mutexes
    std::atomic<std::int64_t> playOutFrames_{0}, grownFrames_{0}; // L, and what of it R has added to the law's
    std::unique_ptr<HapticRenderer<DesktopProfile>> renderer_;
    struct RecordingSet {
        std::vector<ContactRecording> recordings;
        int sampleRateHz;
        ContactSounds sounds; // at that rate
    };
    const RecordingSet& recordingSet(const std::vector<ContactRecording>& recordings);
    std::deque<RecordingSet> recordingSets_; // all there were: R may still know any
    const std::unique_ptr<HeardContacts> heard_;
    Queue queue_;
    Controls controls_;
    OwnStrikes ownStrikes_;
    OwnControls ownControls_;
    OwnInputs ownInputs_;
    const std::unique_ptr<ToldEvents> told_;
    std::atomic<std::int64_t> sessionFrames_{0};
    std::atomic<std::int64_t> steppedNs_{0};     // session time of the world up to which all is in the queue
    std::atomic<std::int64_t> restartFrame_{-1}; // -1: not wanted
    std::atomic<bool> offline_{false};
    std::atomic<bool> isDriven_{false}; // somebody has begun to step the world
    std::atomic<std::int64_t> slippedNs_{0};
    std::array<std::atomic<float>, limits::maxEnchanters> ceilings_;
    std::atomic<int> slowness_{1}, stepsWanted_{0};
    LatestValue<SessionStatus> status_;
    std::int64_t leastMarginFrames_ = noMargin; // R

    mutable std::mutex stateMutex_; // taken last; guards what follows
    SessionState state_;
    bool isStateNew_ = false;

    mutable std::mutex worldMutex_; // guards what follows
    SessionWorld world_;
    std::vector<CollisionEvent> made_; // events that the queue had no room for yet, from handed_ on
    std::size_t handed_ = 0;
    std::uint64_t ownSpawns_ = 0;
    std::array<std::string, 64> ownNames_; // of bodies that R spawned, the newest; no world here needs more at once

    mutable std::mutex inputMutex_; // taken first; guards what follows, and the producer's side of controls_
    std::optional<InputCheck> check_;
    std::size_t checkedTake_ = 0;
    SessionLog controlLog_; // without takes, of what has not been read
};

} // namespace physvib
