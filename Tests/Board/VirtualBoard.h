// SPDX-License-Identifier: GPL-3.0-or-later
// A virtual board in a process of its own, as a person's would be: Unicorn's licence keeps it out of this
// program.
#pragma once
#include "Live/Session/BoardLink.h"
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace physvib::test {

/// Waits until it is true; false if it is not within that time, which is far more than it needs.
inline bool comesTrue(const std::function<bool()>& isTrue, double seconds = 20) {
    for (const auto end = BoardLink::nowNs() + static_cast<std::int64_t>(seconds * 1e9);
         BoardLink::nowNs() < end;) {
        if (isTrue()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return isTrue();
}

class VirtualBoard {
public:
    VirtualBoard() {
        char name[] = "/tmp/physvib-board-XXXXXX";
        if (mkdtemp(name) == nullptr) throw std::runtime_error("no folder");
        folder_ = name;
        start();
    }
    ~VirtualBoard() {
        stop();
        std::filesystem::remove_all(folder_);
    }
    VirtualBoard(const VirtualBoard&) = delete;
    VirtualBoard& operator=(const VirtualBoard&) = delete;

    /// Stays the same whatever happens to the board.
    std::string port() const { return folder_ + "/port"; }

    void start() {
        process_ = fork();
        if (process_ == 0) {
            std::freopen((folder_ + "/out").c_str(), "w", stdout);
            std::freopen((folder_ + "/report").c_str(), "w", stderr);
            execl(PHYSVIB_VIRTUAL_BOARD, PHYSVIB_VIRTUAL_BOARD, PHYSVIB_BOARD_IMAGE, "--link", port().c_str(),
                  "--log", (folder_ + "/log").c_str(), nullptr);
            _exit(1);
        }
        if (!comesTrue([this] { return std::filesystem::exists(port()); }))
            throw std::runtime_error("the virtual board does not start");
    }

    /// Its power goes.
    void stop() {
        if (process_ <= 0) return;
        kill(process_, SIGCONT);
        kill(process_, SIGINT);
        waitpid(process_, nullptr, 0);
        process_ = 0;
    }
    void movePlug() { kill(process_, SIGUSR1); }
    void halt(bool isHalted) { kill(process_, isHalted ? SIGSTOP : SIGCONT); }

    struct Moment {
        std::int64_t steadyNs;
        std::string what;
    };
    /// What its log says so far.
    std::vector<Moment> log() const {
        std::ifstream file{folder_ + "/log"};
        std::vector<Moment> moments;
        std::string line;
        for (std::getline(file, line); std::getline(file, line);)
            if (const auto comma = line.find(','); comma != std::string::npos)
                moments.push_back({std::stoll(line), line.substr(comma + 1)});
        return moments;
    }

    /// When that happened last; 0: never.
    std::int64_t last(const std::string& what) const {
        std::int64_t at = 0;
        for (const auto& moment : log())
            if (moment.what == what) at = moment.steadyNs;
        return at;
    }

private:
    std::string folder_;
    pid_t process_ = 0;
};

} // namespace physvib::test
