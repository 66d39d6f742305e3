// SPDX-License-Identifier: GPL-3.0-or-later
// Lines of standard input that act on a live session as they come; answers go to standard output, a line each.
#pragma once
#include "Files/Text/InputLine.h"
#include "Host/Devices/AudioOutput.h"
#include "Session/Messages/MessageRouter.h"
#include "Session/Session.h"
#include "CommandLine/Play/LineCutter.h"
#include <atomic>
#include <string>
#include <thread>

namespace physvib {

/// Reads on a thread of its own, so that an input waits for nothing; refusals are told on stderr, a line each.
class InputListener {
public:
    /// All outlive the listener. M.
    InputListener(Session& session, AudioOutput& output, MessageRouter& messages, ClipSource clips);
    ~InputListener();

private:
    void run();
    void take(std::string_view line, bool isWhole);
    std::string act(std::string_view line, const std::string& name);

    Session& session_;
    AudioOutput& output_;
    MessageRouter& messages_;
    const ClipSource clips_;
    std::uint64_t lines_ = 0;
    std::atomic<bool> stop_{false};
    std::thread thread_;
};

/// Does what an input or a control says. Empty, or what is wrong with it. Any thread but R.
std::string actOn(const LineInput& input, Session& session, AudioOutput& output);

} // namespace physvib
