// SPDX-License-Identifier: GPL-3.0-or-later
// PluginRuns: runs of a session from its seed, one after the other, started and ended at exact frames; and
// Stepper, the thread that steps their worlds. R: the host's audio thread; M: the message thread; L: latency.
// Each run is a session of its own that begins at session time 0, so that runs with equal inputs are equal
// to the bit. A replaced run plays the L frames that it still owes to the host, and then fades. Stepper steps
// the worlds of all instances of the process; a builder thread per instance prepares the next run, from an
// ended one where it can, and frees runs that are no longer needed.
// Ownership: `mutex_` guards `runs_` (the two threads and M; R only in non-realtime blocks). R has pointers
// to the playing run, the next one and those that are ending. It takes a run by an exchange of `spareRun_`,
// and returns it by one atomic store to `isReleased`. A run that is being built or freed is in no list, so
// that no mutex is held meanwhile.
//
// L covers one block. A host may ask for more at once: a bounce that it does not announce as one, or a block
// larger than announced. Then the thread has not stepped the world that far: R notices it
// (Session::framesMissing) and steps the world itself, as in a non-realtime block. So L never changes, and
// every bounce equals the live run. Only step counts decide how many steps R makes, so a busy machine changes
// no sample.
#pragma once
#include "PluginRun.h"
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
class StepClient {
public:
    virtual void tick() = 0;                           ///< on the stepping thread
    virtual int ticksPerSecond() const noexcept = 0;   ///< while blocks are rendered. Any thread
    virtual double idleSeconds() const noexcept = 0;   ///< between ticks while none is. Any thread
    virtual std::uint64_t blocks() const noexcept = 0; ///< rendered so far. Any thread

protected:
    ~StepClient() = default;
};

/// The thread that steps the worlds of all instances of the process. It sleeps while it has no members, and
/// seldom steps a member that renders nothing. A juce::SharedResourcePointer owns it.
class Stepper final : private juce::Thread {
public:
    Stepper();
    ~Stepper() override;

    /// Any thread but R. remove() returns once that member is no longer being stepped.
    void add(StepClient& client);
    void remove(StepClient& client);

    /// How often the thread has woken up. Any thread.
    std::uint64_t wakeUps() const noexcept { return wakeUps_; }

private:
    using Clock = std::chrono::steady_clock;
    static constexpr std::chrono::seconds idleAfter{1}; // a member without a block for so long is idle

    struct Member {
        StepClient* client;
        std::uint64_t blocks;
        Clock::time_point lastBlock, nextTick;
    };
    void run() override;
    static void tick(Member& member, Clock::time_point now);

    std::mutex mutex_; // held while anybody is stepped
    std::condition_variable wakeCondition_;
    std::vector<Member> members_;
    std::atomic<std::uint64_t> wakeUps_{0};
};

/// How often the worlds are stepped, and the output latency that this needs.
struct StepPace {
    static constexpr int minTicksPerSecond = 200;      // 5 ms: a quarter of the two steps that L includes
    static constexpr double headroomSeconds = 0.005;   // a DAW's own threads come first (Docs/plugin.md)
    static constexpr int worldlessTicksPerSecond = 20; // without a world, ticks only drain the event log
    static constexpr double worldlessIdleSeconds = 0.5;
    static int ticksPerSecond(int stepsPerSecond) noexcept {
        return stepsPerSecond > minTicksPerSecond ? std::min(stepsPerSecond, 1000) : minTicksPerSecond;
    }
    /// The interval while nothing is rendered, after which the world is still in time with the first block.
    static double idleSeconds(int stepsPerSecond) noexcept {
        return longestGapSeconds(stepsPerSecond) + 1.0 / stepsPerSecond - idleMarginSeconds;
    }
    static constexpr double idleMarginSeconds = 0.003; // the thread may wake that late
    static double longestGapSeconds(int stepsPerSecond) noexcept {
        return 1.0 / ticksPerSecond(stepsPerSecond) + headroomSeconds;
    }
};

/// A collision that was played, and in which run.
struct RunEvent {
    int runNumber = 0; ///< counted from 1 since prepare()
    PlayedEvent played;
    std::uint64_t indexInRun = 0; ///< its place among the events of its run, from 0
    std::uint64_t generation = 0; ///< of that run's settings
};

