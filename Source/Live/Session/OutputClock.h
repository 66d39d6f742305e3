// SPDX-License-Identifier: MIT
// State of an output device for the sinks that follow it: pauses, mute requests, output time and level; and
// how a sink follows it: an estimate of when a session time is felt, and restarts.
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
steadyNs(std::chrono::steady_clock::time_point at = std::chrono::steady_clock::now()) noexcept {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(at.time_since_epoch()).count();
}

/// Times are steadyNs().
class DevicePulse {
public:
    static constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();
    static constexpr std::int64_t goneNs = 2'000'000'000; ///< a device that pauses longer counts as gone

    /// The longest pause of a device that runs, in blocks of `blockNs`: three of them, and at least 100 ms.
    static constexpr std::int64_t limitNs(std::int64_t blockNs) noexcept {
        return 3 * blockNs > 100'000'000 ? 3 * blockNs : 100'000'000;
    }

    /// A device starts; a pause of more than `limitNs` counts, with `never` none does. The first device has
    /// goneNs until its first block. Message thread (M), while the render thread (R) does not run.
    void begin(std::int64_t limitNs, std::int64_t nowNs) noexcept {
        limitNs_.store(limitNs, std::memory_order_relaxed);
        if (lastNs_.load(std::memory_order_relaxed) == never)
            lastNs_.store(nowNs + goneNs, std::memory_order_release);
    }

    /// Tells which waiting events are dropped when a device returns: those up to a session time, or all after
    /// a pause so long that the device counts as gone.
    struct Return {
        std::uint64_t pauses = 0, losses = 0; ///< ended so far; losses: the long ones
        std::int64_t untilNs = 0;             ///< of the last pause
    };
    /// The first block after a pause begins, at session time `sessionNs`. Returns whether the device was
    /// gone. R, wait-free.
    bool comeBack(std::int64_t nowNs, std::int64_t sessionNs) noexcept {
        const bool wasGone = nowNs - lastNs_.load(std::memory_order_relaxed) > goneNs;
        untilNs_.store(sessionNs, std::memory_order_relaxed);
        losses_.fetch_add(wasGone ? 1 : 0, std::memory_order_relaxed);
        pauses_.fetch_add(1, std::memory_order_release);
        return wasGone;
    }
    /// A block that began at `nowNs` has been rendered: from now on the device runs. R, wait-free.
    void beat(std::int64_t nowNs) noexcept { lastNs_.store(nowNs, std::memory_order_release); }
    /// Start of the last block, from beat(); a time in the far future before the first. Any thread.
    std::int64_t lastNs() const noexcept {
        return std::min(lastNs_.load(std::memory_order_acquire), never / 2);
    }
    /// Call when the device is closed and no other opened: an endless pause begins. M, while R does not run.
    void end() noexcept { limitNs_.store(0, std::memory_order_relaxed); }

    /// Whether the device pauses. False before the first begin(): the session has no device. Any thread.
    bool isStill(std::int64_t nowNs) const noexcept {
        const std::int64_t last = lastNs_.load(std::memory_order_acquire),
                           limit = limitNs_.load(std::memory_order_relaxed);
        return last != never && limit != never && nowNs - last > limit;
    }

    /// Any thread, wait-free.
    Return returns() const noexcept {
        const std::uint64_t pauses = pauses_.load(std::memory_order_acquire);
        return {pauses, losses_.load(std::memory_order_relaxed), untilNs_.load(std::memory_order_relaxed)};
    }

    /// Counts events that are not played. Any thread, wait-free, as the next ones.
    void drop(std::uint64_t events) noexcept { dropped_.fetch_add(events, std::memory_order_relaxed); }
    /// True, and these events are counted as dropped, while the device pauses.
    bool dropsNow(std::uint64_t events) noexcept {
        if (!isStill(steadyNs())) return false;
        drop(events);
        return true;
    }
    std::uint64_t dropped() const noexcept { return dropped_.load(std::memory_order_relaxed); }

