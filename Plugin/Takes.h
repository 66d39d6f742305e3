// SPDX-License-Identifier: GPL-3.0-or-later
// Takes: runs of a session from its seed, one after the other, that R starts and ends at exact frames.
//
// Each take is a session of its own that begins at session time 0, so that takes with equal inputs are equal
// to the bit. Those that are replaced play on for L frames, which are owed to the host, and fade then. One
// thread of the process steps the worlds of all instances (Stepper); another, of each instance, makes takes
// ready, of ended ones where it can, and frees what is left over.
//
// Who owns what: `takes_` is under `mutex_` (the threads and M; R only in non-realtime blocks). R holds
// pointers to the playing take, to the next one and to those that are ending; it gets one by taking `spare_`,
// and gives it up by `isEnded`, one atomic store. A take that is being made or freed is in nobody's list, so
// no mutex is held meanwhile.
//
// Hosts ahead of time. L covers one block. If a host asks for more at once (a bounce that it does not call
// one, twenty blocks in a row, a block larger than announced), the thread has not stepped the world that far:
// R sees it (Session::framesMissing) and steps it, as in a non-realtime block. So L never changes and every
// bounce is the live take. Counts of steps alone decide which R makes: a busy machine changes no sample.
#pragma once
#include "Take.h"
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <juce_core/juce_core.h>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace physvib {

/// An object whose worlds the stepping thread advances.
class Stepped {
public:
    virtual void tick() = 0;                           ///< on the stepping thread
    virtual int ticksPerSecond() const noexcept = 0;   ///< while blocks are rendered. Any thread
    virtual double idleSeconds() const noexcept = 0;   ///< the same while none is; the first block waits so
                                                       ///< long
    virtual std::uint64_t blocks() const noexcept = 0; ///< rendered so far. Any thread

protected:
    ~Stepped() = default;
};

/// The thread that steps the worlds of all instances of the process. It runs while it has members, and
/// steps a member that renders nothing only rarely. A juce::SharedResourcePointer holds it.
class Stepper final : private juce::Thread {
public:
    Stepper();
    ~Stepper() override;

    /// Any thread but R. remove() returns once that member is no longer being stepped.
    void add(Stepped& one);
    void remove(Stepped& one);

    /// How often the thread has woken up. Any thread.
    std::uint64_t wakeUps() const noexcept { return wakeUps_; }

private:
    using Clock = std::chrono::steady_clock;
    static constexpr std::chrono::seconds restsAfter{1}; // without a block

    struct Member {
        Stepped* one;
        std::uint64_t blocks;
        Clock::time_point lastBlock, next;
    };
    void run() override;
    void wake();
    static void tick(Member& member, Clock::time_point now);

    std::mutex mutex_; // held while anybody is stepped
    std::condition_variable changed_;
    std::vector<Member> members_;
    std::atomic<std::uint64_t> wakeUps_{0};
};

/// How often the worlds are stepped, and the output latency that this needs.
struct TakePace {
    static constexpr int minTicksPerSecond = 200;    // 5 ms: a quarter of the two steps that are in L anyway
    static constexpr double headroomSeconds = 0.005; // a DAW's own threads come first (Docs/plugin.md)
    static constexpr int stillTicksPerSecond = 20;   // without a world: only the log of events is drained
    static constexpr double stillIdleSeconds = 0.5;
    static int ticksPerSecond(int stepsPerSecond) noexcept {
        return stepsPerSecond > minTicksPerSecond ? std::min(stepsPerSecond, 1000) : minTicksPerSecond;
    }
    /// While nothing is rendered: late by the gap and a step, the world is in time with the first block.
    static double idleSeconds(int stepsPerSecond) noexcept {
        return longestGapSeconds(stepsPerSecond) + 1.0 / stepsPerSecond - idleMarginSeconds;
    }
    static constexpr double idleMarginSeconds = 0.003; // the thread's own lateness
    static double longestGapSeconds(int stepsPerSecond) noexcept {
        return 1.0 / ticksPerSecond(stepsPerSecond) + headroomSeconds;
    }
};

/// A collision that was played, and in which take.
struct TakeEvent {
    int take = 0; ///< counted from 1 since prepare
    PlayedEvent played;
    std::uint64_t place = 0; ///< among those of its take
};

/// Counts and figures for the status line.
struct TakesStatus {
    SessionStatus session; ///< of the playing take
    int take = 0;
    std::uint64_t late = 0;          ///< events played after their time, in all takes
    std::int64_t slippedNs = 0;      ///< stalls of the worlds of all takes
    std::uint64_t delayedBlocks = 0; ///< blocks that a start had to wait for a take to be ready
    std::uint64_t aheadBlocks = 0;   ///< for which the render call stepped the world
};

class Takes final : private Stepped {
public:
    Takes() = default;
    ~Takes() { release(); }

    /// For tests, before prepare: no threads; `tick` does what they do.
    void driveByHand() noexcept { isDrivenByHand_ = true; }
    void tick() override; ///< steps the worlds

    /// Sets what later takes play, and their strips. While prepared, R replaces the playing take in its next
    /// block. Throws std::invalid_argument, changing nothing, if the setup is not valid. Any thread but R.
    void set(SessionSetup setup, const TakeSettings& settings, std::vector<Strip> strips = {});

    /// Sets the strips; the take plays on, and they act L later. Any thread but R.
    void mix(std::vector<Strip> strips);

    /// A fresh take stands ready; nothing plays yet. Any thread but R, while nobody renders.
    /// `knownAfterSeconds`: where strikes are not direct, L has room for one that is known so long after its
    /// time, in a block of any size. `hasMusic`: takes have room for music that comes in.
    void prepare(int sampleRateHz, int blockFrames, double knownAfterSeconds = 0.0, bool hasMusic = false);
    void release();

    /// Sets how worlds are stepped from the next block on; the take plays on. Any thread.
    void setTiming(TakeTiming timing) noexcept { timing_ = timing; }
    TakeTiming timing() const noexcept { return timing_; }

    /// L of the present setup, host and timing; 0 before prepare. Any thread.
    std::int64_t outputLatencyFrames() const noexcept {
        return timing() == TakeTiming::tight ? tightFrames_ : safeFrames_;
    }

    /// What the host is told: L, or with direct strikes, how late one is felt. 0 before prepare. Any thread.
    std::int64_t latencyFrames() const noexcept {
        return isDirect() ? directFrames_.load() : outputLatencyFrames();
    }
    bool isDirect() const noexcept { return directFrames_ > 0; } ///< as latencyFrames

    /// Adopts new settings; called first in each block. Returns their transport mode. R, wait-free.
    TransportMode lookForNew() noexcept;

    /// The next `begin` ends the playing take, if there is one, and starts another at its seed. R.
    void start() noexcept { startWanted_ = true; }
    /// Ends the playing take; not yet if too many are ending. R.
    void stop() noexcept;
    bool isPlaying() const noexcept { return playing_ != nullptr; }                 ///< R
    Session* session() noexcept { return playing_ ? &playing_->session : nullptr; } ///< R: the playing take's
    Take* take() noexcept { return playing_; }                                      ///< R: the playing one
    /// R: the playing take's; none: the newest
    const TakeSettings& settings() const noexcept { return playing_ ? playing_->settings() : newSettings_; }

    /// Called before each part of a block. True: a take starts without controls. R, wait-free if realtime.
    bool begin(RenderMode mode) noexcept;
    /// Mutes in all takes what happened before that frame of the coming block. False: the queue of a take was
    /// full; call again. R, wait-free.
    bool silence(int frame) noexcept;
    /// Renders at most the prepared block; `addTo` is then valid. R, wait-free if realtime.
    void render(int frames, RenderMode mode) noexcept;
    std::uint64_t blocks() const noexcept override { return blocks_.load(std::memory_order_relaxed); }
    int channels() const noexcept; ///< R
    /// Adds the samples of channel j to out[0..frames). R.
    void addTo(float* out, int channel, int frames) const noexcept;

    /// What was played since the last call, at most the newest `logSize` events. Any thread but R.
    std::vector<TakeEvent> drainLog();
    /// Writes the playing take's poses (none: empty); returns their session time in ns. Any thread but R.
    std::int64_t poses(std::vector<BodyPose>& now);
    TakesStatus status() noexcept { return status_.read(); } ///< one reader
    /// why no take can be made, or a world stands still; empty while all is well. Any thread but R
    std::string fault() const;
    /// takes that were built, not made of ended ones. Any thread
    std::uint64_t made() const noexcept { return made_; }

private:
    static constexpr std::size_t logSize = 16384; // ten minutes of "shake the box", if nobody looks
    static constexpr std::size_t kept = 3;        // one plays, one is next, one is ending or spare
    static constexpr std::size_t maxEnding = 8;   // loops as short as an eighth of L
    void setGaps(TakeSpec& order) const noexcept;
    std::unique_ptr<Take> newTake(std::shared_ptr<const TakeSpec> order, int sampleRateHz,
                                  int blockFrames) const;
    void exchange(std::shared_ptr<const TakeSpec> order, std::unique_ptr<Take> take);
    void sendAll();
    int ticksPerSecond() const noexcept override { return ticksPerSecond_; }
    double idleSeconds() const noexcept override { return idleSeconds_; }
    void build();
    void stepWorld(Take& take);
    void drain(Take& take);
    bool isLeftOver(const Take& take) const;
    bool isTakeNeeded() const;
    bool isWorkToDo() const;
    std::vector<std::unique_ptr<Take>> collectUnused();
    std::unique_ptr<Take> makeOf(std::vector<std::unique_ptr<Take>>& ended,
                                 std::shared_ptr<const TakeSpec> order);
    void makeReady(std::unique_lock<std::mutex>& lock);
    void tryToMakeReady(std::unique_lock<std::mutex>& lock) noexcept;

    // R
    template <class Do>
    void forEachSounding(Do what) const noexcept;
    static void letGo(Take*& take) noexcept;
    void letGoOfThoseOver() noexcept;
    RenderMode modeFor(const Take& take, int frames, RenderMode asked) noexcept;
    void writeStatus() noexcept;

    std::mutex setMutex_;      // one `set` at a time; taken first
    mutable std::mutex mutex_; // guards what follows, up to the atomics
    std::shared_ptr<const TakeSpec> order_;
    std::vector<Strip> strips_; // of all takes of that order
    std::vector<std::unique_ptr<Take>> takes_;
    std::vector<TakeEvent> log_;
    std::string fault_;
    bool canMake_ = true;                    // until it fails, then from the next settings on
    int sampleRateHz_ = 0, blockFrames_ = 0; // 0: not prepared; they change while nobody renders
    double knownAfterSeconds_ = 0.0;         // likewise
    std::atomic<bool> hasMusic_{false}; // as they do; a take that was built beside a change is built again
    std::condition_variable workToDo_;

    std::atomic<Take*> spare_{nullptr};
    std::atomic<std::uint64_t> newest_{0}; // generation of the last settings, once they are in spare_
    std::atomic<bool> hasNext_{false}, stop_{false};
    std::atomic<std::int64_t> safeFrames_{0}, tightFrames_{0}, directFrames_{0}; // of the last settings
    std::atomic<TakeTiming> timing_{TakeTiming::safe};
    std::atomic<std::uint64_t> made_{0}, blocks_{0};
    std::atomic<double> idleSeconds_{0.0};
    std::atomic<int> ticksPerSecond_{TakePace::minTicksPerSecond};
    LatestValue<TakesStatus> status_;
    bool isDrivenByHand_ = false;

    // R
    Take* playing_ = nullptr;
    Take* next_ = nullptr;
    std::array<Take*, maxEnding> ending_{}; // the oldest first
    std::size_t endingCount_ = 0;
    TakeSettings newSettings_;
    bool startWanted_ = false;
    int started_ = 0;
    std::uint64_t delayedBlocks_ = 0, lateBefore_ = 0;
    std::int64_t slippedBefore_ = 0;
    std::uint64_t aheadBlocks_ = 0;

    std::optional<juce::SharedResourcePointer<Stepper>> stepper_; // while prepared
    std::thread builder_;
};

} // namespace physvib
