// SPDX-License-Identifier: GPL-3.0-or-later
// POSIX implementation: descriptors 0 to 2, signals, processes.
#if !defined(_WIN32)
#include "Io/Disk/SystemFile.h"
#include "System/Process.h"
#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <initializer_list>
#include <iostream>
#include <poll.h>
#include <spawn.h>
#include <sstream>
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

} // namespace

void beginProcess() {
    openStandardDescriptors();
    std::signal(SIGXFSZ, SIG_IGN);
    catchEnding(endBySignal, KeepIgnored::all);
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

int processNumber() noexcept { return getpid(); }

Result<bool> runProgram(std::string name, std::vector<std::string> arguments) {
    std::vector<char*> words{name.data()};
    for (std::string& argument : arguments) words.push_back(argument.data());
    words.push_back(nullptr);
    pid_t child = 0;
    std::cout.flush();
    if (const int fault = posix_spawnp(&child, name.c_str(), nullptr, nullptr, words.data(), environ))
        return Failure{name + ": " + std::generic_category().message(fault)};
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
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

std::string computerName() {
    std::array<char, 256> name{};
    gethostname(name.data(), name.size() - 1);
    return name.data();
}

std::string ownPath() {
    std::error_code none;
    return std::filesystem::read_symlink("/proc/self/exe", none).string();
}

std::string ownProgram(const std::string& name) {
    std::error_code none;
    const auto beside = std::filesystem::path{ownPath()}.replace_filename(name);
    return !none && std::filesystem::exists(beside, none) ? beside.string() : name;
}

} // namespace physvib
#endif
