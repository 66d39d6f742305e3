// SPDX-License-Identifier: GPL-3.0-or-later
// Redirects std::cout and std::cerr, by complete lines, to the queues of OutputWriter.
#include "System/Process.h"
#include <array>
#include <cerrno>
#include <condition_variable>
#include <cstdio>
#include <deque>
#include <iostream>
#include <memory>
#include <mutex>
#include <streambuf>
#include <system_error>
#include <utility>

namespace physvib {
namespace {

/// Collects the text of each thread until its line is complete.
class LineBuffer final : public std::streambuf {
public:
    LineBuffer(OutputWriter& writer, StdStream standard)
        : writer_{writer}
        , standard_{standard} {}

private:
    static std::string& partialLineOf(StdStream standard) {
        thread_local std::array<std::string, 2> partialLine;
        return partialLine[standard == StdStream::error];
    }
    std::streamsize xsputn(const char* text, std::streamsize size) override {
        std::string& partialLine = partialLineOf(standard_);
        partialLine.append(text, static_cast<std::size_t>(size));
        for (auto end = partialLine.find('\n'); end != std::string::npos; end = partialLine.find('\n')) {
            writer_.writeLine(standard_, partialLine.substr(0, end + 1));
            partialLine.erase(0, end + 1);
        }
        return size;
    }
    int overflow(int c) override {
        const char character = static_cast<char>(c);
        if (c != EOF) xsputn(&character, 1);
        return c == EOF ? 0 : c;
    }
    int sync() override {
        if (std::string& partialLine = partialLineOf(standard_); !partialLine.empty())
            writer_.writeLine(standard_, std::exchange(partialLine, {}));
        return 0;
    }

    OutputWriter& writer_;
    const StdStream standard_;
};

/// While it exists, std::cout and std::cerr write to an OutputWriter.
class StreamRedirection {
public:
    StreamRedirection() {
        std::cout.flush();
        out_ = std::cout.rdbuf(&outLines_);
        error_ = std::cerr.rdbuf(&errorLines_);
        std::cerr << std::nounitbuf;
    }
    ~StreamRedirection() {
        std::cout.flush();
        std::cerr.flush();
        std::cout.rdbuf(out_);
        std::cerr.rdbuf(error_);
        std::cerr << std::unitbuf;
        writer.finish(StdStream::error);
    }
    OutputWriter writer;

private:
    LineBuffer outLines_{writer, StdStream::output}, errorLines_{writer, StdStream::error};
    std::streambuf *out_ = nullptr, *error_ = nullptr;
};

std::unique_ptr<StreamRedirection> redirection; // changed by the message thread only, while no other thread
                                                // prints

} // namespace

void beginNonBlockingOutput() {
    if (!redirection) redirection = std::make_unique<StreamRedirection>();
}

std::uint64_t droppedLines(StdStream standard) {
    return redirection ? redirection->writer.dropped(standard) : 0;
}

std::optional<std::string> finishOutput() {
    return redirection ? std::optional{redirection->writer.finish(StdStream::output)} : std::nullopt;
}

void endNonBlockingOutput() { redirection.reset(); }

// OutputWriter: writing to a full pipe blocks, but playback must not wait for a reader. Therefore writeLine()
// only queues a line, or drops and counts it. The thread writes the oldest line of a stream that is not
// blocked; it tries a blocked stream again after `retryInterval`, and that does not delay the other one.

namespace {

constexpr std::chrono::milliseconds retryInterval{20}; // polling interval for a reader whose pipe is full
constexpr std::array bothStandards{StdStream::output, StdStream::error};

std::size_t indexOf(StdStream standard) { return static_cast<std::size_t>(standard); }

std::string unreadText(std::uint64_t lines) {
    return std::to_string(lines) + (lines == 1 ? " line was" : " lines were") + " not read";
}

struct Line {
    std::uint64_t number; // common to both streams
    std::string text;
};

struct Stream {
    std::deque<Line> lines;
    std::size_t bytes = 0, written = 0; // bytes in the queue; bytes of the first line that were written
    std::uint64_t dropped = 0, unreported = 0;
    int errorNumber = 0;    // an errno
    bool isBlocked = false; // the pipe was full

