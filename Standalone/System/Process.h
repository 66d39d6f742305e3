// SPDX-License-Identifier: GPL-3.0-or-later
// System interface of the programs: start, standard streams without blocking, signals, child processes, exit
// codes and end. Process*.cpp and StandardStreams.cpp implement it.
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

/// To be called first. Opens closed standard descriptors, lets fatal signals remove incomplete files, and
/// turns the file-size signal into a write error. Message thread.
void beginProcess();

enum class Standard { output, error };

/// Writes some of `bytes` and returns their number; 0 if the stream has no room now; nullopt if writing
/// failed, with the reason in `errno`. On Windows it may wait for the reader. One thread, not R.
std::optional<std::size_t> writeSome(Standard standard, std::string_view bytes) noexcept;

/// To be called last: empty if all standard output was written, or one line with the reason. Message thread.
std::string outputFault();

/// Ends the program at once with that exit code. Flushes output but runs no destructors of static objects,
/// because a thread abandoned in a device driver may still use them. Message thread.
[[noreturn]] void endAtOnce(int exitCode);

/// Removes incomplete files and ends the program as that signal does. For signal handlers.
void endBySignal(int signal);

enum class KeepIgnored {
    all,
    hangUp
}; ///< which ignored signals stay ignored: all, or only that of a closed terminal, as `nohup` needs
/// Calls `handler` on signals that ask the program to end (Ctrl-C, `kill`, a closed terminal). M.
void catchEnding(void (*handler)(int signal), KeepIgnored kept) noexcept;

/// Keeps the program running when the reader of standard output closes. Message thread.
void ignoreLostReader() noexcept;

/// True if standard error is a terminal, so that progress text can be overwritten. Any thread but R.
bool isErrorTerminal() noexcept;

/// Reads standard input, waiting up to `milliseconds`: number of bytes, 0 at the end, nullopt if none came.
/// One thread, not the render thread.
std::optional<std::size_t> readInput(std::span<char> bytes, int milliseconds) noexcept;

/// Runs a program with our standard streams until it ends: true if it exited with 0, or why it could not
/// start. Any thread but the render thread.
Result<bool> runProgram(std::string name, std::vector<std::string> arguments);

/// Runs a program that prints only errors on standard error. Returns an empty string if it exited with 0, its
/// last line or the reason if not, or an error if it could not start. It is ended when `keepGoing`, called
/// ten times a second, returns false. On Windows it prints to our standard error and is not ended. Any thread
/// but the render thread.
Result<std::string> runWatched(std::string name, std::vector<std::string> arguments,
                               const std::function<bool()>& keepGoing);

/// True if the system's search path has that program. Any thread but the render thread.
bool hasProgram(const std::string& name);

/// True if a window can be opened. Any thread but the render thread.
bool hasDisplay() noexcept;

/// Path of another program of PhysVib: beside this one, else by the system's search path. Message thread.
std::string ownProgram(const std::string& name);

// Standard output and standard error during playback, in StandardStreams.cpp.

/// Redirects std::cout and std::cerr, by complete lines, to an OutputWriter. Text without a newline needs a
/// flush. Message thread.
void sayWithoutWaiting();

/// Number of lines dropped since sayWithoutWaiting(). Any thread but the render thread.
std::uint64_t droppedLines(Standard standard);

/// OutputWriter::finish() of standard output; nullopt if sayWithoutWaiting() was not called. Message thread.
std::optional<std::string> finishOutput();

/// Ends the redirection, after writing the remaining lines of standard error. Message thread.
void endOutput();

// Non-blocking standard output and standard error during playback: a bounded queue for each, and one thread
// that writes. Only that thread waits for a reader.

/// Any thread but the render thread.
class OutputWriter {
public:
    static constexpr std::size_t mostBytes = 1 << 18;         ///< maximum of queued bytes per stream
    static constexpr std::chrono::milliseconds patience{250}; ///< per stream, at the end
    /// Same interface as writeSome().
    using Sink = std::function<std::optional<std::size_t>(Standard, std::string_view)>;

    explicit OutputWriter(Sink sink = writeSome);
    /// Discards queued lines. If a reader blocks the thread, the thread is detached.
    ~OutputWriter();

    /// Queues one line. If the queue is full, the line is dropped and counted, and standard error reports it
    /// when there is room again.
    void say(Standard standard, std::string line);

    /// Number of lines dropped so far.
    std::uint64_t dropped(Standard standard) const;

    /// Waits at most `patience` until all lines are written. Empty, or why they are not.
    std::string finish(Standard standard);

private:
    struct State;
    std::shared_ptr<State> state_;
    std::thread thread_;
};

// How a program ends.

inline std::atomic<bool> interrupted{false}; // read in every block by the device callback, so that output
                                             // becomes silent before anything else ends
static_assert(std::atomic<bool>::is_always_lock_free, "a signal may set it");

/// Installs handlers after which these signals only set `interrupted`. A second signal, or 0.8 s without an
/// end after the first, terminates the program as that signal does. Recorded files do not depend on this,
/// since they are complete at any moment. A closed reader of standard output does not end the program,
/// because the end of playback must still be reported. Message thread.
void heedInterrupts();

enum ExitCode : int {
    exitDone = 0,
    exitFailed = 1, ///< a file, device or render failed; one line on stderr says why
    exitUsage = 2   ///< the arguments are invalid
};

/// Prints one line on stderr, with unprintable characters replaced.
inline void tell(std::string_view words) { std::cerr << "physvib: " + cleanLine(words) + '\n'; }

/// Prints "warning: WHAT: COUNT UNIT" if there are any.
inline void warnOf(std::uint64_t count, const std::string& what, const std::string& unit = {}) {
    if (count > 0) tell("warning: " + what + ": " + std::to_string(count) + unit);
}

/// Prints the line and returns the exit code.
inline int leave(ExitCode code, std::string_view reason) {
    tell(reason);
    return code;
}

} // namespace physvib