    /// The error of an input that is dropped.
    static constexpr const char* refusal = "no device runs: dropped";

private:
    std::atomic<std::int64_t> lastNs_{never}, limitNs_{never};
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
    /// Requests silence; returns the number of the request: 1 for the first of `holder`.
    std::uint64_t request(MuteRequester holder) noexcept { return of(holder).asked.fetch_add(1) + 1; }

    /// Requests silence with a number that the input gave; repeating it changes nothing.
    void request(MuteRequester holder, std::uint64_t number) noexcept { raise(of(holder).asked, number); }

    /// How many times `holder` has requested silence.
    std::uint64_t asked(MuteRequester holder) const noexcept { return of(holder).asked.load(); }

    /// Withdraws the requests of `holder` up to that number.
    void lift(MuteRequester holder, std::uint64_t number) noexcept {
        raise(of(holder).lifted, std::min(number, asked(holder)));
    }

    /// Withdraws all requests of all inputs: only for the machine.
    void liftAll() noexcept {
        for (Requests& all : requests_) raise(all.lifted, all.asked.load());
    }

    bool isHeldBy(MuteRequester holder) const noexcept { return of(holder).isHeld(); }

    /// Wait-free.
    bool isSilent() const noexcept { return std::ranges::any_of(requests_, &Requests::isHeld); }

private:
    using Number = std::atomic<std::uint64_t>;
    static_assert(Number::is_always_lock_free);

    struct Requests {
        Number asked{0}, lifted{0};
        bool isHeld() const noexcept {
            const std::uint64_t until = lifted.load(); // read first, so that it never exceeds `asked`
            return asked.load() > until;
        }
    };
    Requests& of(MuteRequester holder) noexcept { return requests_[static_cast<std::size_t>(holder)]; }
    const Requests& of(MuteRequester holder) const noexcept {
        return requests_[static_cast<std::size_t>(holder)];
    }
    static void raise(Number& number, std::uint64_t least) noexcept {
        for (std::uint64_t now = number.load(); now < least && !number.compare_exchange_weak(now, least);) {
        }
    }

    std::array<Requests, 3> requests_;
};

/// An event of session time `sessionNs` is felt at `steadyNs` of the steady clock.
struct OutputMoment {
    std::int64_t sessionNs = 0, steadyNs = 0;
    std::int64_t behindNs = 0; ///< lag of the felt time: output latency plus the device's own
    int sampleRateHz = 0;      ///< of the block
};

class OutputClock {
public:
    /// `isEnded`, if given, outlives it: while it is true, the output is silent. Message thread (M).
    explicit OutputClock(const std::atomic<bool>* isEnded = nullptr)
        : isEnded_{isEnded} {}

    /// The moment of the newest block; {} before the first. Any thread but the render thread (R).
    OutputMoment felt() const noexcept {
        for (;;) {
            const auto before = writes_.load(std::memory_order_acquire);
            const OutputMoment moment{
                sessionNs_.load(std::memory_order_acquire), steadyNs_.load(std::memory_order_acquire),
                behindNs_.load(std::memory_order_acquire), sampleRateHz_.load(std::memory_order_acquire)};
            if (before % 2 == 0 && writes_.load(std::memory_order_relaxed) == before) return moment;
        }
    }

    /// Master level, a gain from 0 to 1. Any thread, wait-free, as the next ones.
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
        silent ? void(silence_.request(MuteRequester::machine)) : silence_.liftAll();
    }

protected:
    ~OutputClock() = default;

    /// Publishes the moment of a block for felt(). R, wait-free.
    void tell(const OutputMoment& moment) noexcept {
        const auto before = writes_.load(std::memory_order_relaxed);
        writes_.store(before + 1, std::memory_order_relaxed);
        sessionNs_.store(moment.sessionNs, std::memory_order_release);
        steadyNs_.store(moment.steadyNs, std::memory_order_release);
        behindNs_.store(moment.behindNs, std::memory_order_release);
        sampleRateHz_.store(moment.sampleRateHz, std::memory_order_release);
        writes_.store(before + 2, std::memory_order_release);
    }

