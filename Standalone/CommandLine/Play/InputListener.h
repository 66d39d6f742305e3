// SPDX-License-Identifier: GPL-3.0-or-later
// Applies lines of standard input to a live session as they arrive; answers are lines on standard output.
#pragma once
#include "CommandLine/Play/LineCutter.h"
#include "Live/Devices/AudioOutput.h"
#include "Live/Documents/InputLine.h"
#include "Live/Messages/ErrorRateLimit.h"
#include "Live/Messages/MessageRouter.h"
#include "Live/Session/Input.h"
#include "Live/Session/Session.h"
#include <atomic>
#include <string>
#include <thread>

namespace physvib {

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
    void tellLeftOut();

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
