// SPDX-License-Identifier: GPL-3.0-or-later
// Signal handler, and a thread that terminates a program that hangs.
#include "System/Interrupt.h"
#include "System/Process.h"
#include <chrono>
#include <thread>

namespace physvib {

namespace {

using namespace std::chrono_literals;

constexpr std::chrono::milliseconds patience = 800ms;

std::atomic<int> firstSignal{0};
static_assert(std::atomic<int>::is_always_lock_free, "a signal may set it");

void interrupt(int signal) {
    if (interrupted.exchange(true)) endBySignal(signal);
    firstSignal = signal;
    firstSignal.notify_all(); // of an atomic without locks: safe here
}

// A thread instead of alarm(), because it works on every system.
void endWhatHangs() {
    firstSignal.wait(0);
    std::this_thread::sleep_for(patience);
    endBySignal(firstSignal);
}

} // namespace

void heedInterrupts() {
    catchEnding(interrupt, KeepIgnored::hangUp); // scripts' jobs ignore SIGINT by default: handle it still
    ignoreLostReader();
    static std::atomic<bool> isWatched{false};
    if (!isWatched.exchange(true)) std::thread{endWhatHangs}.detach(); // runs until the program ends
}

} // namespace physvib
