// SPDX-License-Identifier: GPL-3.0-or-later
// Stream buffers for std::cout and std::cerr that pass on complete lines.
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
    LineBuffer(OutputWriter& writer, Standard standard)
        : writer_{writer}
        , standard_{standard} {}

private:
    static std::string& begunOn(Standard standard) {
        thread_local std::array<std::string, 2> begun;
        return begun[standard == Standard::error];
    }
    std::streamsize xsputn(const char* text, std::streamsize size) override {
        std::string& begun = begunOn(standard_);
        begun.append(text, static_cast<std::size_t>(size));
        for (auto end = begun.find('\n'); end != std::string::npos; end = begun.find('\n')) {
            writer_.say(standard_, begun.substr(0, end + 1));
            begun.erase(0, end + 1);
        }
        return size;
    }
    int overflow(int c) override {
        const char one = static_cast<char>(c);
        if (c != EOF) xsputn(&one, 1);
        return c == EOF ? 0 : c;
    }
    int sync() override {
        if (std::string& begun = begunOn(standard_); !begun.empty())
            writer_.say(standard_, std::exchange(begun, {}));
        return 0;
    }

    OutputWriter& writer_;
    const Standard standard_;
};

class ErrorVoice {
public:
    ErrorVoice() {
        std::cout.flush();
        out_ = std::cout.rdbuf(&outLines_);
        error_ = std::cerr.rdbuf(&errorLines_);
        std::cerr << std::nounitbuf;
    }
    ~ErrorVoice() {
        std::cout.flush();
        std::cerr.flush();
        std::cout.rdbuf(out_);
        std::cerr.rdbuf(error_);
        std::cerr << std::unitbuf;
        writer.finish(Standard::error);
    }
    OutputWriter writer;

private:
    LineBuffer outLines_{writer, Standard::output}, errorLines_{writer, Standard::error};
    std::streambuf *out_ = nullptr, *error_ = nullptr;
};

std::unique_ptr<ErrorVoice> voice; // changed by the message thread only, while no other thread prints

} // namespace

void sayWithoutWaiting() {
    if (!voice) voice = std::make_unique<ErrorVoice>();
}

std::uint64_t droppedLines(Standard standard) { return voice ? voice->writer.dropped(standard) : 0; }

std::optional<std::string> finishOutput() {
    return voice ? std::optional{voice->writer.finish(Standard::output)} : std::nullopt;
}

void endOutput() { voice.reset(); }

// Two bounded queues of lines and one thread that writes them in the order in which they were queued.
// Problem: writing to a full pipe blocks, and playback must not wait for a reader.
// Steps: say() only queues, or drops and counts. The thread writes the oldest line of a stream that is not
// blocked. A blocked stream is tried again after `retryTime`, and does not delay the other one.

namespace {

constexpr std::chrono::milliseconds retryTime{20}; // polling interval for a reader whose pipe is full
constexpr std::array bothStandards{Standard::output, Standard::error};

std::size_t index(Standard standard) { return static_cast<std::size_t>(standard); }

std::string lineCount(std::uint64_t lines) {
    return std::to_string(lines) + (lines == 1 ? " line was" : " lines were") + " not read";
}

struct Line {
    std::uint64_t number; // common to both streams
    std::string text;
};

struct Stream {
    std::deque<Line> lines;
    std::size_t bytes = 0, written = 0; // bytes waiting; written bytes of the first line
    std::uint64_t dropped = 0, untold = 0;
    int fault = 0;         // an errno
    bool isHeldUp = false; // the pipe was full

    void push(std::uint64_t number, std::string text) {
        bytes += text.size();
        lines.push_back({number, std::move(text)});
    }
    void drop(std::uint64_t count) {
        dropped += count;
        untold += count;
    }
    void take(std::size_t count) {
        written += count;
        bytes -= count;
        if (written < lines.front().text.size()) return;
        lines.pop_front();
        written = 0;
    }
    void fail(int why) {
        fault = why;
        drop(lines.size());
        lines.clear();
        bytes = written = 0;
    }
};

} // namespace

struct OutputWriter::State {
    explicit State(Sink to)
        : sink{std::move(to)} {}

    Stream& of(Standard standard) { return streams[index(standard)]; }

    /// The stream with the oldest first line, among those that are not blocked.
    std::optional<Standard> next() const {
        std::optional<Standard> found;
        std::uint64_t first = UINT64_MAX;
        for (const Standard standard : bothStandards) {
            const Stream& stream = streams[index(standard)];
            if (stream.isHeldUp || stream.lines.empty() || stream.lines.front().number >= first) continue;
            first = stream.lines.front().number;
            found = standard;
        }
        return found;
    }

    void run() {
        std::unique_lock lock{mutex};
        while (!isEnding) {
            if (const auto standard = next())
                write(*standard, lock);
            else
                rest(lock);
        }
        isDone = true;
        changed.notify_all();
    }

    // Only this thread removes lines, so the first line stays valid while unlocked.
    void write(Standard standard, std::unique_lock<std::mutex>& lock) {
        Stream& stream = of(standard);
        const auto text = std::string_view{stream.lines.front().text}.substr(stream.written);
        lock.unlock();
        const auto count = sink(standard, text);
        const int why = errno;
        lock.lock();
        if (!count)
            stream.fail(why);
        else if (*count > 0)
            stream.take(*count);
        else
            stream.isHeldUp = true;
        changed.notify_all();
    }

    void rest(std::unique_lock<std::mutex>& lock) {
        bool isHeldUp = false;
        for (Stream& stream : streams) isHeldUp = isHeldUp || stream.isHeldUp;
        if (isHeldUp)
            woken.wait_for(lock, retryTime);
        else
            woken.wait(lock);
        for (Stream& stream : streams) stream.isHeldUp = false;
    }

    const Sink sink;
    std::mutex mutex; // guards the members below
    std::condition_variable woken, changed;
    std::array<Stream, 2> streams;
    std::uint64_t said = 0;
    bool isEnding = false, isDone = false;
};

OutputWriter::OutputWriter(Sink sink)
    : state_{std::make_shared<State>(std::move(sink))}
    , thread_{[state = state_] { state->run(); }} {}

OutputWriter::~OutputWriter() {
    std::unique_lock lock{state_->mutex};
    state_->isEnding = true;
    state_->woken.notify_all();
    const bool isDone = state_->changed.wait_for(lock, patience, [this] { return state_->isDone; });
    lock.unlock();
    isDone ? thread_.join() : thread_.detach();
}

void OutputWriter::say(Standard standard, std::string line) {
    const std::lock_guard lock{state_->mutex};
    Stream& stream = state_->of(standard);
    if (standard == Standard::error && stream.untold > 0)
        line = "physvib: standard error: " + lineCount(stream.untold) + '\n' + line;
    if (stream.fault != 0 || stream.bytes + line.size() > mostBytes) return stream.drop(1);
    stream.untold = 0;
    stream.push(state_->said++, std::move(line));
    state_->woken.notify_all();
}

std::uint64_t OutputWriter::dropped(Standard standard) const {
    const std::lock_guard lock{state_->mutex};
    return state_->of(standard).dropped;
}

std::string OutputWriter::finish(Standard standard) {
    std::unique_lock lock{state_->mutex};
    const Stream& stream = state_->of(standard);
    state_->changed.wait_for(lock, patience, [&stream] { return stream.lines.empty(); });
    if (stream.fault != 0) return std::generic_category().message(stream.fault);
    const std::uint64_t unread = stream.dropped + stream.lines.size();
    return unread > 0 ? lineCount(unread) : "";
}

} // namespace physvib
