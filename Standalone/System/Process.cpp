// SPDX-License-Identifier: GPL-3.0-or-later
// Ends the program: by a signal, with an exit code, or from a thread if it does not end after an interrupt;
// and checks that all output was written.
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

void terminateBySignal(int signal) {
    removeFilesOnSignal();
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}

void exitImmediately(int exitCode) {
    std::cout.flush();
    std::fflush(nullptr);
    removeFilesOnSignal();
    std::_Exit(exitCode);
}

std::string outputError() {
    constexpr const char* message = "standard output: cannot be written";
    errno = 0;
    std::cout.flush();
    if (const auto reason = finishOutput())
        return reason->empty() ? "" : std::string(message) + ": " + *reason;
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good()) return {};
    return message + (errno == 0 ? std::string{} : ": " + std::generic_category().message(errno));
}

namespace {

using namespace std::chrono_literals;

constexpr std::chrono::milliseconds exitTimeout = 800ms;

std::atomic<int> firstSignal{0};
static_assert(std::atomic<int>::is_always_lock_free, "a signal may set it");

void interrupt(int signal) {
    if (interrupted.exchange(true)) terminateBySignal(signal);
    firstSignal = signal;
    firstSignal.notify_all(); // safe in a handler, because the atomic has no lock
}

// Ends the program some time after the first signal. Runs in a thread, because not every system has alarm().
void endIfHanging() {
    firstSignal.wait(0);
    std::this_thread::sleep_for(exitTimeout);
    terminateBySignal(firstSignal);
}

} // namespace

void installInterruptHandlers() {
    handleEndingSignals(interrupt, IgnoredSignals::hangUp); // also handles SIGINT, which background jobs
                                                            // of scripts ignore by default
    ignoreLostReader();
    static std::atomic<bool> isWatched{false};
    if (!isWatched.exchange(true)) std::thread{endIfHanging}.detach(); // runs until the program ends
}

} // namespace physvib
