// SPDX-License-Identifier: GPL-3.0-or-later
// Polls standard input, cuts it into lines, and hands each to the session.
#include "CommandLine/InputListener.h"
#include "Files/InputLine.h"
#include <iostream>
#include <poll.h>
#include <type_traits>
#include <unistd.h>

namespace physvib {

namespace {

constexpr int pollMilliseconds = 50; // only the end of the program waits for it
constexpr std::size_t longestLine = 65'536;

} // namespace

InputListener::InputListener(Session& session, AudioOutput& output)
    : session_{session}
    , output_{output}
    , thread_{[this] { run(); }} {}

InputListener::~InputListener() {
    stop_ = true;
    thread_.join();
}

void InputListener::run() {
    std::string text;
    char bytes[4096];
    while (!stop_) {
        pollfd input{STDIN_FILENO, POLLIN, 0};
        if (poll(&input, 1, pollMilliseconds) <= 0) continue;
        const ssize_t count = read(STDIN_FILENO, bytes, sizeof bytes);
        if (count <= 0) return;
        text.append(bytes, static_cast<std::size_t>(count));
        for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n')) {
            take(text.substr(0, end));
            text.erase(0, end + 1);
        }
        if (text.size() > longestLine) text.clear(); // never a line of ours
    }
}

void InputListener::take(const std::string& line) {
    const std::string name = "standard input:" + std::to_string(++lines_);
    if (line.find_first_not_of(" \t\r") == std::string::npos) return;
    const auto read = readInputLine(line, name, session_.state().scene->materials, session_.channels());
    std::string fault = read.error;
    if (read) {
        if (const auto* action = std::get_if<Action>(&read.value)) {
            fault = session_.act(*action);
            if (!fault.empty()) fault = name + ": " + fault;
        } else if (const auto* control = std::get_if<RenderControl>(&read.value)) {
            if (session_.post(*control) < 0) fault = name + ": too many controls at once";
        } else {
            output_.setSilent(std::get<SilenceControl>(read.value).isOn);
        }
    }
    if (!fault.empty()) std::cerr << "physvib: " + fault + "\n";
}

} // namespace physvib
