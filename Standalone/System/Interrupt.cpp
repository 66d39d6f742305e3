// SPDX-License-Identifier: GPL-3.0-or-later
// What a signal sets, and a thread that ends what hangs.
#include "System/Interrupt.h"
#include "System/Process.h"
#include <chrono>
#include <thread>

namespace physvib {

namespace {

using namespace std::chrono_literals;

constexpr std::chrono::milliseconds patience = 800ms, patienceForFiles = 3s, pause = 20ms;

std::atomic<int> firstSignal{0}, promised{0}, finishing{0};
static_assert(std::atomic<int>::is_always_lock_free, "a signal may set it");

void interrupt(int signal) {
    if (interrupted.exchange(true)) endBySignal(signal);
    firstSignal = signal;
}

// A thread and not an alarm, so that it is the same on every system.
void endWhatHangs() {
    while (firstSignal == 0) std::this_thread::sleep_for(pause);
    std::this_thread::sleep_for(patience);
    for (auto waited = 0ms; waited < patienceForFiles && promised > 0; waited += pause)
        std::this_thread::sleep_for(pause);
    while (finishing > 0) std::this_thread::sleep_for(pause);
    endBySignal(firstSignal);
}

} // namespace

FilesFirst::FilesFirst() noexcept {
    ++promised;
}

FilesFirst::~FilesFirst() {
    --promised;
    if (isFinishing_) --finishing;
}

void FilesFirst::finish() noexcept {
    if (!isFinishing_) ++finishing;
    isFinishing_ = true;
}

void heedInterrupts() {
    catchEnding(interrupt, KeepIgnored::hangUp); // a script's background ignores SIGINT, and yet means it
    ignoreLostReader();
    static std::atomic<bool> isWatched{false};
    if (!isWatched.exchange(true)) std::thread{endWhatHangs}.detach(); // it lives as long as the program
}

} // namespace physvib
