// SPDX-License-Identifier: GPL-3.0-or-later
// Process.h on Windows: standard handles, console signals, child processes.
#if defined(_WIN32)
#include "Io/Disk/SystemFile.h"
#include "Io/Disk/SystemWindows.h"
#include "System/Process.h"
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <initializer_list>
#include <io.h>
#include <iostream>
#include <process.h>
#include <system_error>
#include <utility>

namespace physvib {
namespace {

/// Number of bytes in the pipe, 0 if its other end is closed, nullopt after `milliseconds`. Windows cannot
/// wait for a pipe, so it is polled every millisecond.
std::optional<DWORD> bytesInPipe(HANDLE pipe, int milliseconds) noexcept {
    for (int waitedMs = 0;; ++waitedMs) {
        DWORD available = 0;
        if (PeekNamedPipe(pipe, nullptr, 0, nullptr, &available, nullptr) == 0) return 0;
        if (available > 0) return available;
        if (waitedMs >= milliseconds) return std::nullopt;
        Sleep(1);
    }
}

} // namespace

void beginProcess() { handleEndingSignals(terminateBySignal, IgnoredSignals::all); }

void handleEndingSignals(void (*handler)(int signal), IgnoredSignals stayIgnored) noexcept {
    for (const int signal : endingSignals())
        if (std::signal(signal, handler) == SIG_IGN && stayIgnored == IgnoredSignals::all)
            std::signal(signal, SIG_IGN);
}

void ignoreLostReader() noexcept {} // on Windows, writing to a closed reader is an error and not a signal

bool isErrorTerminal() noexcept { return _isatty(_fileno(stderr)) != 0; }

// At a console this waits until a line that was begun is complete.
std::optional<std::size_t> readInput(std::span<char> bytes, int milliseconds) noexcept {
    const HANDLE input = GetStdHandle(STD_INPUT_HANDLE);
    if (GetFileType(input) == FILE_TYPE_PIPE) {
        const auto available = bytesInPipe(input, milliseconds);
        if (!available || *available == 0) return available;
    } else if (GetFileType(input) == FILE_TYPE_CHAR &&
               WaitForSingleObject(input, static_cast<DWORD>(milliseconds)) == WAIT_TIMEOUT) {
        return std::nullopt;
    }
    DWORD count = 0;
    return ReadFile(input, bytes.data(), static_cast<DWORD>(bytes.size()), &count, nullptr) != 0 ? count : 0;
}

std::optional<std::size_t> writeSome(StdStream standard, std::string_view bytes) noexcept {
    const int count = _write(_fileno(standard == StdStream::output ? stdout : stderr), bytes.data(),
                             static_cast<unsigned>(bytes.size()));
    return count < 0 ? std::nullopt : std::optional{static_cast<std::size_t>(count)};
}

Result<bool> runProgram(std::string name, std::vector<std::string> arguments) {
    const std::wstring program = std::filesystem::path{name}.wstring();
    std::vector<std::wstring> quoted;
    for (const std::string& argument : arguments)
        quoted.push_back(L'"' + std::filesystem::path{argument}.wstring() + L'"');
    std::vector<const wchar_t*> words{program.c_str()};
    for (const std::wstring& word : quoted) words.push_back(word.c_str());
    words.push_back(nullptr);
    std::cout.flush();
    const std::intptr_t code = _wspawnvp(_P_WAIT, program.c_str(), words.data());
    if (code == -1) return Failure{name + ": " + std::generic_category().message(errno)};
    return code == 0;
}

Result<std::string> runWatched(std::string name, std::vector<std::string> arguments,
                               const std::function<bool()>&) {
    const auto result = runProgram(std::move(name), std::move(arguments));
    if (!result) return Failure{result.error};
    return std::string{result.value ? "" : "for the reason on standard error"};
}

bool hasProgram(const std::string& name) {
    return SearchPathW(nullptr, std::filesystem::path{name}.c_str(), L".exe", 0, nullptr, nullptr) != 0;
}

bool hasDisplay() noexcept { return true; }

// Windows searches the folder of the running program first.
std::string siblingProgram(const std::string& name) { return name; }

} // namespace physvib
#endif
