// SPDX-License-Identifier: MIT
// State of an output device for the sinks that follow it (pauses, mute requests, output time, level), and the
// tools of such sinks: an estimate of when a session time is felt (SessionClock), and restarts.
#pragma once
#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace physvib {

// Tells whether the device that plays a session asks for blocks. While it does not, session time stands still
// and events are dropped and counted, because they would all be felt at once when the device returns.

/// A time of the steady clock, in nanoseconds.
inline std::int64_t
steadyNs(std::chrono::steady_clock::time_point time = std::chrono::steady_clock::now()) noexcept {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(time.time_since_epoch()).count();
}

/// Detects and counts pauses of a device, and the events that they drop. Times are steadyNs().
class DevicePulse {
public:
    static constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();
    static constexpr std::int64_t goneAfterNs = 2'000'000'000; ///< a device that pauses longer counts as gone

    /// The longest pause of a device that runs, in blocks of `blockNs`: three of them, and at least 100 ms.
    static constexpr std::int64_t maxPauseNs(std::int64_t blockNs) noexcept {
        return 3 * blockNs > 100'000'000 ? 3 * blockNs : 100'000'000;
    }

    /// Call when a device starts. Pauses above `maxPauseNs` count; `never`: none. The first device may take
    /// goneAfterNs until its first block. Message thread (M), while the render thread (R) does not run.
    void begin(std::int64_t maxPauseNs, std::int64_t nowNs) noexcept {
        maxPauseNs_.store(maxPauseNs, std::memory_order_relaxed);
        if (lastNs_.load(std::memory_order_relaxed) == never)
            lastNs_.store(nowNs + goneAfterNs, std::memory_order_release);
    }

    /// Tells which waiting events are dropped when a device returns: those up to a session time, or all after
    /// a pause so long that the device counts as gone.
    struct PauseHistory {
        std::uint64_t pauses = 0, losses = 0; ///< pauses that have ended; those after which it counts as gone
        std::int64_t untilNs = 0;             ///< session time at the end of the last pause
    };
    /// Call when the first block after a pause begins, at session time `sessionNs`. Returns whether the
    /// device was gone. R, wait-free.
    bool endPause(std::int64_t nowNs, std::int64_t sessionNs) noexcept {
        const bool wasGone = nowNs - lastNs_.load(std::memory_order_relaxed) > goneAfterNs;
        untilNs_.store(sessionNs, std::memory_order_relaxed);
        losses_.fetch_add(wasGone ? 1 : 0, std::memory_order_relaxed);
        pauses_.fetch_add(1, std::memory_order_release);
        return wasGone;
    }
    /// Call when a block that began at `nowNs` has been rendered: the device runs. R, wait-free.
    void blockRendered(std::int64_t nowNs) noexcept { lastNs_.store(nowNs, std::memory_order_release); }
    /// Start of the last block, from blockRendered(); a time in the far future before the first. Any thread.
    std::int64_t lastNs() const noexcept {
        return std::min(lastNs_.load(std::memory_order_acquire), never / 2);
    }
    /// Call when the device is closed and no other opened: an endless pause begins. M, while R does not run.
    void end() noexcept { maxPauseNs_.store(0, std::memory_order_relaxed); }

    /// Whether the device pauses. False before the first begin(): the session has no device. Any thread.
    bool isPaused(std::int64_t nowNs) const noexcept {
        const std::int64_t last = lastNs_.load(std::memory_order_acquire),
                           limit = maxPauseNs_.load(std::memory_order_relaxed);
        return last != never && limit != never && nowNs - last > limit;
    }

    /// The pauses that have ended. Any thread, wait-free.
    PauseHistory history() const noexcept {
        const std::uint64_t pauses = pauses_.load(std::memory_order_acquire);
        return {pauses, losses_.load(std::memory_order_relaxed), untilNs_.load(std::memory_order_relaxed)};
    }

    /// Counts events that are not played. Any thread, wait-free, as dropIfPaused() and dropped().
    void drop(std::uint64_t events) noexcept { dropped_.fetch_add(events, std::memory_order_relaxed); }
    /// True, and these events are counted as dropped, while the device pauses.
    bool dropIfPaused(std::uint64_t events) noexcept {
        if (!isPaused(steadyNs())) return false;
        drop(events);
        return true;
    }
    std::uint64_t dropped() const noexcept { return dropped_.load(std::memory_order_relaxed); }

    /// The error of an input that is dropped.
    static constexpr const char* droppedError = "no device runs: dropped";

private:
    std::atomic<std::int64_t> lastNs_{never}, maxPauseNs_{never};
    std::atomic<std::int64_t> untilNs_{0};
    std::atomic<std::uint64_t> pauses_{0}, losses_{0}, dropped_{0};
};

// Requests for silence, counted per input: an output sounds only while no input requests silence.

/// The inputs that can request silence. machine: the user here, by Esc, a button or the program's own call.
enum class MuteRequester : std::size_t { machine, standardInput, osc };

