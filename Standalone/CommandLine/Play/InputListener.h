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
/// `take(std::string_view line, bool isWhole)` is called once per line. For a line longer than `longest`,
/// isWhole is false and the line is "silence" if it contains that word, else empty. One thread at a time.
class LineCutter {
public:
    static constexpr std::size_t longest = 65'536; // far above any valid line

    template <class Take>
    void add(std::string_view bytes, Take&& take) {
        for (std::size_t end = bytes.find('\n'); end != std::string_view::npos; end = bytes.find('\n')) {
            keep(bytes.substr(0, end));
            hand(take);
            bytes.remove_prefix(end + 1);
        }
        keep(bytes);
    }

    /// Ends the stream; text without a final newline is a line too.
    template <class Take>
    void end(Take&& take) {
        if (!line_.empty() || isTooLong_) hand(take);
    }

private:
    void keep(std::string_view part) {
        line_ += part;
        isTooLong_ = isTooLong_ || line_.size() > longest;
        if (!isTooLong_) return;
        namesSilence_ = namesSilence_ || namesSilence(line_);
        // keeps the end, which may be the first part of the word
        line_.erase(0, line_.size() - std::min(line_.size(), word.size() - 1));
    }
    template <class Take>
    void hand(Take&& take) {
        take(!isTooLong_ ? std::string_view{line_} : namesSilence_ ? word : "", !isTooLong_);
        line_.clear();
        isTooLong_ = namesSilence_ = false;
    }

    static constexpr std::string_view word = "silence";
    std::string line_;
    bool isTooLong_ = false, namesSilence_ = false;
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
        bool isWhole = true, silences = false;
        std::uint64_t asked = 0; // number of silences up to this line
    };
    void read();
    void keep(std::string_view text, bool isWhole);
    void run();
    void take(const Line& line);
    void end();
    // Answer of a query; an empty name if the line is not a query.
    Result<PlainMessage> act(LineInput& input, const Line& line);
    void complain(const std::string& reason);
    void reportSuppressed();

    Session& session_;
    AudioOutput& output_;
    MessageRouter& messages_;
    const ClipSource clips_;
    std::uint64_t lines_ = 0;
    InputQueue<Line> waiting_;
    ErrorRateLimit complaints_{1'000'000'000};
    const bool keepsPlaying_; // true: no silence at the end of input
    std::atomic<bool> stop_{false}, isAllRead_{false}, hasEnded_{false};
    std::thread thread_, reader_;
};

/// Applies an input or control from that source. Empty, or an error. Any thread but the render thread.
std::string actOn(const LineInput& input, Session& session, AudioOutput& output, MuteRequester from);

} // namespace physvib
