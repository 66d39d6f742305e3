// SPDX-License-Identifier: GPL-3.0-or-later
// Lines of standard input that act on a live session as they come; answers go to standard output, a line
// each.
#pragma once
#include "CommandLine/Play/LineCutter.h"
#include "Host/Devices/AudioOutput.h"
#include "Live/Documents/InputLine.h"
#include "Live/Messages/ComplaintLimit.h"
#include "Live/Messages/MessageRouter.h"
#include "Live/Session/InputQueue.h"
#include "Live/Session/Session.h"
#include <atomic>
#include <string>
#include <thread>

namespace physvib {

/// One thread reads lines, and silences at once if one of them says so; another does what they say, in their
/// order. Refusals are told on stderr, one of a cause in a second. When standard input ends, all that came
/// has been done and what it struck had its time, that is silence, for good.
class InputListener {
public:
    /// All outlive the listener. M.
    InputListener(Session& session, AudioOutput& output, MessageRouter& messages, ClipSource clips,
                  bool keepsPlaying);
    ~InputListener();

    /// That silence is there. Any thread.
    bool hasEnded() const noexcept { return hasEnded_; }

private:
    /// What was read and is still to be done.
    struct Line {
        std::string text;
        bool isWhole = true, silences = false;
        std::uint64_t asked = 0; // silences, up to this line
    };
    void read();
    void keep(std::string_view text, bool isWhole);
    void run();
    void take(const Line& line);
    void end();
    // the answer of a query; without a name: it is done
    Result<PlainMessage> act(LineInput& input, const Line& line);
    void complain(const std::string& reason);
    void tellLeftOut();

    Session& session_;
    AudioOutput& output_;
    MessageRouter& messages_;
    const ClipSource clips_;
    std::uint64_t lines_ = 0;
    InputQueue<Line> waiting_;
    ComplaintLimit complaints_{1'000'000'000};
    const bool keepsPlaying_; // whatever ends
    std::atomic<bool> stop_{false}, isAllRead_{false}, hasEnded_{false};
    std::thread thread_, reader_;
};

/// Does what an input or a control says that came from there. Empty, or what is wrong with it. Any thread but
/// R.
std::string actOn(const LineInput& input, Session& session, AudioOutput& output, SilenceHolder from);

} // namespace physvib