private:
    const std::atomic<bool>* const isEnded_;
    MuteRequests silence_;
    std::atomic<float> level_{0.0f};
    // A seqlock for any number of readers: the count is odd during a write; a reader repeats if it changed.
    std::atomic<std::uint64_t> writes_{0};
    std::atomic<std::int64_t> sessionNs_{0}, steadyNs_{0}, behindNs_{0};
    std::atomic<int> sampleRateHz_{0};
};

// Estimates when a session time is felt, on the computer's steady clock, from when a device requests blocks.
//
// A driver requests a block when there is room for it: never earlier, often a little later. So the earliest
// of the recent requests, relative to the time that it requested, represents the device's clock; a mean would
// lag by the computer's load. The window is a quarter to half a second: 300 ppm of drift are then at most
// 0.15 ms.

/// One thread.
class SessionClock {
public:
    static constexpr std::int64_t halfWindowNs = 250'000'000, pauseNs = 80'000'000;

    /// Adds the moments in time order; a repeated moment changes nothing.
    void add(const OutputMoment& moment) noexcept {
        const std::int64_t lag = moment.steadyNs - moment.sessionNs, age = moment.steadyNs - halfBeganNs_;
        // the first, or the first after a pause, in which session time stood still
        if (!isReady_ || age > 2 * halfWindowNs || lag - std::min(before_, now_) > pauseNs)
            before_ = now_ = lag;
        if (!isReady_ || age > halfWindowNs) {
            before_ = now_;
            now_ = lag;
            halfBeganNs_ = moment.steadyNs;
        }
        now_ = std::min(now_, lag);
        isReady_ = true;
    }

    bool isReady() const noexcept { return isReady_; }

    /// Steady time at which `sessionNs` is felt; only if ready.
    std::int64_t steadyAt(std::int64_t sessionNs) const noexcept {
        return sessionNs + std::min(before_, now_);
    }

private:
    std::int64_t before_ = 0, now_ = 0; // smallest lag of the last half window and of the current one
    std::int64_t halfBeganNs_ = 0;
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
        beginsAnew_ = true;
        rested_.wait_for(lock, mostRest, [&] { return !beginsAnew_ || isOver(); });
    }
    /// Locks. On the sink's thread: if the device has changed, calls `rest()` without the lock to end the
    /// output, then `begin()` with it.
    void beginAnew(auto rest, auto begin) {
        std::unique_lock lock{mutex};
        if (!beginsAnew_) return;
        lock.unlock();
        rest();
        lock.lock();
        begin();
        playedNs_ = 0;
        beginsAnew_ = false;
        rested_.notify_all();
    }
    /// On the sink's thread: the session time felt at `nowNs`, if known; calls `begin()` if it went back.
    std::optional<std::int64_t> sessionNs(std::int64_t nowNs, auto begin) {
        if (device_ == nullptr || beginsAnew_) return {};
        if (const OutputMoment felt = device_->felt(); felt.steadyNs != 0) clock_.add(felt);
        if (!clock_.isReady()) return {};
        const std::int64_t now = nowNs - clock_.steadyAt(0);
        if (now + jumpNs < playedNs_) begin();
        return playedNs_ = now;
    }
    float level() const { return device_->isSilent() ? 0.0f : device_->level(); } ///< where there is a time
    /// Locks. Waits until `isReady()`, for `patienceNs` at most and while `keepGoing()`; returns `trouble()`.
    std::string await(std::int64_t patienceNs, const std::function<bool()>& keepGoing, auto isReady,
                      auto trouble) const {
        const std::int64_t endNs = steadyNs() + patienceNs;
        for (;; std::this_thread::sleep_for(std::chrono::milliseconds{5})) {
            const std::lock_guard lock{mutex};
            if (isReady() || !keepGoing() || steadyNs() > endNs) return trouble();
        }
    }

private:
    static constexpr std::int64_t jumpNs = 70'000'000; // backwards: a pause or a restart
    static constexpr std::chrono::milliseconds mostRest{250};

    std::condition_variable rested_;
    OutputClock* device_ = nullptr;
    bool beginsAnew_ = false;
    SessionClock clock_;
    std::int64_t playedNs_ = 0; // session time
};

} // namespace physvib