/// Counts requests and withdrawals per input, so that a delayed "off" does not withdraw a newer request. Any
/// thread, lock-free.
class MuteRequests {
public:
    /// Requests silence; returns the number of the request: 1 for the first of `input`.
    std::uint64_t request(MuteRequester input) noexcept { return entry(input).requested.fetch_add(1) + 1; }

    /// Requests silence with a number that the input gave; repeating it changes nothing.
    void request(MuteRequester input, std::uint64_t number) noexcept {
        raiseTo(entry(input).requested, number);
    }

    /// How many times `input` has requested silence.
    std::uint64_t requestCount(MuteRequester input) const noexcept { return entry(input).requested.load(); }

    /// Withdraws the requests of `input` up to that number.
    void withdraw(MuteRequester input, std::uint64_t number) noexcept {
        raiseTo(entry(input).withdrawn, std::min(number, requestCount(input)));
    }

    /// Withdraws all requests of all inputs: only for the machine.
    void withdrawAll() noexcept {
        for (Requests& row : requests_) raiseTo(row.withdrawn, row.requested.load());
    }

    bool isRequestedBy(MuteRequester input) const noexcept { return entry(input).isPending(); }

    /// Wait-free.
    bool isSilent() const noexcept { return std::ranges::any_of(requests_, &Requests::isPending); }

private:
    using Number = std::atomic<std::uint64_t>;
    static_assert(Number::is_always_lock_free);

    struct Requests {
        Number requested{0}, withdrawn{0};
        bool isPending() const noexcept {
            const std::uint64_t ended = withdrawn.load(); // read first, so that it never exceeds `requested`
            return requested.load() > ended;
        }
    };
    Requests& entry(MuteRequester input) noexcept { return requests_[static_cast<std::size_t>(input)]; }
    const Requests& entry(MuteRequester input) const noexcept {
        return requests_[static_cast<std::size_t>(input)];
    }
    static void raiseTo(Number& number, std::uint64_t bound) noexcept {
        for (std::uint64_t now = number.load(); now < bound && !number.compare_exchange_weak(now, bound);) {
        }
    }

    std::array<Requests, 3> requests_;
};

/// An event of session time `sessionNs` is felt at `steadyNs` of the steady clock.
struct OutputMoment {
    std::int64_t sessionNs = 0, steadyNs = 0;
    std::int64_t lagNs = 0; ///< output latency plus the device's own latency
    int sampleRateHz = 0;   ///< of the block
};

/// Time, master level and silence of an output device, for the sinks that follow it.
class OutputClock {
public:
    /// While `isEnded` (may be null; outlives this object) is true, the output is silent. Message thread (M).
    explicit OutputClock(const std::atomic<bool>* isEnded = nullptr)
        : isEnded_{isEnded} {}

    /// The moment of the newest block; {} before the first. Any thread but the render thread (R).
    OutputMoment latestMoment() const noexcept {
        for (;;) {
            const auto count = writes_.load(std::memory_order_acquire);
            const OutputMoment moment{
                sessionNs_.load(std::memory_order_acquire), steadyNs_.load(std::memory_order_acquire),
                lagNs_.load(std::memory_order_acquire), sampleRateHz_.load(std::memory_order_acquire)};
            if (count % 2 == 0 && writes_.load(std::memory_order_relaxed) == count) return moment;
        }
    }

    /// Master level, a gain from 0 to 1. Any thread, wait-free, as the methods up to setSilent().
    float level() const noexcept { return level_.load(std::memory_order_relaxed); }
    void setLevel(float level) noexcept {
        level_.store(level > 0.0f ? std::min(level, 1.0f) : 0.0f, std::memory_order_relaxed);
    }

    /// True if the output is muted, whatever the level.
    bool isSilent() const noexcept {
        return silence_.isSilent() || (isEnded_ && isEnded_->load(std::memory_order_relaxed));
    }
    /// The requests for silence by input.
    MuteRequests& silence() noexcept { return silence_; }
    /// The user's choice at this computer: silent within a block, or, regardless of all requests for silence,
    /// sounding again in a ramp.
    void setSilent(bool silent) noexcept {
        silent ? void(silence_.request(MuteRequester::machine)) : silence_.withdrawAll();
    }

protected:
    ~OutputClock() = default;

    /// Publishes the moment of a block for latestMoment(). R, wait-free.
    void publish(const OutputMoment& moment) noexcept {
        const auto count = writes_.load(std::memory_order_relaxed);
        writes_.store(count + 1, std::memory_order_relaxed);
        sessionNs_.store(moment.sessionNs, std::memory_order_release);
        steadyNs_.store(moment.steadyNs, std::memory_order_release);
        lagNs_.store(moment.lagNs, std::memory_order_release);
        sampleRateHz_.store(moment.sampleRateHz, std::memory_order_release);
        writes_.store(count + 2, std::memory_order_release);
    }

private:
    const std::atomic<bool>* const isEnded_;
    MuteRequests silence_;
    std::atomic<float> level_{0.0f};
    // A seqlock for any number of readers: the count is odd during a write; a reader repeats if it changed.
    std::atomic<std::uint64_t> writes_{0};
    std::atomic<std::int64_t> sessionNs_{0}, steadyNs_{0}, lagNs_{0};
    std::atomic<int> sampleRateHz_{0};
};

