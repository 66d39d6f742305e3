// SPDX-License-Identifier: GPL-3.0-or-later
// The guard itself: seven planted faults, each found by name.
#include "Realtime/RealtimeGuard.h"
#include <atomic>
#include <gtest/gtest.h>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <unistd.h>

namespace physvib::test {
namespace {

template <class Fault>
void expectFound(RealtimeGuard::Offence offence, Fault fault) {
    RealtimeGuard::forget();
    fault();
    EXPECT_EQ(RealtimeGuard::total(), 0u) << "not guarded";
    {
        const RealtimeGuard guard;
        fault();
    }
    EXPECT_GT(RealtimeGuard::count(offence), 0u) << RealtimeGuard::names[offence];
}

TEST(RealtimeGuard, FindsAnAllocationALastOwnerAMutexASystemCallAndAnException) {
    static int* volatile kept; // a compiler may remove a pair of new and delete that nobody sees
    expectFound(RealtimeGuard::allocates, [] {
        kept = new int{1};
        delete kept;
    });
    auto first = std::make_shared<int>(1), second = std::make_shared<int>(2);
    expectFound(RealtimeGuard::frees, [&] { first ? first.reset() : second.reset(); });
    std::mutex mutex;
    expectFound(RealtimeGuard::locks, [&] { const std::lock_guard lock{mutex}; });
    expectFound(RealtimeGuard::writes, [] { EXPECT_EQ(::write(STDOUT_FILENO, "", 0), 0); });
    expectFound(RealtimeGuard::throws, [] {
        try {
            throw std::runtime_error{"x"};
        } catch (const std::exception&) {
        }
    });
}

TEST(RealtimeGuard, FindsAFutex) {
    std::atomic<int> value{0};
    std::thread other;
    const auto waitForOne = [&] {
        other = std::thread{[&] {
            std::this_thread::sleep_for(std::chrono::milliseconds{20});
            value = 1;
            value.notify_all();
        }};
        {
            const RealtimeGuard guard;
            value.wait(0);
        }
        other.join();
    };
    RealtimeGuard::forget();
    for (int i = 0; i < 50 && RealtimeGuard::count(RealtimeGuard::callsSystem) == 0; ++i)
        waitForOne(); // on a busy machine the value may be there before anybody waits
    EXPECT_GT(RealtimeGuard::count(RealtimeGuard::callsSystem), 0u);
}

template <int N>
int lazy() {
    static const int value = static_cast<int>(getpid()) + N;
    return value;
}

TEST(RealtimeGuard, FindsALazyStatic) {
    RealtimeGuard::forget();
    {
        const RealtimeGuard guard;
        EXPECT_NE(lazy<1>(), 0);
    }
    EXPECT_GT(RealtimeGuard::count(RealtimeGuard::initialisesStatic), 0u);
}

} // namespace
} // namespace physvib::test