/// Counts for the status line of the window, all since prepare().
struct RunsStatus {
    SessionStatus session; ///< of the playing run
    int runNumber = 0;
    std::uint64_t late = 0;                  ///< events played after their time, in all runs
    std::int64_t stalledNs = 0;              ///< stalls of the worlds of all runs
    std::uint64_t delayedBlocks = 0;         ///< blocks in which a start waited because no run was ready
    std::uint64_t blocksSteppedInRender = 0; ///< blocks for which the render call stepped the world
};

class PluginRuns final : private StepClient {
public:
    PluginRuns() = default;
    ~PluginRuns() { release(); }

    /// For tests, before prepare(): no threads are started; tick() does their work.
    void useManualStepping() noexcept { isManuallyStepped_ = true; }
    void tick() override; ///< steps the worlds, drains their logs, and wakes the builder

    /// Sets the setup and the strips of later runs. If prepared, R replaces the playing run in its next
    /// block. Throws std::invalid_argument, changing nothing, if the setup is not valid. Any thread but R.
    void set(SessionSetup setup, const RenderSettings& settings, std::vector<Strip> strips = {});

    /// Sets the strips of the playing run, which act L later, and of later runs. Any thread but R.
    void setStrips(std::vector<Strip> strips);

    /// Makes the first run ready; nothing plays yet. Any thread but R, while nobody renders.
    /// `detectionDelaySeconds`: how long after its time a beat may be detected; L includes it unless strikes
    /// are direct. `hasMusic`: the host may send music, so each run has a MusicDelay.
    void prepare(int sampleRateHz, int blockFrames, double detectionDelaySeconds = 0.0,
                 bool hasMusic = false);
    void release();

    /// Sets where worlds are stepped from the next block on; the run plays on. Any thread.
    void setTiming(StepTiming timing) noexcept { timing_ = timing; }
    StepTiming timing() const noexcept { return timing_; }

    /// L of the present setup, host and timing; 0 before prepare. Any thread.
    std::int64_t outputLatencyFrames() const noexcept {
        return timing() == StepTiming::tight ? tightFrames_ : safeFrames_;
    }

    /// Latency to report to the host: L, or that of direct strikes. 0 before prepare(). Any thread.
    std::int64_t latencyFrames() const noexcept {
        return isDirect() ? directFrames_.load() : outputLatencyFrames();
    }
    bool isDirect() const noexcept { return directFrames_ > 0; } ///< strikes do not wait L. Any thread

    /// Adopts new settings; called first in each block. Returns their transport mode. R, wait-free.
    TransportMode adoptNewSettings() noexcept;

    /// The next `begin` ends the playing run, if there is one, and starts another at its seed. R.
    void start() noexcept { isStartRequested_ = true; }
    /// Ends the playing run; not yet if too many are ending. R.
    void stop() noexcept;
    bool isPlaying() const noexcept { return current_ != nullptr; }                 ///< R
    Session* session() noexcept { return current_ ? &current_->session : nullptr; } ///< R: the playing run's
    PluginRun* currentRun() noexcept { return current_; }                           ///< R: the playing one
    /// R: those of the playing run; the newest if none plays
    const RenderSettings& settings() const noexcept { return current_ ? current_->settings() : newSettings_; }

    /// Called before each part of a block. True if a run begins, without controls. R, wait-free if realtime.
    bool begin(RenderMode mode) noexcept;
    /// Mutes in all runs what happened before that frame of the coming block. False if a run's queue was
    /// full: call it again. R, wait-free.
    bool silence(int frame) noexcept;
    /// Renders at most a prepared block for addTo(). R, wait-free if realtime.
    void render(int frames, RenderMode mode) noexcept;
    std::uint64_t blocks() const noexcept override { return blocks_.load(std::memory_order_relaxed); }
    int channels() const noexcept; ///< the largest number of any sounding run. R
    /// Adds the rendered samples of `channel` to out[0..frames). R.
    void addTo(float* out, int channel, int frames) const noexcept;

