// SPDX-License-Identifier: GPL-3.0-or-later
// The thread that steps the physics worlds of all plug-in instances in the process.
#pragma once
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <juce_core/juce_core.h>
#include <mutex>
#include <vector>

namespace physvib {

/// Who wants to be stepped.
class Stepped {
public:
    virtual void tick() = 0;                         ///< on the stepping thread
    virtual int ticksPerSecond() const noexcept = 0; ///< while blocks are rendered. Any thread
    virtual double idleSeconds() const noexcept = 0; ///< between two ticks while none is: the first block may
                                                     ///< have to wait so long. Any thread
    virtual std::uint64_t blocks() const noexcept = 0; ///< rendered so far. Any thread

protected:
    ~Stepped() = default;
};

/// Runs while there is anybody to step, and comes seldom to who renders nothing. A
/// juce::SharedResourcePointer holds it: the last one ends the thread.
class Stepper final : private juce::Thread {
public:
    Stepper();
    ~Stepper() override;

    /// Any thread but R; remove() returns when that one is not being stepped any more.
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

} // namespace physvib
