// SPDX-License-Identifier: GPL-3.0-or-later
// A JACK server without hardware for one test, which may kill it and start it again.
#pragma once
#include "Live/Devices/JackDevice.h"
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <string>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace physvib::test {

/// Its name goes with the process, so that tests run beside each other.
class JackServer {
public:
    JackServer() {
        setenv("JACK_DEFAULT_SERVER", ("physvib-" + std::to_string(getpid())).c_str(), 1);
        setenv("JACK_NO_AUDIO_RESERVATION", "1", 1);
    }
    /// A killed server keeps its place among the eight of a machine until one of its name ends by itself.
    ~JackServer() {
        if (wasKilled_ && process_ == 0) start(48000, 256, 2);
        end(SIGTERM);
    }
    JackServer(const JackServer&) = delete;
    JackServer& operator=(const JackServer&) = delete;

    /// False: it cannot be started here.
    bool start(int rateHz, int blockFrames, int outputs) {
        const std::string name = std::getenv("JACK_DEFAULT_SERVER");
        process_ = fork();
        if (process_ == 0) {
            prctl(PR_SET_PDEATHSIG, SIGTERM);
            const int null = open("/dev/null", O_WRONLY);
            dup2(null, STDOUT_FILENO);
            dup2(null, STDERR_FILENO);
            execlp("jackd", "jackd", "-n", name.c_str(), "-r", "-S", "-d", "dummy", "-r",
                   std::to_string(rateHz).c_str(), "-p", std::to_string(blockFrames).c_str(), "-C", "0", "-P",
                   std::to_string(outputs).c_str(), nullptr);
            _exit(127);
        }
        for (int i = 0; i < 1000; ++i) {
            std::this_thread::sleep_for(std::chrono::milliseconds{10});
            if (JackClient{*jackLibrary(), "waits"}.isAlive()) return true;
        }
        return false;
    }
    void end(int signal) {
        if (process_ == 0) return;
        kill(process_, signal);
        waitpid(process_, nullptr, 0);
        process_ = 0;
        wasKilled_ = signal == SIGKILL;
    }

private:
    pid_t process_ = 0;
    bool wasKilled_ = false;
};

} // namespace physvib::test
