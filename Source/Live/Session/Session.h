// SPDX-License-Identifier: MIT
// A world that is felt while it moves: simulation, renderer and the time between them.
// Who may call what when, and why: Docs/threads.md, the threading model.
#pragma once
#include "Core/HapticRenderer.h"
#include "Core/LatestValue.h"
#include "Live/Session/CallbackInputs.h"
#include "Live/Session/RenderedChannels.h"
#include "Live/Session/Scheduler.h"
#include "Live/Session/SinkSet.h"
#include "Live/Session/Timeline.h"
#include "Live/Session/WorldRunner.h"
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace physvib {

/// Made of parts: what is asked of its time, of its world or in the render call stands in their headers.
class Session {
public:
    /// M. Throws std::invalid_argument if the scene is not valid.
    explicit Session(const SessionSetup& setup);

    /// Sets L; silence at session time 0, the scene at its start, the log empty. M, while nobody renders or
    /// drives.
    void prepare(int sampleRateHz, int maxBlockFrames);

    /// Goes on at another rate and block size: session time and world stay, L is set anew, what rings rings
    /// on. M, while nobody renders.
    void resume(int sampleRateHz, int maxBlockFrames);

    const Timeline& timeline() const noexcept { return time_; }
    WorldRunner& world() noexcept { return world_; }
    const WorldRunner& world() const noexcept { return world_; }
    CallbackInputs& callback() noexcept { return callback_; } ///< for what comes in the render call itself
    const RenderedChannels& rendered() const noexcept { return channels_; }
    int channels() const noexcept { return setup_.channels; } ///< of the actuators

    /// What becomes of all collisions, and of strikes, before they are rendered. Any thread.
    const EventShaping& shaping() const noexcept { return setup_.shaping; }

    /// Steps the world up to session time, or until `goesOn` (asked after each step) says no; the number of
    /// steps made. D.
    int advance(const StepWatch& goesOn = {});

    /// Writes out[0..rendered().count())[0..frames). R; wait-free if `mode` is realtime.
    void render(float* const* out, int frames, RenderMode mode) noexcept;

    /// How many frames L is too short for the next `frames` to be in time, as far as the world has been
    /// stepped; 0 or less: it has as many to spare. R, wait-free.
    std::int64_t framesMissing(int frames) const noexcept {
        return time_.framesMissing(frames, world_.steppedNs_);
    }

    /// Instead of render: session time goes on by `frames`, and nothing of it is lost, since L grows by as
    /// much. What to play meanwhile is the caller's. R, wait-free.
    void wait(int frames) noexcept;

    /// The other way round, beside render: nobody feels the renderer's next frames, and L is shorter by as
    /// many. `unfelt` is as of render. After L has grown, or where the world has room for that. R, wait-free.
    void wait(float* const* unfelt, int frames) noexcept;

    /// Before the first block: what is born is felt as soon as before, the world begins later. R, or M.
    void startLater(std::int64_t frames) noexcept;

    /// Does an input: what it does is felt L after its time, logged, and the same to the bit when the log is
    /// rendered. The time it was given; or what is wrong with it, or that too many wait, and nothing is done.
    /// Any thread but R; recordings, M.
    Result<std::int64_t> take(Input input) { return scheduler_.take(std::move(input)); }

    /// Keeps the channels of a clip, whose files tell its path and hash (their own frequencies say nothing),
    /// and says by which number: strikes of clipFrequencyHz() of it, and of those that follow, play them
    /// beside whatever sounds, which goes on undisturbed. Nothing if there is no room for all, of numbers or
    /// samples. A clip that is kept already is the same one. Logged. Any thread but R.
    std::optional<int> keepClip(std::span<const ContactRecording> channels) {
        return scheduler_.keepClip(channels);
    }

    /// How later strikes are spread, as far as has been told. Any thread but R.
    PhantomPanner panner() const { return scheduler_.panner(); }

    /// Moves what is new since the last call to the end of `log`, which is the same each time; at first, and
    /// after prepare, it is empty. Session time up to which it tells of the world. Nothing to move unless the
    /// setup has a log. Any thread but R, one reader.
    std::int64_t readLog(SessionLog& log) { return scheduler_.readLog(log); }

    /// What has been played, in the renderer's frames (session frame - L). One reader.
    HapticRenderer::PlayedQueue& played() noexcept { return renderer_->played(); }

    /// What is played beside the device: L covers the latency of those that are there when it is set.
    SinkSet& sinks() noexcept { return sinks_; }
    const SinkSet& sinks() const noexcept { return sinks_; }

    /// The newest state. One reader (M).
    SessionStatus status() noexcept { return status_.read(); }

private:
    struct Source;
    ClockLaw lawAt(int sampleRateHz, int maxBlockFrames) const;
    void setTime(const ClockLaw& law, std::int64_t frames) {
        time_.set(law, setup_.direct != Direct::no, setup_.direct == Direct::born, frames);
    }

    const SessionSetup setup_;
    const std::unique_ptr<HapticRenderer> renderer_;
    SinkSet sinks_;
    Timeline time_;
    RenderedChannels channels_;
    CallbackInputs callback_;
    WorldRunner world_;
    Scheduler scheduler_;
    LatestValue<SessionStatus> status_;
    std::int64_t leastMarginFrames_ = noMargin; // R
};

} // namespace physvib
