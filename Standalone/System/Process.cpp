// SPDX-License-Identifier: GPL-3.0-or-later
// Ends the program: by a signal, after all its output was written, or from a thread when it hangs.
#include "System/Process.h"
#include "Io/Disk/SystemFile.h"
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <system_error>
#include <thread>

namespace physvib {

void endBySignal(int signal) {
    removeAllOnEnd();
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}

void endAtOnce(int exitCode) {
    std::cout.flush();
    std::fflush(nullptr);
    removeAllOnEnd();
    std::_Exit(exitCode);
}

std::string outputFault() {
    constexpr const char* fault = "standard output: cannot be written";
    errno = 0;
    std::cout.flush();
    if (const auto why = finishOutput()) return why->empty() ? "" : std::string(fault) + ": " + *why;
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good()) return {};
    return fault + (errno == 0 ? std::string{} : ": " + std::generic_category().message(errno));
}

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
