// SPDX-License-Identifier: GPL-3.0-or-later
// Applies lines of standard input to a live session as they arrive; answers are lines on standard output.
#pragma once
#include "Live/Devices/AudioOutput.h"
#include "Live/Documents/InputLine.h"
#include "Live/Messages/MessageRouter.h"
#include "Live/Session/Scheduler.h"
#include "Live/Session/Session.h"
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <string>
#include <string_view>
#include <thread>

namespace physvib {

/// Splits a byte stream into lines. Overlong lines are discarded, except that "silence" in them is reported.
/// `onLine(std::string_view line, bool isWhole)` is called once per line. For a line longer than
/// `maxLineBytes`, isWhole is false and the line is "silence" if it contains that word, else empty. One
/// thread at a time.
class LineSplitter {
public:
    static constexpr std::size_t maxLineBytes = 65'536; // far above any valid line

    template <class OnLine>
    void add(std::string_view bytes, OnLine&& onLine) {
        for (std::size_t end = bytes.find('\n'); end != std::string_view::npos; end = bytes.find('\n')) {
            append(bytes.substr(0, end));
            emitLine(onLine);
            bytes.remove_prefix(end + 1);
        }
        append(bytes);
    }

    /// Ends the stream; text without a final newline is a line too.
    template <class OnLine>
    void end(OnLine&& onLine) {
        if (!line_.empty() || isTooLong_) emitLine(onLine);
    }

private:
    void append(std::string_view part) {
        line_ += part;
        isTooLong_ = isTooLong_ || line_.size() > maxLineBytes;
        if (!isTooLong_) return;
        hasSilence_ = hasSilence_ || containsSilenceWord(line_);
        // keeps the end, which may be the first part of the word
        line_.erase(0, line_.size() - std::min(line_.size(), silenceWord.size() - 1));
    }
    template <class OnLine>
    void emitLine(OnLine&& onLine) {
        onLine(!isTooLong_ ? std::string_view{line_} : hasSilence_ ? silenceWord : "", !isTooLong_);
        line_.clear();
        isTooLong_ = hasSilence_ = false;
    }

    static constexpr std::string_view silenceWord = "silence";
    std::string line_;
    bool isTooLong_ = false, hasSilence_ = false;
};

/// One thread reads lines and applies silence immediately; another processes the lines in order. Rejections
/// are printed on stderr, at most one per cause and second. After the end of standard input, when all lines
/// were processed and their events played, the output is silenced permanently.
class InputListener {
public:
    /// All references outlive the listener. Message thread.
    InputListener(Session& session, AudioOutput& output, MessageRouter& messages, ClipSource clips,
                  bool keepsPlaying);
    ~InputListener();

    /// True after the final silence. Any thread.
    bool hasEnded() const noexcept { return hasEnded_; }

private:
    /// A line waiting to be processed.
    struct Line {
        std::string text;
        bool isWhole = true, isSilence = false;
        std::uint64_t silenceCount = 0; // number of silences up to this line
    };
    void runReader();
    void enqueue(std::string_view text, bool isWhole);
    void runWorker();
    void process(const Line& line);
    void silenceAtEnd();
    /// Returns the answer of a query (its name is empty if the line is none), or an error line.
    Result<PlainMessage> handleInput(LineInput& input, const Line& line);
    void reportError(const std::string& reason);
    void reportSuppressed();

    Session& session_;
    AudioOutput& output_;
    MessageRouter& messages_;
    const ClipSource clips_;
    std::uint64_t lineCount_ = 0;
    InputQueue<Line> queue_;
    ErrorRateLimit errorLimit_{1'000'000'000};
    const bool keepsPlaying_; // true: no silence at the end of input
    std::atomic<bool> stop_{false}, isAllRead_{false}, hasEnded_{false};
    std::thread worker_, reader_;
};

/// Applies an input; `requester`: source of a silence. Empty, or an error. Any thread but the render thread.
std::string applyInput(const LineInput& input, Session& session, AudioOutput& output,
                       MuteRequester requester);

} // namespace physvib
