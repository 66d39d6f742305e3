// SPDX-License-Identifier: GPL-3.0-or-later
// Takes: runs of a session from its seed on, one after the other, started and ended at exact frames by the render role.
//
// Each take is a session of its own that begins at session time 0, so that takes with equal inputs are equal to the
// bit. The take that is replaced plays on for L frames - what happened before is owed to the host, which shifts our
// output by L - and fades then. One thread per instance drives the worlds, and makes ended takes ready for use again.
//
// Who owns what: `takes_` is under `mutex_` (the thread and M; R only in non-realtime blocks). R holds a pointer to the
// playing and to the ending take; it gets one by taking `spare_`, and gives it up by `isEnded`, one atomic store.
#pragma once
#include "Core/GainRamp.h"
#include "Host/Session.h"
#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <tuple>
#include <vector>

namespace physvib {

/// How often the worlds are stepped, and what play-out delay that needs.
struct TakePace {
    static constexpr int leastTicksPerSecond = 200; // 5 ms: a quarter of the two steps that are in L anyway
    static constexpr double headroomSeconds = 0.005; // a DAW's own threads come before ours (measured: Docs/plugin.md)
    static int ticksPerSecond(int stepsPerSecond) noexcept { return stepsPerSecond > leastTicksPerSecond ? std::min(stepsPerSecond, 1000) : leastTicksPerSecond; }
    static double longestGapSeconds(int stepsPerSecond) noexcept { return 1.0 / ticksPerSecond(stepsPerSecond) + headroomSeconds; }
};

/// A collision that was played, and in which take.
struct TakeEvent {
    int take = 0; ///< counted from 1 since prepare
    PlayedEvent played;
};

/// One run of a session.
class Take {
public:
    Take(const SessionSetup& setup, std::uint64_t generation, int sampleRateHz, int blockFrames);

    /// From its seed again. The thread or M, while nobody renders it.
    void rewind();

    /// The next frames of every channel of the session. R.
    void render(int frames, RenderMode mode) noexcept;

    /// Plays what is owed and fades then. R.
    void end() noexcept;
    bool isOver() const noexcept { return over_; } ///< R

    Session session;
    const std::uint64_t generation;
    std::atomic<int> number{0};       ///< set by R when it starts
    std::atomic<bool> isEnded{false}; ///< R lets go of it
    std::vector<std::vector<float>> out;

private:
    int sampleRateHz_, blockFrames_;
    std::vector<float*> at_;
    std::int64_t owed_ = -1; // frames until it fades; -1: it is not ending
    GainRamp fade_;
    bool over_ = false;
};

/// Counts and figures for people.
struct TakesStatus {
    SessionStatus session; ///< of the playing take
    int take = 0;
    std::uint64_t late = 0;          ///< events played after their time, in all takes
    std::int64_t slippedNs = 0;      ///< stalls of the worlds of all takes
    std::uint64_t delayedBlocks = 0; ///< blocks that a start had to wait for a take to be ready
};

class Takes {
public:
    Takes() = default;
    ~Takes() { release(); }

    /// What later takes play. While prepared, the playing take is replaced as soon as R comes by. Any thread but R;
    /// throws std::invalid_argument, and changes nothing, if the setup is not valid.
    void set(SessionSetup setup);

    /// A fresh take stands ready; nothing plays yet. Any thread but R, while nobody renders.
    void prepare(int sampleRateHz, int blockFrames);
    void release();

    /// Keeps a second take ready, so that a start is never late. Any thread.
    void setQuickStarts(bool on) noexcept { quickStarts_ = on; }

    /// L of the present setup; 0 before prepare. Any thread.
    std::int64_t playOutFrames() const noexcept { return playOutFrames_; }

    /// The next `begin` ends the playing take, if there is one, and starts another at its seed. R.
    void start() noexcept { startWanted_ = true; }
    /// Ends the playing take. R.
    void stop() noexcept;
    bool isPlaying() const noexcept { return playing_ != nullptr; } ///< R
    Session* session() noexcept { return playing_ ? &playing_->session : nullptr; } ///< R: the playing take's

    /// Before each block; true if a take starts with it, which knows no controls yet. R, wait-free if realtime.
    bool begin(RenderMode mode) noexcept;
    /// Renders at most the prepared block; `enchanter(j)` is then valid. R, wait-free if realtime.
    void render(int frames, RenderMode mode) noexcept;
    int channels() const noexcept { return std::max(channelsOf(playing_), channelsOf(ending_)); } ///< R
    /// Adds the samples of channel j to out[0..frames). R.
    void addTo(float* out, int channel, int frames) const noexcept;

    /// What was played since the last call, at most `logSize` events; `lost` counts the rest. Any thread but R.
    std::vector<TakeEvent> takeLog();
    /// Where the bodies of the playing take are, and the session time of that; none: empty. Any thread but R.
    std::int64_t poses(std::vector<BodyPose>& now);
    std::uint64_t lostFromLog() const noexcept { return lost_; }
    TakesStatus status() noexcept { return status_.read(); } ///< one reader

private:
    static constexpr std::size_t logSize = 16384; // ten minutes of "shake the box", if nobody looks
    static int channelsOf(const Take* take) noexcept { return take ? take->session.channels() : 0; }
    std::tuple<int, int, std::uint64_t> present();
    void exchange(std::unique_ptr<Take> take);
    void run();
    void tick();
    void drain(Take& take);
    void makeReady();
    Take* takeSpare(RenderMode mode) noexcept;
    void letGo(Take*& take) noexcept;
    Take& add();

    std::mutex setMutex_; // one `set` at a time; taken first
    std::mutex mutex_;    // guards what follows, up to the atomics
    std::optional<SessionSetup> setup_;
    std::vector<std::unique_ptr<Take>> takes_;
    std::vector<TakeEvent> log_;
    std::uint64_t generation_ = 0;
    int sampleRateHz_ = 0, blockFrames_ = 0; // 0: not prepared

    std::atomic<Take*> spare_{nullptr};
    std::atomic<bool> renew_{false}, quickStarts_{false}, stop_{false};
    std::atomic<std::int64_t> playOutFrames_{0};
    std::atomic<std::uint64_t> lost_{0};
    std::atomic<int> ticksPerSecond_{TakePace::leastTicksPerSecond};
    LatestValue<TakesStatus> status_;

    // R
    Take* playing_ = nullptr;
    Take* ending_ = nullptr;
    bool startWanted_ = false;
    int started_ = 0;
    std::uint64_t delayedBlocks_ = 0, lateBefore_ = 0;
    std::int64_t slippedBefore_ = 0;

    std::thread thread_;
};

} // namespace physvib
