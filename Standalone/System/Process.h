// SPDX-License-Identifier: GPL-3.0-or-later
// System interface of the programs: start, standard streams without blocking, signals, child processes, exit
// codes and end. Functions are for the message thread if they do not say otherwise. Process*.cpp and
// StandardStreams.cpp implement it.
#pragma once
#include "Io/Result.h"
#include "Io/Text/CleanText.h"
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace physvib {

/// Call first. Opens closed standard descriptors, makes signals that end the program remove incomplete files,
/// and turns the file-size signal into a write error.
void beginProcess();

enum class StdStream { output, error };

/// Writes some of `bytes` and returns their number; 0 if the stream has no room now; nullopt if writing
/// failed, with the reason in `errno`. On Windows it may wait for the reader. One thread, not the render
/// thread.
std::optional<std::size_t> writeSome(StdStream standard, std::string_view bytes) noexcept;

/// Call last: empty if all standard output was written, or one line with the reason.
std::string outputError();

/// Ends the program at once with that exit code. Flushes output but runs no destructors of static objects,
/// because a thread abandoned in a device driver may still use them.
[[noreturn]] void exitImmediately(int exitCode);

/// Removes incomplete files and ends the program as that signal does. For signal handlers.
void terminateBySignal(int signal);

enum class IgnoredSignals {
    all,
    hangUp
}; ///< which ignored signals stay so: all, or only that of a closed terminal, for `nohup`
/// Calls `handler` on signals that ask the program to end (Ctrl-C, `kill`, a closed terminal).
void handleEndingSignals(void (*handler)(int signal), IgnoredSignals stayIgnored) noexcept;

/// Lets the program run on after the reader of standard output has closed it.
void ignoreLostReader() noexcept;

/// True if standard error is a terminal, so that progress text can be overwritten. Not on the render thread.
bool isErrorTerminal() noexcept;

/// Reads standard input into `bytes`, waiting up to `milliseconds`. Returns the number of bytes read, 0 at
/// the end of the input, nullopt after the time-out. One thread, not the render thread.
std::optional<std::size_t> readInput(std::span<char> bytes, int milliseconds) noexcept;

/// Runs a program with this one's standard streams and waits for its end. Returns true if it exited with 0,
/// or the error if it could not start. Not on the render thread.
Result<bool> runProgram(std::string name, std::vector<std::string> arguments);

/// Runs a program that prints only errors on standard error. Returns an empty string if it exited with 0, its
/// last line or the reason if not, or an error if it could not start. It is ended when `keepGoing`, called
/// ten times a second, returns false. On Windows it prints to our standard error and is not ended. Not on the
/// render thread.
Result<std::string> runWatched(std::string name, std::vector<std::string> arguments,
                               const std::function<bool()>& keepGoing);

/// True if the system's search path has that program. Not on the render thread.
bool hasProgram(const std::string& name);

/// True if a window can be opened. Not on the render thread.
bool hasDisplay() noexcept;

/// Path of another program of PhysVib: beside this one, else by the system's search path.
std::string siblingProgram(const std::string& name);

/// Redirects std::cout and std::cerr, by complete lines, to an OutputWriter. Text without a newline needs a
/// flush.
void beginNonBlockingOutput();

/// Number of lines dropped since beginNonBlockingOutput(). Not on the render thread.
std::uint64_t droppedLines(StdStream standard);

/// OutputWriter::finish() of standard output; nullopt if beginNonBlockingOutput() was not called.
std::optional<std::string> finishOutput();

/// Ends the redirection, after writing the remaining lines of standard error.
void endNonBlockingOutput();

/// Writes standard output and standard error during playback without blocking: a bounded queue of lines for
/// each, and one thread that writes them. Only that thread waits for a reader. Not on the render thread.
class OutputWriter {
public:
    static constexpr std::size_t maxQueuedBytes = 1 << 18;         ///< maximum of queued bytes per stream
    static constexpr std::chrono::milliseconds finishTimeout{250}; ///< longest wait of finish() per stream
    /// A function that writes text, with the contract of writeSome().
    using Sink = std::function<std::optional<std::size_t>(StdStream, std::string_view)>;

    explicit OutputWriter(Sink sink = writeSome);
    /// Discards queued lines. If a reader blocks the thread, the thread is detached.
    ~OutputWriter();

    /// Queues one line. If the queue is full, the line is dropped and counted, and standard error reports it
    /// when there is room again.
    void writeLine(StdStream standard, std::string line);

    /// Number of lines dropped so far.
    std::uint64_t dropped(StdStream standard) const;

    /// Waits at most `finishTimeout` until all lines are written. Empty, or why they are not.
    std::string finish(StdStream standard);

private:
    struct State;
    std::shared_ptr<State> state_;
    std::thread thread_;
};

inline std::atomic<bool> interrupted{false}; // the device callback reads it in every block, so that
                                             // the output is silent before anything else ends
static_assert(std::atomic<bool>::is_always_lock_free, "a signal may set it");

/// Makes signals that ask the program to end only set `interrupted`. A second signal, or 0.8 s without an end
/// after the first, terminates the program as that signal does; recorded files are complete at any moment. A
/// closed reader of standard output does not end the program, because the end of playback must be reported.
void installInterruptHandlers();

enum ExitCode : int {
    exitDone = 0,
    exitFailed = 1, ///< a file, device or render failed; one line on stderr says why
    exitUsage = 2   ///< the arguments are invalid
};

/// Prints one line on stderr, with unprintable characters replaced.
inline void printMessage(std::string_view words) { std::cerr << "physvib: " + cleanLine(words) + '\n'; }

/// Prints "warning: WHAT: COUNTUNIT" if `count` is above 0; `unit` begins with a space.
inline void warnIfAny(std::uint64_t count, const std::string& what, const std::string& unit = {}) {
    if (count > 0) printMessage("warning: " + what + ": " + std::to_string(count) + unit);
}

/// Prints the line and returns the exit code.
inline int reportExit(ExitCode code, std::string_view reason) {
    printMessage(reason);
    return code;
}

} // namespace physvib
