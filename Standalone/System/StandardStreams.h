// SPDX-License-Identifier: GPL-3.0-or-later
// Redirects std::cout and std::cerr to an OutputWriter during playback.
#pragma once
#include "System/Process.h"
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

namespace physvib {
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

} // namespace physvib
