// SPDX-License-Identifier: GPL-3.0-or-later
// Schedules the worlds by deadline; the thread sleeps until the first one.
#include "Stepper.h"
#include <algorithm>

namespace physvib {

// Above all that is not audio, below what is: few users are allowed that.
Stepper::Stepper()
    : Thread{"PhysVib worlds"} {
#if JUCE_MAJOR_VERSION >= 8
    const auto lowest = RealtimeOptions{}.withPriority(1);
#else
    const RealtimeOptions lowest{1, 0};
#endif
    if (!startRealtimeThread(lowest)) startThread(Priority::highest);
}

Stepper::~Stepper() {
    signalThreadShouldExit();
    wake();
    stopThread(-1);
}

void Stepper::wake() {
    { const std::lock_guard lock{mutex_}; } // or it would sleep through it
    changed_.notify_all();
}

void Stepper::add(Stepped& one) {
    {
        const std::lock_guard lock{mutex_};
        members_.push_back({&one, one.blocks(), Clock::now(), {}});
    }
    changed_.notify_all();
}

void Stepper::remove(Stepped& one) {
    const std::lock_guard lock{mutex_};
    std::erase_if(members_, [&](const Member& member) { return member.one == &one; });
}

// At multiples of its period, so that those of equal ones come in one waking, and none comes in a burst after
// a stall.
void Stepper::tick(Member& member, Clock::time_point now) {
    if (now < member.next) return;
    member.one->tick();
    if (const auto blocks = member.one->blocks(); blocks != member.blocks) {
        member.blocks = blocks;
        member.lastBlock = now;
    }
    const double seconds =
        now - member.lastBlock > restsAfter ? member.one->idleSeconds() : 1.0 / member.one->ticksPerSecond();
    const auto period = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>{seconds});
    member.next = Clock::time_point{(now.time_since_epoch() / period + 1) * period};
}

void Stepper::run() {
    std::unique_lock lock{mutex_};
    while (!threadShouldExit()) {
        const auto now = Clock::now();
        auto next = Clock::time_point::max();
        for (Member& member : members_) {
            tick(member, now);
            next = std::min(next, member.next);
        }
        if (members_.empty())
            changed_.wait(lock);
        else
            changed_.wait_until(lock, next);
        wakeUps_.fetch_add(1, std::memory_order_relaxed);
    }
}

} // namespace physvib
