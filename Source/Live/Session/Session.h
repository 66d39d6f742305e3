// SPDX-License-Identifier: MIT
// A live session: a physics world and its renderer, with a constant output latency between them.
//
// Threading model. One thread at a time holds a role; comments everywhere name it by its letter.
// - M, the message thread: sets up, edits, reads telemetry. It may allocate, lock and wait.
// - D, the world driver: calls advance(). M's timer or a ThreadDriver; as M, but it must be on time.
// - R, the render thread: calls render(). It never allocates, frees, locks, waits or calls the system. Blocks
//   that the host calls non-realtime, or that need a world which D has not stepped, are the exception.
// - N, the thread of an input (OscPort, InputListener): waits for the session's mutexes, never for M.
// - I, the thread that reads an input: does silence itself, queues all else for N, waits for its input alone.
// - W, of OutputWriter: writes standard output and standard error, waits for their readers, holds no mutex.
// Order of locking: Scheduler (inputs), WorldRunner (world), then state and law, last the sinks' own. No
// thread holds one while it calls JUCE or a host. D steps the world up to session time and never beyond; R
// plays an event of world time w at w + L, L being the output latency. A driver that may hang is opened and
// closed by DeviceThread, and a BoardLink has a thread of its own.
#pragma once
#include "Core/EventQueue.h"
#include "Core/HapticRenderer.h"
#include "Live/Session/ContactAudio.h"
#include "Live/Session/OutputClock.h"
#include "Live/Session/Scheduler.h"
#include "Live/Session/Sink.h"
#include "Live/Session/Timeline.h"
#include "Live/Session/WorldRunner.h"
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>

namespace physvib {

/// A live session. Its parts document themselves: Timeline (time), WorldRunner (world), CallbackInputs
/// (inputs in the render call).
class Session {
public:
    /// M. Throws std::invalid_argument if the scene is not valid.
    explicit Session(const SessionSetup& setup)
        : Session{std::make_shared<const SessionSetup>(setup)} {}
    /// Shares the setup instead of copying it.
    explicit Session(std::shared_ptr<const SessionSetup> setup);

    /// Sets the output latency. Session time 0, silence, the scene at its start, an empty log. M, while no
    /// thread renders or drives. Throws std::bad_alloc without memory, as resume does.
    void prepare(int sampleRateHz, int maxBlockFrames);

    /// Continues at another rate and block size: session time, world and sounding modes go on, and the output
    /// latency is computed again. M, while no thread renders.
    void resume(int sampleRateHz, int maxBlockFrames);

    const Timeline& timeline() const noexcept { return time_; }
    WorldRunner& world() noexcept { return world_; }
    const WorldRunner& world() const noexcept { return world_; }
    CallbackInputs& callback() noexcept { return callback_; } ///< for inputs in the render call
    const RenderedChannels& rendered() const noexcept { return channels_; }
    int channels() const noexcept { return setup_.channels; } ///< of the actuators

    /// Shaping of all collisions and events before rendering. Any thread.
    const EventShaping& shaping() const noexcept { return setup_.shaping; }

    /// Steps the world up to session time, or until `keepGoing` (called after each step) returns false.
    /// Returns the number of steps. D.
    int advance(const StepWatch& keepGoing = {});

    /// Writes out[0..rendered().count())[0..frames). R; wait-free if `mode` is realtime.
    void render(float* const* out, int frames, RenderMode mode) noexcept;

    /// Number of frames by which the output latency is too short for the next `frames` to be in time, given
    /// the world's time; negative or 0: spare frames. R, wait-free.
    std::int64_t framesMissing(int frames) const noexcept {
        if (!setup_.hasWorld) return 0;
        return time_.framesMissing(frames, world_.steppedNs_);
    }

    /// Call before the first render after a pause of the device; `nowNs` is steady time. Drops events that
    /// were due at once, or all waiting events if the device was gone. Sounding modes, the world and its
    /// collisions continue. R, wait-free.
    void endPause(std::int64_t nowNs) noexcept;

    /// Replaces render: session time advances by `frames` and the output latency grows by as much, so
    /// nothing is lost. The caller supplies the samples meanwhile. R, wait-free.
    void lengthenLatency(int frames) noexcept;

    /// The opposite of lengthenLatency(), beside render: the renderer's next `frames` go to `discarded` and
    /// are not played, which shortens the output latency by as much. Only after it has grown, or if the world
    /// is far enough ahead. R, wait-free.
    void shortenLatency(float* const* discarded, int frames) noexcept;

    /// Executes an input. Its effect is felt the output latency after its time, is logged, and is the same
    /// to the bit when the log is rendered. Returns the time that it was given; or an error (invalid, too
    /// many pending, or, of events and pushes, DevicePulse::droppedError), and nothing is done.
    /// Any thread but R; recordings: M.
    Result<std::int64_t> submit(Input input) { return scheduler_.submit(std::move(input)); }

    /// Keeps the channels of a clip, identified by path and hash of its file (their frequencies are ignored),
    /// and returns the number of the first. Events whose sound is soundOfClip() of it and of the following
    /// numbers play them; other sounds are not disturbed. nullopt if there is no room for all, in numbers or
    /// samples. A clip that is kept already keeps its number. Logged. Any thread but R.
    std::optional<int> addClip(std::span<const ContactRecording> channels) {
        return scheduler_.addClip(channels);
    }

    /// The panner of later events, as last set. Any thread but R.
    PhantomPanner panner() const { return scheduler_.panner(); }

    /// Moves the log entries since the last call to the end of `log`. Pass the same `log` each time; it is
    /// empty at first and after prepare. Returns the session time up to which it covers the world. No entries
    /// unless the setup has a log. Any thread but R, one reader.
    std::int64_t readLog(SessionLog& log) { return scheduler_.readLog(log); }

    /// The events that were played, in the renderer's frames (session frame - output latency). One reader.
    HapticRenderer::PlayedQueue& played() noexcept { return renderer_->played(); }

    /// Outputs beside the device. The output latency covers the latency of those attached when it is set.
    SinkSet& sinks() noexcept { return sinks_; }
    const SinkSet& sinks() const noexcept { return sinks_; }

    /// State of the device that plays the session, set by its output. Any thread.
    DevicePulse& pulse() noexcept { return pulse_; }
    const DevicePulse& pulse() const noexcept { return pulse_; }

    /// The newest state. One reader (M).
    SessionStatus status() noexcept { return status_.read(); }

private:
    struct Source;
    ClockLaw makeClockLaw(int sampleRateHz, int maxBlockFrames) const;
    void setTime(const ClockLaw& law, std::int64_t frames) {
        time_.set(law, setup_.direct != Direct::no, setup_.direct == Direct::fromStart, frames);
    }

    const std::shared_ptr<const SessionSetup> setupOwner_;
    const SessionSetup& setup_;
    const std::unique_ptr<HapticRenderer> renderer_;
    SinkSet sinks_;
    Timeline time_;
    DevicePulse pulse_;
    RenderedChannels channels_;
    CallbackInputs callback_;
    WorldRunner world_;
    Scheduler scheduler_;
    LatestValue<SessionStatus> status_;
    std::int64_t minMarginFrames_ = noMargin; // R
};

/// Whether the output latency suffices for all sinks; if not, Session::resume() lengthens it. M.
inline bool coversSinks(const Session& session) {
    return session.sinks().latencySeconds() <= session.timeline().sinkSeconds();
}

} // namespace physvib