// Estimates when a session time is felt, on the computer's steady clock, from when a device requests blocks.
//
// A driver requests a block when there is room for it: never earlier, often a little later. So the earliest
// of the recent requests, relative to the time that it requested, represents the device's clock; a mean would
// lag by the computer's load. The window is a quarter to half a second: 300 ppm of drift are then at most
// 0.15 ms.

/// Converts session time to the steady time at which it is felt. One thread.
class SessionClock {
public:
    static constexpr std::int64_t halfWindowNs = 250'000'000, pauseNs = 80'000'000;

    /// Adds the moments in time order; a repeated moment changes nothing.
    void add(const OutputMoment& moment) noexcept {
        const std::int64_t lag = moment.steadyNs - moment.sessionNs,
                           age = moment.steadyNs - halfWindowStartNs_;
        // the first, or the first after a pause, in which session time stood still
        if (!isReady_ || age > 2 * halfWindowNs || lag - std::min(previousLagNs_, currentLagNs_) > pauseNs)
            previousLagNs_ = currentLagNs_ = lag;
        if (!isReady_ || age > halfWindowNs) {
            previousLagNs_ = currentLagNs_;
            currentLagNs_ = lag;
            halfWindowStartNs_ = moment.steadyNs;
        }
        currentLagNs_ = std::min(currentLagNs_, lag);
        isReady_ = true;
    }

    bool isReady() const noexcept { return isReady_; }

    /// Steady time at which `sessionNs` is felt; only if ready.
    std::int64_t steadyAt(std::int64_t sessionNs) const noexcept {
        return sessionNs + std::min(previousLagNs_, currentLagNs_);
    }

private:
    std::int64_t previousLagNs_ = 0, currentLagNs_ = 0; // smallest lag of the last half window and of the
                                                        // current one
    std::int64_t halfWindowStartNs_ = 0;
    bool isReady_ = false;
};

/// The device that a sink with a thread of its own follows. `mutex` guards what that thread and M share.
/// Callers hold it, except for members that lock it themselves ("Locks.").
class FollowedDevice {
public:
    mutable std::mutex mutex;

    /// Locks. Unless that device is followed already, calls `change()`; then M waits, briefly, until the
    /// thread has stopped its output or `isOver()`.
    void follow(OutputClock* device, auto change, auto isOver) {
        std::unique_lock lock{mutex};
        if (device == device_) return;
        device_ = device;
        clock_ = {};
        change();
        needsRestart_ = true;
        outputStopped_.wait_for(lock, maxStopWait, [&] { return !needsRestart_ || isOver(); });
    }
    /// Locks. On the sink's thread: if the device has changed, ends the output (`stopOutput()`) without it,
    /// then calls `begin()` with it.
    void restartIfChanged(auto stopOutput, auto begin) {
        std::unique_lock lock{mutex};
        if (!needsRestart_) return;
        lock.unlock();
        stopOutput();
        lock.lock();
        begin();
        playedNs_ = 0;
        needsRestart_ = false;
        outputStopped_.notify_all();
    }
    /// On the sink's thread: the session time felt at `nowNs`, if known; calls `begin()` if it went back.
    std::optional<std::int64_t> sessionNs(std::int64_t nowNs, auto begin) {
        if (device_ == nullptr || needsRestart_) return {};
        if (const OutputMoment moment = device_->latestMoment(); moment.steadyNs != 0) clock_.add(moment);
        if (!clock_.isReady()) return {};
        const std::int64_t sessionNs = nowNs - clock_.steadyAt(0);
        if (sessionNs + minBackwardJumpNs < playedNs_) begin();
        return playedNs_ = sessionNs;
    }
    float level() const { return device_->isSilent() ? 0.0f : device_->level(); } ///< 0: silent
    /// Locks. Waits until `isReady()`, for `timeOutNs` at most and while `keepGoing()`; returns `error()`.
    std::string await(std::int64_t timeOutNs, const std::function<bool()>& keepGoing, auto isReady,
                      auto error) const {
        const std::int64_t endNs = steadyNs() + timeOutNs;
        for (;; std::this_thread::sleep_for(std::chrono::milliseconds{5})) {
            const std::lock_guard lock{mutex};
            if (isReady() || !keepGoing() || steadyNs() > endNs) return error();
        }
    }

private:
    static constexpr std::int64_t minBackwardJumpNs = 70'000'000; // backwards: a pause or a restart
    static constexpr std::chrono::milliseconds maxStopWait{250};

    std::condition_variable outputStopped_;
    OutputClock* device_ = nullptr;
    bool needsRestart_ = false;
    SessionClock clock_;
    std::int64_t playedNs_ = 0; // session time
};

} // namespace physvib
