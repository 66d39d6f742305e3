// SPDX-License-Identifier: GPL-3.0-or-later
// Tells by name what a guarded stretch of code does that a render role must not: allocate, free, lock, wait,
// call the system, initialise a static lazily, throw.
#pragma once
#include <array>
#include <cstdint>

namespace physvib::test {

/// While one lives, this thread is guarded; offences of all guarded threads are counted by function.
class RealtimeGuard {
public:
    RealtimeGuard() noexcept;
    ~RealtimeGuard();
    RealtimeGuard(const RealtimeGuard&) = delete;
    RealtimeGuard& operator=(const RealtimeGuard&) = delete;

    enum Offence {
        allocates,
        frees,
        locks,
        waits,
        writes,
        callsSystem,
        initialisesStatic,
        throws,
        offenceCount
    };
    static constexpr std::array<const char*, offenceCount> names{
        "malloc", "free",    "pthread_mutex_lock",  "pthread_cond_wait",
        "write",  "syscall", "__cxa_guard_acquire", "__cxa_throw"};
    static std::uint64_t count(Offence offence) noexcept;
    static std::uint64_t total() noexcept;
    static void forget() noexcept;
};

} // namespace physvib::test