    /// Events played since the last call, at most the newest `maxLogEvents`. Any thread but R.
    std::vector<RunEvent> drainLog();
    /// Writes the poses of the playing run, or none; returns their session time in ns. Any thread but R.
    std::int64_t readPoses(std::vector<BodyPose>& poses);
    RunsStatus status() noexcept { return status_.read(); } ///< one reader
    /// why no run can be built, or why a world stands still; empty if neither is so. Any thread but R
    std::string errorText() const;
    std::uint64_t generation() const noexcept { return newestGeneration_; } ///< of the settings. Any thread
    /// how many runs were built anew instead of reused. Any thread
    std::uint64_t builtRuns() const noexcept { return builtRuns_; }

private:
    static constexpr std::size_t maxLogEvents = 16384; // ten minutes of "shake the box" with a closed window
    static constexpr std::size_t maxRuns = 3;          // one plays, one is next, one is ending or spare
    static constexpr std::size_t maxEnding = 8;        // loops as short as an eighth of L
    void setLongestGap(RunSpec& spec) const noexcept;
    std::unique_ptr<PluginRun> makeRun(std::shared_ptr<const RunSpec> spec, int sampleRateHz,
                                       int blockFrames) const;
    void installRun(std::shared_ptr<const RunSpec> spec, std::unique_ptr<PluginRun> run);
    void sendStripsToRuns();
    int ticksPerSecond() const noexcept override { return ticksPerSecond_; }
    double idleSeconds() const noexcept override { return idleSeconds_; }
    void runBuilder();
    void logPlayed(PluginRun& run);
    bool isDisposable(const PluginRun& run) const;
    bool isSpareNeeded() const;
    bool hasWork() const;
    std::vector<std::unique_ptr<PluginRun>> collectUnused();
    std::unique_ptr<PluginRun> reuseOrBuild(std::vector<std::unique_ptr<PluginRun>>& ended,
                                            std::shared_ptr<const RunSpec> spec);
    void prepareSpare(std::unique_lock<std::mutex>& lock);
    void tryToPrepareSpare(std::unique_lock<std::mutex>& lock) noexcept;

    // R
    template <class Visit>
    void forEachAudible(Visit visit) const noexcept;
    static void retire(PluginRun*& run) noexcept;
    void retireFinished() noexcept;
    RenderMode renderModeFor(const PluginRun& run, int frames, RenderMode requested) noexcept;
    void writeStatus() noexcept;

    std::mutex settingsMutex_; // one `set` at a time; taken first
    mutable std::mutex mutex_; // guards what follows, up to the atomics
    std::shared_ptr<const RunSpec> spec_;
    std::vector<Strip> strips_; // strips of all runs of spec_
    std::vector<std::unique_ptr<PluginRun>> runs_;
    std::vector<RunEvent> eventLog_;
    std::string errorText_;
    bool canBuild_ = true;                   // false from a failure to build until the next settings
    int sampleRateHz_ = 0, blockFrames_ = 0; // 0: not prepared; they change only while nobody renders
    double detectionDelaySeconds_ = 0.0;     // likewise
    std::atomic<bool> hasMusic_{false};      // likewise
    std::condition_variable workCondition_;

    std::atomic<PluginRun*> spareRun_{nullptr};
    std::atomic<std::uint64_t> newestGeneration_{0}; // of the last settings
    std::atomic<bool> hasNextRun_{false}, isStopping_{false};
    std::atomic<std::int64_t> safeFrames_{0}, tightFrames_{0}, directFrames_{0}; // of the last settings
    std::atomic<StepTiming> timing_{StepTiming::safe};
    std::atomic<std::uint64_t> builtRuns_{0}, blocks_{0};
    std::atomic<double> idleSeconds_{0.0};
    std::atomic<int> ticksPerSecond_{StepPace::minTicksPerSecond};
    LatestValue<RunsStatus> status_;
    bool isManuallyStepped_ = false;

    // R
    PluginRun* current_ = nullptr;
    PluginRun* nextRun_ = nullptr;
    std::array<PluginRun*, maxEnding> ending_{}; // the oldest first
    std::size_t endingCount_ = 0;
    RenderSettings newSettings_;
    bool isStartRequested_ = false;
    int startedRuns_ = 0;
    std::uint64_t delayedBlocks_ = 0, endedLateEvents_ = 0;
    std::int64_t endedStalledNs_ = 0;
    std::uint64_t steppedBlocks_ = 0;

    std::optional<juce::SharedResourcePointer<Stepper>> stepper_; // while prepared
    std::thread builder_;
};

} // namespace physvib
