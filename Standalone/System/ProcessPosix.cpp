// SPDX-License-Identifier: GPL-3.0-or-later
// Process.h on POSIX: standard descriptors, signals that end the program, child processes.
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

// A file that is opened while a standard descriptor is closed would get its number and be mistaken for it.
// Opens /dev/null instead, in the wrong direction, so that reading input and writing output still fail.
void openStandardDescriptors() {
    for (int standard = STDIN_FILENO; standard <= STDERR_FILENO; ++standard)
        if (fcntl(standard, F_GETFD) < 0 &&
            open("/dev/null", standard == STDIN_FILENO ? O_WRONLY : O_RDONLY) < 0)
            std::_Exit(1);
}

Result<pid_t> spawn(std::string& name, std::vector<std::string>& arguments,
                    const posix_spawn_file_actions_t* actions) {
    std::vector<char*> words{name.data()};
    for (std::string& argument : arguments) words.push_back(argument.data());
    words.push_back(nullptr);
    pid_t child = 0;
    std::cout.flush();
    if (const int errorNumber = posix_spawnp(&child, name.c_str(), actions, nullptr, words.data(), environ))
        return Failure{name + ": " + std::generic_category().message(errorNumber)};
    return child;
}

std::string lastLine(const std::string& text) {
    const auto end = text.find_last_not_of("\r\n ");
    if (end == std::string::npos) return {};
    const auto lineEnd = text.find_last_of("\r\n", end);
    return text.substr(lineEnd == std::string::npos ? 0 : lineEnd + 1,
                       end - (lineEnd == std::string::npos ? std::size_t{0} : lineEnd + 1) + 1);
}

} // namespace

void beginProcess() {
    openStandardDescriptors();
    std::signal(SIGXFSZ, SIG_IGN);
    handleEndingSignals(terminateBySignal, IgnoredSignals::all);
    rlimit stack{}; // renders need about 128 kB, and an overflow could not be reported
    if (getrlimit(RLIMIT_STACK, &stack) == 0 && stack.rlim_cur < 128 * 1024)
        std::cerr << "physvib: ulimit -s: expected at least 128\n", std::_Exit(1);
}

void handleEndingSignals(void (*handler)(int signal), IgnoredSignals stayIgnored) noexcept {
    for (const int signal : endingSignals()) {
        const bool wasIgnored = std::signal(signal, handler) == SIG_IGN;
        if (wasIgnored && (stayIgnored == IgnoredSignals::all || signal == SIGHUP))
            std::signal(signal, SIG_IGN);
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

// A pipe that is ready accepts PIPE_BUF bytes without blocking.
std::optional<std::size_t> writeSome(StdStream standard, std::string_view bytes) noexcept {
    pollfd out{standard == StdStream::output ? STDOUT_FILENO : STDERR_FILENO, POLLOUT, 0};
    if (poll(&out, 1, 0) <= 0) return 0;
    const ssize_t count = write(out.fd, bytes.data(), std::min<std::size_t>(bytes.size(), PIPE_BUF));
    if (count < 0 && (errno == EAGAIN || errno == EINTR)) return 0;
    return count < 0 ? std::nullopt : std::optional{static_cast<std::size_t>(count)};
}

Result<bool> runProgram(std::string name, std::vector<std::string> arguments) {
    const auto child = spawn(name, arguments, nullptr);
    if (!child) return Failure{child.error};
    int status = 0;
    while (waitpid(child.value, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

Result<std::string> runWatched(std::string name, std::vector<std::string> arguments,
                               const std::function<bool()>& keepGoing) {
    constexpr int pollMs = 100;
    constexpr std::size_t maxKeptBytes = 4096;
    std::array<int, 2> pipeEnds{};
    if (pipe(pipeEnds.data()) != 0) return Failure{name + ": " + std::generic_category().message(errno)};
    for (const int end : pipeEnds)
        fcntl(end, F_SETFD, FD_CLOEXEC); // so that other child processes do not inherit it
    posix_spawn_file_actions_t errors;
    posix_spawn_file_actions_init(&errors);
    posix_spawn_file_actions_adddup2(&errors, pipeEnds[1], STDERR_FILENO);
    const auto child = spawn(name, arguments, &errors);
    posix_spawn_file_actions_destroy(&errors);
    close(pipeEnds[1]);
    std::string errorOutput;
    int status = 0;
    bool isWanted = true, hasStatus = true;
    for (bool hasEnded = !child; !hasEnded;) {
        pollfd errorPipe{pipeEnds[0], POLLIN, 0};
        poll(&errorPipe, 1, pollMs);
        const pid_t ended = waitpid(child.value, &status, WNOHANG);
        hasEnded = ended != 0;
        hasStatus = ended == child.value; // false if the parent process had SIGCHLD ignored
        std::array<char, 1024> block{};
        while (poll(&errorPipe, 1, 0) > 0) {
            const ssize_t count = read(pipeEnds[0], block.data(), block.size());
            if (count <= 0) break;
            errorOutput.append(block.data(), static_cast<std::size_t>(count));
            if (errorOutput.size() > maxKeptBytes) errorOutput.erase(0, errorOutput.size() - maxKeptBytes);
        }
        if ((errorPipe.revents & POLLHUP) != 0 && !hasEnded)
            poll(nullptr, 0, pollMs / 10); // it closed its output: waits briefly for its end
        if (isWanted && !keepGoing()) {
            isWanted = false;
            kill(child.value, SIGKILL);
        }
    }
    close(pipeEnds[0]);
    if (!child) return Failure{child.error};
    if (!hasStatus) return Failure{name + ": the system does not tell how it ended"};
    if (WIFSIGNALED(status)) return "it was ended by signal " + std::to_string(WTERMSIG(status));
    if (WEXITSTATUS(status) == 0) return std::string{};
    const auto message = lastLine(errorOutput);
    return message.empty() ? "it ended with code " + std::to_string(WEXITSTATUS(status)) : cleanLine(message);
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

std::string siblingProgram(const std::string& name) {
    std::error_code code;
    const auto siblingPath = std::filesystem::read_symlink("/proc/self/exe", code).replace_filename(name);
    return !code && std::filesystem::exists(siblingPath, code) ? siblingPath.string() : name;
}

} // namespace physvib
#endif
