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
constexpr double maxRingSeconds = 0.5;

/// Input may lower a ceiling, but not raise it above what the person at this computer set by --ceiling.
std::string applyControl(const RenderControl& control, Session& session) {
    if (control.kind == RenderControl::Kind::ceiling)
        if (const float ceiling = session.rendered().ceiling(control.channel); control.value > ceiling) {
            std::string error = "ceiling: expected at most ";
            appendNumber(error, ceiling); // the shortest text that reads back as this number
            return error + ", as --ceiling was set, found " + numberText(control.value);
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
    , worker_{[this] { runWorker(); }}
    , reader_{[this] { runReader(); }} {}

InputListener::~InputListener() {
    stop_ = true;
    reader_.join();
    worker_.join();
    reportSuppressed();
}

void InputListener::runReader() {
    LineSplitter lines;
    const auto enqueueLine = [this](std::string_view line, bool isWhole) { enqueue(line, isWhole); };
    char bytes[4096];
    while (!stop_) {
        const auto count = readInput(bytes, pollMilliseconds);
        if (!count) continue;
        if (*count == 0) break;
        lines.add({bytes, *count}, enqueueLine);
    }
    lines.end(enqueueLine);
    isAllRead_ = true;
}

// Lines are never dropped: when the queue is full, the writer is blocked.
void InputListener::enqueue(std::string_view text, bool isWhole) {
    const bool isSilence = requestsSilence(text);
    if (isSilence) output_.silence().request(MuteRequester::standardInput);
    const std::uint64_t silenceCount = output_.silence().requestCount(MuteRequester::standardInput);
    while (!queue_.push({std::string(text), isWhole, isSilence, silenceCount}, text.size()) && !stop_)
        std::this_thread::sleep_for(std::chrono::milliseconds{1});
}

void InputListener::runWorker() {
    while (!stop_) {
        const bool isAllRead = isAllRead_;
        if (!queue_.wait(std::chrono::milliseconds{pollMilliseconds})) {
            if (isAllRead) return silenceAtEnd();
        } else if (const auto line = queue_.pop()) {
            process(*line);
        }
    }
}

// Silences the output at the end of input, since the sender may have crashed during a long tone.
void InputListener::silenceAtEnd() {
    if (keepsPlaying_) return;
    using Clock = std::chrono::steady_clock;
    const std::chrono::duration<double> drainTime{session_.timeline().outputLatencySeconds() +
                                                  maxRingSeconds};
    for (const auto begin = Clock::now(); !stop_ && Clock::now() - begin < drainTime;)
        std::this_thread::sleep_for(std::chrono::milliseconds{5});
    output_.silence().request(MuteRequester::standardInput);
    if (!stop_) printMessage("standard input has ended: silence, and the end; --keep-playing plays on");
    hasEnded_ = true;
}

void InputListener::process(const Line& line) {
    ++lineCount_;
    if (line.isWhole && line.text.find_first_not_of(" \t\r") == std::string_view::npos) return;
    InputLine parsed =
        line.isWhole
            ? readInputLine(line.text, session_.world().state().scene->materials, session_.channels())
            : InputLine{Failure{"expected a line of at most " + std::to_string(LineSplitter::maxLineBytes) +
                                " bytes, left out"}};
    auto answer = parsed ? handleInput(parsed.value, line) : Result<PlainMessage>{Failure{parsed.error}};
    if (!answer && line.isSilence) answer.error += silencedAnyway;
    if (!answer) reportError(answer.error);
    if (parsed.id && !answer) answer.value = {"error", {{"reason", answer.error}}};
    if (parsed.id && answer.value.name.empty()) answer.value.name = "done";
    if (parsed.id) answer.value.values.insert(answer.value.values.begin(), {"id", *parsed.id});
    if (!answer.value.name.empty()) std::cout << answerLine(answer.value) + '\n' << std::flush;
}

Result<PlainMessage> InputListener::handleInput(LineInput& input, const Line& line) {
    if (const auto* message = std::get_if<PlainMessage>(&input)) {
        auto answer = messages_.handle(*message, nullptr, clips_);
        if (answer.value.name == "status")
            answer.value.values.push_back({"unread", static_cast<double>(droppedLines(StdStream::output))});
        return answer;
    }
    if (auto* silence = std::get_if<SilenceControl>(&input)) silence->number = line.silenceCount;
    const std::string error = applyInput(input, session_, output_, MuteRequester::standardInput);
    return error.empty() ? Result<PlainMessage>{PlainMessage{}} : Failure{error};
}

void InputListener::reportError(const std::string& reason) {
    if (!errorLimit_.shouldReport(reason, BoardLink::nowNs())) return;
    reportSuppressed();
    printMessage("standard input:" + std::to_string(lineCount_) + ": " + reason);
}

void InputListener::reportSuppressed() {
    if (const std::uint64_t count = errorLimit_.resetSuppressedCount(); count > 0)
        printMessage("standard input: " + std::to_string(count) + " lines were refused as well");
}

std::string applyInput(const LineInput& input, Session& session, AudioOutput& output,
                       MuteRequester requester) {
    if (const auto* action = std::get_if<Action>(&input)) return session.submit({*action}).error;
    if (const auto* control = std::get_if<OwnedControl>(&input)) return applyControl(*control, session);
    if (const auto* silence = std::get_if<SilenceControl>(&input))
        return applySilence(output.silence(), *silence, requester);
    return {};
}

} // namespace physvib
