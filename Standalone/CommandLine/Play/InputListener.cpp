// SPDX-License-Identifier: GPL-3.0-or-later
// Polls standard input, cuts it into lines, and hands each to the session.
#include "CommandLine/Play/InputListener.h"
#include "CommandLine/ExitCode.h"
#include "CommandLine/Process.h"
#include <iostream>
#include <type_traits>

namespace physvib {

namespace {

constexpr int pollMilliseconds = 50; // only the end of the program waits for it

} // namespace

InputListener::InputListener(Session& session, AudioOutput& output, MessageRouter& messages, ClipSource clips)
    : session_{session}
    , output_{output}
    , messages_{messages}
    , clips_{std::move(clips)}
    , thread_{[this] { run(); }} {}

InputListener::~InputListener() {
    stop_ = true;
    thread_.join();
}

void InputListener::run() {
    LineCutter lines;
    const auto takeLine = [this](std::string_view line, bool isWhole) { take(line, isWhole); };
    char bytes[4096];
    while (!stop_) {
        const auto count = readInput(bytes, pollMilliseconds);
        if (!count) continue;
        if (*count == 0) return lines.end(takeLine);
        lines.add({bytes, *count}, takeLine);
    }
}

void InputListener::take(std::string_view line, bool isWhole) {
    const std::string name = "standard input:" + std::to_string(++lines_);
    const std::string fault = isWhole ? act(line, name) : name + ": expected a line of at most " + std::to_string(LineCutter::longest) + " bytes, left out";
    if (!fault.empty()) tell(fault);
}

std::string InputListener::act(std::string_view line, const std::string& name) {
    if (line.find_first_not_of(" \t\r") == std::string_view::npos) return {};
    const auto read = readInputLine(line, name, session_.state().scene->materials, session_.channels());
    if (!read) return read.error;
    if (const auto* message = std::get_if<PlainMessage>(&read.value)) {
        const auto answer = messages_.take(*message, nullptr, clips_);
        if (!answer.value.name.empty()) std::cout << answerLine(answer.value) << std::endl; // who asked waits for it
        return answer ? "" : name + ": " + answer.error;
    }
    const std::string fault = actOn(read.value, session_, output_);
    return fault.empty() ? fault : name + ": " + fault;
}

std::string actOn(const LineInput& input, Session& session, AudioOutput& output) {
    if (const auto* action = std::get_if<Action>(&input)) return session.act(*action);
    if (const auto* control = std::get_if<RenderControl>(&input)) return session.post(*control) < 0 ? "too many controls at once" : "";
    if (const auto* silence = std::get_if<SilenceControl>(&input)) output.setSilent(silence->isOn);
    return {};
}

} // namespace physvib
