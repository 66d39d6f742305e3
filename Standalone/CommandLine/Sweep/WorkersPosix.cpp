// SPDX-License-Identifier: GPL-3.0-or-later
// POSIX: one counter in shared memory says what comes next; one pipe, whose writes are whole, brings what
// became of it.
#if !defined(_WIN32)
#include "CommandLine/Sweep/Workers.h"
#include "System/Process.h"
#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <iostream>
#include <new>
#include <sys/mman.h>
#include <sys/wait.h>
#include <system_error>
#include <type_traits>
#include <unistd.h>
#include <vector>

namespace physvib {
namespace {

static_assert(sizeof(WorkEnd) <= PIPE_BUF && std::is_trivially_copyable_v<WorkEnd>);
static_assert(std::atomic<std::uint64_t>::is_always_lock_free, "between processes");

constexpr std::size_t maxWorkers = 1024;

/// What all processes see.
struct Board {
    std::atomic<std::uint64_t> next{0};
    std::array<std::atomic<std::uint64_t>, maxWorkers> at{}; ///< what a worker is at, from 1; 0: nothing
};

[[noreturn]] void failAs(const char* what) { throw std::system_error{errno, std::generic_category(), what}; }

class SharedBoard {
public:
    SharedBoard()
        : memory_{mmap(nullptr, sizeof(Board), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)} {
        if (memory_ == MAP_FAILED) failAs("shared memory");
        board_ = new (memory_) Board;
    }
    ~SharedBoard() { munmap(memory_, sizeof(Board)); }
    SharedBoard(const SharedBoard&) = delete;
    SharedBoard& operator=(const SharedBoard&) = delete;
    Board* operator->() const { return board_; }

private:
    void* memory_;
    Board* board_ = nullptr;
};

std::array<std::atomic<pid_t>, maxWorkers> running{}; ///< children, 0: none; of this process
static_assert(std::atomic<pid_t>::is_always_lock_free, "a signal reads it");

// A signal to this process alone is one to its workers as well.
void endWithWorkers(int signal) {
    for (const auto& child : running)
        if (const pid_t process = child; process > 0) kill(process, signal);
    endBySignal(signal);
}

/// In a process of its own, until there is nothing left, or nobody listens.
[[noreturn]] void workOn(Board& board, std::size_t worker, std::uint64_t count, const Work& work, int pipe) {
    for (;;) {
        const std::uint64_t index = board.next.fetch_add(1);
        if (index >= count) std::_Exit(0); // nothing of the parent's is ended twice
        board.at[worker] = index + 1;
        const WorkEnd end = WorkEnd::of(work, index);
        if (write(pipe, &end, sizeof end) != static_cast<ssize_t>(sizeof end)) std::_Exit(1);
        board.at[worker] = 0;
    }
}

void hearAll(int pipe, const std::function<void(const WorkEnd&)>& hear) {
    for (WorkEnd end;;) {
        const ssize_t bytes = read(pipe, &end, sizeof end);
        if (bytes == static_cast<ssize_t>(sizeof end))
            hear(end);
        else if (bytes >= 0 || errno != EINTR)
            return;
    }
}

/// One set of workers, to the end of the last.
void shareOnce(std::size_t workers, SharedBoard& board, std::uint64_t count, const Work& work,
               const std::function<void(const WorkEnd&)>& hear) {
    int ends[2];
    if (pipe(ends) != 0) failAs("a pipe");
    std::cout.flush();
    std::vector<pid_t> children;
    catchEnding(endWithWorkers, KeepIgnored::all);
    for (std::size_t w = 0; w < workers; ++w) {
        board->at[w] = 0;
        const pid_t child = fork();
        if (child == 0) {
            catchEnding(endBySignal, KeepIgnored::all);
            close(ends[0]);
            workOn(*board.operator->(), w, count, work, ends[1]);
        }
        if (child > 0)
            children.push_back(child), running[w] = child;
        else if (w == 0)
            failAs("a process");
    }
    close(ends[1]);
    hearAll(ends[0], hear);
    close(ends[0]);
    for (std::size_t w = 0; w < children.size(); ++w) {
        int status = 0;
        while (waitpid(children[w], &status, 0) < 0 && errno == EINTR) {
        }
        running[w] = 0;
        if (const std::uint64_t at = board->at[w]; at > 0)
            hear(WorkEnd::failedAt(at - 1, WIFSIGNALED(status) ? "its process was ended by signal " +
                                                                     std::to_string(WTERMSIG(status))
                                                               : "its process ended"));
    }
}

} // namespace

void shareWork(int jobs, std::uint64_t count, const Work& work,
               const std::function<void(const WorkEnd&)>& hear) {
    SharedBoard board;
    while (board->next < count) // again, where every worker was ended
        shareOnce(static_cast<std::size_t>(
                      std::min<std::uint64_t>({static_cast<std::uint64_t>(jobs), count, maxWorkers})),
                  board, count, work, hear);
}

} // namespace physvib
#endif