    void push(std::uint64_t number, std::string text) {
        bytes += text.size();
        lines.push_back({number, std::move(text)});
    }
    void drop(std::uint64_t count) {
        dropped += count;
        unreported += count;
    }
    void removeBytes(std::size_t count) {
        written += count;
        bytes -= count;
        if (written < lines.front().text.size()) return;
        lines.pop_front();
        written = 0;
    }
    void fail(int number) {
        errorNumber = number;
        drop(lines.size());
        lines.clear();
        bytes = written = 0;
    }
};

} // namespace

struct OutputWriter::State {
    explicit State(Sink writeSink)
        : sink{std::move(writeSink)} {}

    Stream& streamFor(StdStream standard) { return streams[indexOf(standard)]; }

    /// The stream with the oldest first line, among those that are not blocked.
    std::optional<StdStream> nextStream() const {
        std::optional<StdStream> found;
        std::uint64_t first = UINT64_MAX;
        for (const StdStream standard : bothStandards) {
            const Stream& stream = streams[indexOf(standard)];
            if (stream.isBlocked || stream.lines.empty() || stream.lines.front().number >= first) continue;
            first = stream.lines.front().number;
            found = standard;
        }
        return found;
    }

    void run() {
        std::unique_lock lock{mutex};
        while (!isEnding) {
            if (const auto standard = nextStream())
                write(*standard, lock);
            else
                waitForWork(lock);
        }
        isDone = true;
        stateChanged.notify_all();
    }

    // Only this thread removes lines, so the first line stays valid while unlocked.
    void write(StdStream standard, std::unique_lock<std::mutex>& lock) {
        Stream& stream = streamFor(standard);
        const auto text = std::string_view{stream.lines.front().text}.substr(stream.written);
        lock.unlock();
        const auto count = sink(standard, text);
        const int errorNumber = errno;
        lock.lock();
        if (!count)
            stream.fail(errorNumber);
        else if (*count > 0)
            stream.removeBytes(*count);
        else
            stream.isBlocked = true;
        stateChanged.notify_all();
    }

    void waitForWork(std::unique_lock<std::mutex>& lock) {
        bool isBlocked = false;
        for (Stream& stream : streams) isBlocked = isBlocked || stream.isBlocked;
        if (isBlocked)
            workChanged.wait_for(lock, retryInterval);
        else
            workChanged.wait(lock);
        for (Stream& stream : streams) stream.isBlocked = false;
    }

    const Sink sink;
    std::mutex mutex; // guards the members below
    std::condition_variable workChanged, stateChanged;
    std::array<Stream, 2> streams;
    std::uint64_t nextNumber = 0;
    bool isEnding = false, isDone = false;
};

OutputWriter::OutputWriter(Sink sink)
    : state_{std::make_shared<State>(std::move(sink))}
    , thread_{[state = state_] { state->run(); }} {}

OutputWriter::~OutputWriter() {
    std::unique_lock lock{state_->mutex};
    state_->isEnding = true;
    state_->workChanged.notify_all();
    const bool isDone = state_->stateChanged.wait_for(lock, finishTimeout, [this] { return state_->isDone; });
    lock.unlock();
    isDone ? thread_.join() : thread_.detach();
}

void OutputWriter::writeLine(StdStream standard, std::string line) {
    const std::lock_guard lock{state_->mutex};
    Stream& stream = state_->streamFor(standard);
    if (standard == StdStream::error && stream.unreported > 0)
        line = "physvib: standard error: " + unreadText(stream.unreported) + '\n' + line;
    if (stream.errorNumber != 0 || stream.bytes + line.size() > maxQueuedBytes) return stream.drop(1);
    stream.unreported = 0;
    stream.push(state_->nextNumber++, std::move(line));
    state_->workChanged.notify_all();
}

std::uint64_t OutputWriter::dropped(StdStream standard) const {
    const std::lock_guard lock{state_->mutex};
    return state_->streamFor(standard).dropped;
}

std::string OutputWriter::finish(StdStream standard) {
    std::unique_lock lock{state_->mutex};
    const Stream& stream = state_->streamFor(standard);
    state_->stateChanged.wait_for(lock, finishTimeout, [&stream] { return stream.lines.empty(); });
    if (stream.errorNumber != 0) return std::generic_category().message(stream.errorNumber);
    const std::uint64_t unread = stream.dropped + stream.lines.size();
    return unread > 0 ? unreadText(unread) : "";
}

} // namespace physvib
