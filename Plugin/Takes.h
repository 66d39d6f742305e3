// SPDX-License-Identifier: GPL-3.0-or-later
// Takes: runs of a session from its seed on, one after the other, started and ended at exact frames by the
// render role.
//
// Each take is a session of its own that begins at session time 0, so that takes with equal inputs are equal
// to the bit. Those that are replaced play on for L frames - what happened before is owed to the host, which
// shifts our output by L - and fade then. One thread of the process steps the worlds of all instances and
// does nothing else (Stepper.h); another, of each instance, makes takes ready, of ended ones where it can,
// and frees what is left over, beside it.
//
// Who owns what: `takes_` is under `mutex_` (the threads and M; R only in non-realtime blocks). R holds
// pointers to the playing take, to the next one and to those that are ending; it gets one by taking `spare_`,
// and gives it up by `isEnded`, one atomic store. A take that is being made or freed is in nobody's list, so
// no mutex is held meanwhile.
//
// Hosts in bursts. L covers what the host asks for at once: one block. If it asks for more - twenty blocks in
// a row, half a second ahead, a block larger than announced - the world cannot be there, since it never goes
// beyond session time. R sees that (Session::framesMissing) and, if the steady clock says that the thread has
// been in time, lets L grow until the world is there. The host is told, and later takes begin with it.
#pragma once
#include "HostPace.h"
#include "Stepper.h"
#include "Take.h"
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace physvib {

/// How often the worlds are stepped, and what play-out delay that needs.
struct TakePace {
    static constexpr int leastTicksPerSecond = 200;  // 5 ms: a quarter of the two steps that are in L anyway
    static constexpr double headroomSeconds = 0.005; // a DAW's own threads come before ours (measured:
                                                     // Docs/plugin.md)
    static constexpr double growthSeconds = 0.02;    // L grows in steps: hosts stop and start to take it out
                                                     // again
    static constexpr double mostLeadSeconds = 1.0;   // twice of what hosts are known to render ahead
    static int ticksPerSecond(int stepsPerSecond) noexcept {
        return stepsPerSecond > leastTicksPerSecond ? std::min(stepsPerSecond, 1000) : leastTicksPerSecond;
    }
    /// While nothing is rendered: late by the gap and the step that may not have begun, the world is still in
    /// time with the first block.
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
};

/// Counts and figures for people.
struct TakesStatus {
    SessionStatus session; ///< of the playing take
    int take = 0;
    std::uint64_t late = 0;          ///< events played after their time, in all takes
    std::int64_t slippedNs = 0;      ///< stalls of the worlds of all takes
    std::uint64_t delayedBlocks = 0; ///< blocks that a start had to wait for a take to be ready
    std::int64_t burstFrames = 0;    ///< part of L: what the host asks for at once beyond a block
    std::int64_t waitedFrames = 0; ///< by which L has grown while something was played: since then all comes
                                   ///< later
};

class Takes final : private Stepped {
public:
    Takes() = default;
    ~Takes() { release(); }

    /// For tests, before prepare: no threads; `tick` does what they do, and it is `nowNs`.
    void driveByHand(const std::atomic<std::int64_t>& nowNs) noexcept { handNs_ = &nowNs; }
    void tick() override; ///< steps the worlds

    /// What later takes play, and by what strips. While prepared, the playing take is replaced as soon as R
    /// comes by. Any thread but R; throws std::invalid_argument, and changes nothing, if the setup is not
    /// valid.
    void set(SessionSetup setup, const TakeSettings& settings, std::vector<Strip> strips = {});

    /// Other strips; what plays goes on, and is felt by them L later. Any thread but R.
    void mix(std::vector<Strip> strips);

    /// A fresh take stands ready; nothing plays yet. Any thread but R, while nobody renders.
    /// `knownAfterSeconds`: where strikes are not direct, L has room for one that is known so long after its
    /// time, in a block of any size. `hasMusic`: takes have room for music that comes in.
    void prepare(int sampleRateHz, int blockFrames, double knownAfterSeconds = 0.0, bool hasMusic = false);
    void release();

    /// L of the present setup and host; 0 before prepare. Any thread.
    std::int64_t playOutFrames() const noexcept { return playOutFrames_; }

    /// What the host is told: L, or, where strikes are direct, how long after its frame one is felt. 0 before
    /// prepare. Any thread.
    std::int64_t latencyFrames() const noexcept {
        return isDirect() ? directFrames_.load() : playOutFrames_.load();
    }
    bool isDirect() const noexcept { return directFrames_ > 0; } ///< as latencyFrames

    /// L is to be as short as it was at first: now, or when the transport stands and the host has been calm.
    /// Any thread; R.
    void giveBack() noexcept { giveBack_ = true; }
    void transportStands(bool stands) noexcept { stands_ = stands; }

    /// At the beginning of a block, first: lets new settings in. How they follow the transport. R, wait-free.
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

    /// Before each part of a block; true if a take starts with it, which knows no controls yet. R, wait-free
    /// if realtime.
    bool begin(RenderMode mode) noexcept;
    /// What happened before that frame of the coming block is not felt any more, whatever take it is of.
    /// False if one has no room for it: it has to be told again. R, wait-free.
    bool silence(int frame) noexcept;
    /// Renders at most the prepared block; `addTo` is then valid. R, wait-free if realtime.
    void render(int frames, RenderMode mode) noexcept;
    int channels() const noexcept; ///< R
    /// Adds the samples of channel j to out[0..frames). R.
    void addTo(float* out, int channel, int frames) const noexcept;

    /// What was played since the last call, at most `logSize` events; `lost` counts the rest. Any thread but
    /// R.
    std::vector<TakeEvent> takeLog();
    /// Where the bodies of the playing take are, and the session time of that; none: empty. Any thread but R.
    std::int64_t poses(std::vector<BodyPose>& now);
    std::uint64_t lostFromLog() const noexcept { return lost_; }
    TakesStatus status() noexcept { return status_.read(); } ///< one reader
    /// why no take can be made, or a world stands still; empty while all is well. Any thread but R
    std::string fault() const;
    /// takes that were built, not made of ended ones. Any thread
    std::uint64_t made() const noexcept { return made_; }

private:
    static constexpr std::size_t logSize = 16384; // ten minutes of "shake the box", if nobody looks
    static constexpr std::size_t kept = 3;        // one plays, one is next, one is ending or spare
    static constexpr std::size_t mostEnding = 8;  // loops as short as an eighth of L
    std::shared_ptr<const TakeOrder> order() const;
    double gapSeconds(const SessionSetup& setup) const noexcept;
    std::unique_ptr<Take> newTake(std::shared_ptr<const TakeOrder> order, int sampleRateHz,
                                  int blockFrames) const;
    void exchange(std::shared_ptr<const TakeOrder> order, std::unique_ptr<Take> take);
    void tellAll();
    int ticksPerSecond() const noexcept override { return ticksPerSecond_; }
    double idleSeconds() const noexcept override { return idleSeconds_; }
    std::uint64_t blocks() const noexcept override { return blocks_.load(std::memory_order_relaxed); }
    void build();
    void stepWorld(Take& take);
    void drain(Take& take);
    bool isLeftOver(const Take& take) const;
    bool isTakeNeeded() const;
    bool isWorkToDo() const;
    std::vector<std::unique_ptr<Take>> takeOut();
    std::unique_ptr<Take> makeOf(std::vector<std::unique_ptr<Take>>& ended,
                                 std::shared_ptr<const TakeOrder> order);
    void makeReady(std::unique_lock<std::mutex>& lock);
    void tryToMakeReady(std::unique_lock<std::mutex>& lock) noexcept;
    std::int64_t nowNs() const noexcept;

    // R
    template <class Do>
    void forEachSounding(Do what) const noexcept;
    void letGo(Take*& take) noexcept;
    void letGoOfThoseOver() noexcept;
    void coverBurst(int frames) noexcept;
    void heal(std::int64_t nowNs) noexcept;
    void lead(std::int64_t frames) noexcept;
    void tell() noexcept;

    std::mutex setMutex_;      // one `set` at a time; taken first
    mutable std::mutex mutex_; // guards what follows, up to the atomics
    std::shared_ptr<const TakeOrder> order_;
    std::vector<Strip> strips_; // of all takes of that order
    std::vector<std::unique_ptr<Take>> takes_;
    std::vector<TakeEvent> log_;
    std::string fault_;
    bool canMake_ = true;                    // until it fails, then from the next settings on
    int sampleRateHz_ = 0, blockFrames_ = 0; // 0: not prepared; they change while nobody renders
    double knownAfterSeconds_ = 0.0;         // as they do
    std::atomic<bool> hasMusic_{false}; // as they do; a take that was built beside a change is built again
    std::condition_variable workToDo_;

    std::atomic<Take*> spare_{nullptr};
    std::atomic<std::uint64_t> newest_{0}; // generation of the last settings, once they are in spare_
    std::atomic<bool> hasNext_{false}, stop_{false}, giveBack_{false};
    std::atomic<std::int64_t> playOutFrames_{0}, directFrames_{0}, leadFrames_{0}, tickedNs_{0};
    std::atomic<double> leadSeconds_{0.0}; // what a host that goes ahead was seen to ask for at once, also
                                           // before prepare
    std::atomic<std::uint64_t> lost_{0}, made_{0}, blocks_{0};
    std::atomic<double> idleSeconds_{0.0};
    std::atomic<int> ticksPerSecond_{TakePace::leastTicksPerSecond};
    LatestValue<TakesStatus> status_;
    const std::atomic<std::int64_t>* handNs_ = nullptr;

    // R
    Take* playing_ = nullptr;
    Take* next_ = nullptr;
    std::array<Take*, mostEnding> ending_{}; // the oldest first
    std::size_t endingCount_ = 0;
    TakeSettings newSettings_;
    bool startWanted_ = false;
    int started_ = 0;
    std::uint64_t delayedBlocks_ = 0, lateBefore_ = 0;
    std::int64_t slippedBefore_ = 0, waitedFrames_ = 0;
    HostPace hostPace_;
    std::int64_t aheadFrames_ = 0; // part of leadFrames_ that a host needs which goes ahead of time; a block
                                   // at least
    std::int64_t runFrames_ = 0, neededNs_ = 0;
    bool isAheadNeeded_ = false, stands_ = false;

    std::optional<juce::SharedResourcePointer<Stepper>> stepper_; // while prepared
    std::thread builder_;
};

} // namespace physvib
