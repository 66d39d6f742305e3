// SPDX-License-Identifier: GPL-3.0-or-later
// What the programs need of the system: before their first word, after their last, and in between. One file
// per system does it, ProcessPosix.cpp and ProcessWindows.cpp.
#pragma once
#include "Io/Result.h"
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// First of all: the standard descriptors are open, a signal that ends the program takes half-written files
/// along, and a file that may not grow is an error, not a signal. M.
void beginProcess();

enum class Standard { output, error };

/// Writes some of `bytes` there: how many; 0: it has no room now; nothing: it cannot be written, and `errno`
/// says why. On Windows it may wait for who reads. One thread, not R.
std::optional<std::size_t> writeSome(Standard standard, std::string_view bytes) noexcept;

/// Last of all: empty if all that was written to standard output arrived, or one line with the reason. M.
std::string outputFault();

/// Ends the program now, with that exit code: what is written goes out, and no destructor of a static object
/// runs, which a thread that is left to its driver may still use. M.
[[noreturn]] void endAtOnce(int exitCode);

/// Ends the program as that signal does, half-written files first. For the handlers of signals.
void endBySignal(int signal);

enum class KeepIgnored {
    all,
    hangUp
}; ///< what was ignored before and stays so: every such signal, or the one that `nohup` means
/// From now on what asks this program to end (Ctrl-C, `kill`, a terminal that is closed) calls `handler` with
/// the signal. M.
void catchEnding(void (*handler)(int signal), KeepIgnored kept) noexcept;

/// A reader of standard output that goes away ends nothing. M.
void ignoreLostReader() noexcept;

/// Whether somebody watches standard error, for words that are rewritten in place. Any thread but R.
bool isErrorTerminal() noexcept;

/// What has come on standard input, waiting up to `milliseconds` for it: how many bytes, 0 at the end,
/// nothing if none came. One thread, not R.
std::optional<std::size_t> readInput(std::span<char> bytes, int milliseconds) noexcept;

/// By which other processes know this one. Any thread but R.
int processNumber() noexcept;

/// Runs a program of that name, with what we have for standard streams, to its end: whether it said that all
/// is well, or why it did not begin. M.
Result<bool> runProgram(std::string name, std::vector<std::string> arguments);

/// Whether a window can be opened here. Any thread but R.
bool hasDisplay() noexcept;

/// A program of ours: the one that lies beside this one, else the one that the system finds by its name. M.
std::string ownProgram(const std::string& name);

} // namespace physvib
