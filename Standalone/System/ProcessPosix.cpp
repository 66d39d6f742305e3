// SPDX-License-Identifier: GPL-3.0-or-later
// POSIX implementation: descriptors 0 to 2, signals, processes.
#if !defined(_WIN32)
#include "Io/Disk/SystemFile.h"
#include "Io/Text/CleanText.h"
#include "System/Process.h"
#include <algorithm>
#include <array>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <initializer_list>
#include <iostream>
#include <poll.h>
#include <spawn.h>
#include <sstream>
#include <sys/resource.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

extern char** environ;

namespace physvib {
namespace {

// A file opened while a standard descriptor is closed would get its number and be mistaken for it. /dev/null
// is opened in the wrong direction, so that reading standard input and writing the others still fail.
void openStandardDescriptors() {
    for (int standard = STDIN_FILENO; standard <= STDERR_FILENO; ++standard)
        if (fcntl(standard, F_GETFD) < 0 &&
            open("/dev/null", standard == STDIN_FILENO ? O_WRONLY : O_RDONLY) < 0)
            std::_Exit(1);
}

Result<pid_t> start(std::string& name, std::vector<std::string>& arguments,
                    const posix_spawn_file_actions_t* actions) {
    std::vector<char*> words{name.data()};
    for (std::string& argument : arguments) words.push_back(argument.data());
    words.push_back(nullptr);
    pid_t child = 0;
    std::cout.flush();
    if (const int fault = posix_spawnp(&child, name.c_str(), actions, nullptr, words.data(), environ))
        return Failure{name + ": " + std::generic_category().message(fault)};
    return child;
}

std::string lastLine(const std::string& text) {
    const auto end = text.find_last_not_of("\r\n ");
    if (end == std::string::npos) return {};
    const auto before = text.find_last_of("\r\n", end);
    return text.substr(before == std::string::npos ? 0 : before + 1,
                       end - (before == std::string::npos ? std::size_t{0} : before + 1) + 1);
}

} // namespace

void beginProcess() {
    openStandardDescriptors();
    std::signal(SIGXFSZ, SIG_IGN);
    catchEnding(endBySignal, KeepIgnored::all);
    rlimit stack{}; // renders need most of 128 kB; an overflow could not be reported
    if (getrlimit(RLIMIT_STACK, &stack) == 0 && stack.rlim_cur < 128 * 1024)
        std::cerr << "physvib: ulimit -s: expected at least 128\n", std::_Exit(1);
}

void catchEnding(void (*handler)(int signal), KeepIgnored kept) noexcept {
    for (const int signal : endingSignals()) {
        const bool wasIgnored = std::signal(signal, handler) == SIG_IGN;
        if (wasIgnored && (kept == KeepIgnored::all || signal == SIGHUP)) std::signal(signal, SIG_IGN);
    }
}

void ignoreLostReader() noexcept { std::signal(SIGPIPE, SIG_IGN); }

bool isErrorTerminal() noexcept { return isatty(STDERR_FILENO) != 0; }

std::optional<std::size_t> readInput(std::span<char> bytes, int milliseconds) noexcept {
    pollfd input{STDIN_FILENO, POLLIN, 0};
    if (poll(&input, 1, milliseconds) <= 0) return std::nullopt;
    const ssize_t count = read(STDIN_FILENO, bytes.data(), bytes.size());
    if (count < 0 && (errno == EAGAIN || errno == EINTR)) return std::nullopt;
    return count > 0 ? static_cast<std::size_t>(count) : 0;
}

// A ready pipe accepts this many bytes without blocking.
std::optional<std::size_t> writeSome(Standard standard, std::string_view bytes) noexcept {
    pollfd out{standard == Standard::output ? STDOUT_FILENO : STDERR_FILENO, POLLOUT, 0};
    if (poll(&out, 1, 0) <= 0) return 0;
    const ssize_t count = write(out.fd, bytes.data(), std::min<std::size_t>(bytes.size(), PIPE_BUF));
    if (count < 0 && (errno == EAGAIN || errno == EINTR)) return 0;
    return count < 0 ? std::nullopt : std::optional{static_cast<std::size_t>(count)};
}

Result<bool> runProgram(std::string name, std::vector<std::string> arguments) {
    const auto child = start(name, arguments, nullptr);
    if (!child) return Failure{child.error};
    int status = 0;
    while (waitpid(child.value, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

Result<std::string> runWatched(std::string name, std::vector<std::string> arguments,
                               const std::function<bool()>& keepGoing) {
    constexpr int lookMs = 100;
    constexpr std::size_t mostKept = 4096;
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0) return Failure{name + ": " + std::generic_category().message(errno)};
    for (const int end : ends) fcntl(end, F_SETFD, FD_CLOEXEC); // another program may start meanwhile
    posix_spawn_file_actions_t errors;
    posix_spawn_file_actions_init(&errors);
    posix_spawn_file_actions_adddup2(&errors, ends[1], STDERR_FILENO);
    const auto child = start(name, arguments, &errors);
    posix_spawn_file_actions_destroy(&errors);
    close(ends[1]);
    std::string said;
    int status = 0;
    bool isWanted = true, isTold = true;
    for (bool hasEnded = !child; !hasEnded;) {
        pollfd words{ends[0], POLLIN, 0};
        poll(&words, 1, lookMs);
        const pid_t ended = waitpid(child.value, &status, WNOHANG);
        hasEnded = ended != 0;
        isTold = ended == child.value; // false if the parent process had SIGCHLD ignored
        std::array<char, 1024> some{};
        while (poll(&words, 1, 0) > 0) {
            const ssize_t count = read(ends[0], some.data(), some.size());
            if (count <= 0) break;
            said.append(some.data(), static_cast<std::size_t>(count));
            if (said.size() > mostKept) said.erase(0, said.size() - mostKept);
        }
        if ((words.revents & POLLHUP) != 0 && !hasEnded)
            poll(nullptr, 0, lookMs / 10); // all its output was read
        if (isWanted && !keepGoing()) {
            isWanted = false;
            kill(child.value, SIGKILL);
        }
    }
    close(ends[0]);
    if (!child) return Failure{child.error};
    if (!isTold) return Failure{name + ": the system does not tell how it ended"};
    if (WIFSIGNALED(status)) return "it was ended by signal " + std::to_string(WTERMSIG(status));
    if (WEXITSTATUS(status) == 0) return std::string{};
    const auto last = lastLine(said);
    return last.empty() ? "it ended with code " + std::to_string(WEXITSTATUS(status)) : cleanLine(last);
}

bool hasProgram(const std::string& name) {
    const char* const path = std::getenv("PATH");
    std::istringstream folders{path != nullptr ? path : ""};
    for (std::string folder; std::getline(folders, folder, ':');)
        if (access((std::filesystem::path{folder} / name).c_str(), X_OK) == 0) return true;
    return false;
}

bool hasDisplay() noexcept {
#if defined(__APPLE__)
    return true;
#else
    const char* const display = std::getenv("DISPLAY");
    return display != nullptr && *display != '\0';
#endif
}

std::string ownProgram(const std::string& name) {
    std::error_code none;
    const auto beside = std::filesystem::read_symlink("/proc/self/exe", none).replace_filename(name);
    return !none && std::filesystem::exists(beside, none) ? beside.string() : name;
}

} // namespace physvib
#endif
