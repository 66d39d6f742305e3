// SPDX-License-Identifier: GPL-3.0-or-later
// Reads standard input in two threads, so that silence never waits for earlier lines.
// Reader: splits the input into lines, applies silence at once, and queues each line with the number of
// silences so far.
// Worker: processes the lines in order, and prints answers and errors.
#include "CommandLine/Play/InputListener.h"
#include "Io/Text/NumberText.h"
#include "Live/Session/BoardLink.h"
#include "System/Process.h"
#include <algorithm>
#include <iostream>

namespace physvib {

namespace {

constexpr int pollMilliseconds = 50; // longest wait for input; only delays the end of the program

// An impact lasts at most this long. A board waits as long for its computer before it falls silent.
constexpr double ringSeconds = 0.5;

/// Input may lower a ceiling, but not raise it above what the person at this computer set by --ceiling.
std::string applyControl(const RenderControl& control, Session& session) {
    if (control.kind == RenderControl::Kind::ceiling)
        if (const float most = session.rendered().ceiling(control.channel); control.value > most) {
            std::string fault = "ceiling: expected at most ";
            appendNumber(fault, most); // the shortest text that reads back as this number
            return fault + ", as --ceiling was set, found " + numberText(control.value);
        }
    return session.submit({control}).error;
}

} // namespace

InputListener::InputListener(Session& session, AudioOutput& output, MessageRouter& messages, ClipSource clips,
                             bool keepsPlaying)
    : session_{session}
    , output_{output}
    , messages_{messages}
    , clips_{std::move(clips)}
    , keepsPlaying_{keepsPlaying}
    , thread_{[this] { run(); }}
    , reader_{[this] { read(); }} {}

InputListener::~InputListener() {
    stop_ = true;
    reader_.join();
    thread_.join();
    reportSuppressed();
}

void InputListener::read() {
    LineCutter lines;
    const auto keepLine = [this](std::string_view line, bool isWhole) { keep(line, isWhole); };
    char bytes[4096];
    while (!stop_) {
        const auto count = readInput(bytes, pollMilliseconds);
        if (!count) continue;
        if (*count == 0) break;
        lines.add({bytes, *count}, keepLine);
    }
    lines.end(keepLine);
    isAllRead_ = true;
}

// Lines are never dropped: when the queue is full, the writer is blocked.
void InputListener::keep(std::string_view text, bool isWhole) {
    const bool silences = asksForSilence(text);
    if (silences) output_.silence().request(MuteRequester::standardInput);
    const std::uint64_t asked = output_.silence().asked(MuteRequester::standardInput);
    while (!waiting_.push({std::string(text), isWhole, silences, asked}, text.size()) && !stop_)
        std::this_thread::sleep_for(std::chrono::milliseconds{1});
}

void InputListener::run() {
    while (!stop_) {
        const bool isAllRead = isAllRead_;
        if (!waiting_.wait(std::chrono::milliseconds{pollMilliseconds})) {
            if (isAllRead) return end();
        } else if (const auto line = waiting_.pop()) {
            take(*line);
        }
    }
}

// Silences the output at the end of input, since the sender may have crashed during a long tone.
void InputListener::end() {
    if (keepsPlaying_) return;
    using Clock = std::chrono::steady_clock;
    const std::chrono::duration<double> felt{session_.timeline().outputLatencySeconds() + ringSeconds};
    for (const auto begin = Clock::now(); !stop_ && Clock::now() - begin < felt;)
        std::this_thread::sleep_for(std::chrono::milliseconds{5});
    output_.silence().request(MuteRequester::standardInput);
    if (!stop_) tell("standard input has ended: silence, and the end; --keep-playing plays on");
    hasEnded_ = true;
}

void InputListener::take(const Line& line) {
    ++lines_;
    if (line.isWhole && line.text.find_first_not_of(" \t\r") == std::string_view::npos) return;
    InputLine read =
        line.isWhole
            ? readInputLine(line.text, session_.world().state().scene->materials, session_.channels())
            : InputLine{Failure{"expected a line of at most " + std::to_string(LineCutter::longest) +
                                " bytes, left out"}};
    auto answer = read ? act(read.value, line) : Result<PlainMessage>{Failure{read.error}};
    if (!answer && line.silences) answer.error += silencedAllTheSame;
    if (!answer) complain(answer.error);
    if (read.id && !answer) answer.value = {"error", {{"reason", answer.error}}};
    if (read.id && answer.value.name.empty()) answer.value.name = "done";
    if (read.id) answer.value.values.insert(answer.value.values.begin(), {"id", *read.id});
    if (!answer.value.name.empty()) std::cout << answerLine(answer.value) + '\n' << std::flush;
}

Result<PlainMessage> InputListener::act(LineInput& input, const Line& line) {
    if (const auto* message = std::get_if<PlainMessage>(&input)) {
        auto answer = messages_.take(*message, nullptr, clips_);
        if (answer.value.name == "status")
            answer.value.values.push_back({"unread", static_cast<double>(droppedLines(Standard::output))});
        return answer;
    }
    if (auto* silence = std::get_if<SilenceControl>(&input)) silence->number = line.asked;
    const std::string fault = actOn(input, session_, output_, MuteRequester::standardInput);
    return fault.empty() ? Result<PlainMessage>{PlainMessage{}} : Failure{fault};
}

void InputListener::complain(const std::string& reason) {
    if (!complaints_.take(reason, BoardLink::nowNs())) return;
    reportSuppressed();
    tell("standard input:" + std::to_string(lines_) + ": " + reason);
}

void InputListener::reportSuppressed() {
    if (const std::uint64_t count = complaints_.takeLeftOut(); count > 0)
        tell("standard input: " + std::to_string(count) + " lines were refused as well");
}

std::string actOn(const LineInput& input, Session& session, AudioOutput& output, MuteRequester from) {
    if (const auto* action = std::get_if<Action>(&input)) return session.submit({*action}).error;
    if (const auto* control = std::get_if<OwnedControl>(&input)) return applyControl(*control, session);
    if (const auto* silence = std::get_if<SilenceControl>(&input))
        return takeSilence(output.silence(), *silence, from);
    return {};
}

} // namespace physvib
