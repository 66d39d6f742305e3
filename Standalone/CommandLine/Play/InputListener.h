// SPDX-License-Identifier: GPL-3.0-or-later
// Lines of standard input that act on a live session as they come; answers go to standard output, a line each.
#pragma once
#include "Scene/Sessions/InputLine.h"
#include "Host/Devices/AudioOutput.h"
#include "Session/InputQueue.h"
#include "Session/Messages/ComplaintLimit.h"
#include "Session/Messages/MessageRouter.h"
#include "Session/Session.h"
#include "CommandLine/Play/LineCutter.h"
#include <atomic>
#include <string>
#include <thread>

namespace physvib {

/// One thread reads lines, and silences at once if one of them says so; another does what they say, in their
/// order. Refusals are told on stderr, one of a cause in a second.
class InputListener {
public:
    /// All outlive the listener. M.
    InputListener(Session& session, AudioOutput& output, MessageRouter& messages, ClipSource clips);
    ~InputListener();

private:
    /// What was read and is still to be done.
    struct Line {
        std::string text;
        bool isWhole = true;
        std::uint64_t silences = 0; // asked for up to this line
    };
    void read();
    void keep(std::string_view text, bool isWhole);
    void run();
    void take(const Line& line);
    Result<PlainMessage> act(LineInput& input, const Line& line); // the answer of a query; without a name: it is done
    void complain(const std::string& reason);
    void tellLeftOut();

    Session& session_;
    AudioOutput& output_;
    MessageRouter& messages_;
    const ClipSource clips_;
    std::uint64_t lines_ = 0;
    InputQueue<Line> waiting_;
    ComplaintLimit complaints_{1'000'000'000};
    std::atomic<bool> stop_{false};
    std::thread thread_, reader_;
};

/// Does what an input or a control says that came from there. Empty, or what is wrong with it. Any thread but
/// R.
std::string actOn(const LineInput& input, Session& session, AudioOutput& output, SilenceHolder from);

} // namespace physvib
