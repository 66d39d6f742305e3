// SPDX-License-Identifier: GPL-3.0-or-later
// Passes OSC messages from the port's thread to the message thread.
#include "Mixer/Desk/DeskOsc.h"
#include <numbers>
#include <utility>

namespace physvib {
namespace {

constexpr std::size_t mostWaiting = 1000; // reached only if the message thread hangs

OscSettings settingsOf(const OscChoice& choice) {
    OscSettings settings;
    settings.address = choice.use == OscUse::anyComputer ? oscAnyComputer : oscThisComputer;
    if (choice.use != OscUse::off) settings.port = oscUsualPort;
    settings.receiver = choice.receiver;
    settings.turnRadians = choice.turnDegrees * std::numbers::pi / 180.0;
    return settings;
}

} // namespace

DeskOsc::DeskOsc(const OscChoice& choice, Session& session, AudioOutput& output,
                 std::function<std::string(const LineInput&)> act, std::function<void()> takePlayed)
    : output_{output}
    , act_{std::move(act)}
    , takePlayed_{std::move(takePlayed)}
    , messages_{session}
    , port_{std::make_unique<OscPort>(
          settingsOf(choice), session, messages_, output,
          OscHooks{[this](const LineInput& input, const OscOrigin& origin) { return take(input, origin); },
                   [this] { return std::string{output_.isLent() ? "a study is running" : ""}; }})} {
    if (!choice.receiver.empty() && port_->error().empty()) startTimer(tellMilliseconds);
}

DeskOsc::~DeskOsc() {
    stopTimer();
    port_.reset(); // after this no thread triggers an update
    cancelPendingUpdate();
}

// Silence takes effect at once; the message thread only displays it.
std::string DeskOsc::take(const LineInput& input, const OscOrigin& origin) {
    const auto* silence = std::get_if<SilenceControl>(&input);
    const bool isDone = silence != nullptr && silence->isOn;
    if (isDone) takeSilence(output_.silence(), *silence, MuteRequester::osc);
    const std::lock_guard lock{mutex_};
    if (waiting_.size() == mostWaiting) return isDone ? "" : "too many inputs at once";
    waiting_.push_back({input, origin});
    triggerAsyncUpdate();
    return {};
}

void DeskOsc::handleAsyncUpdate() {
    std::vector<Waiting> inputs;
    {
        const std::lock_guard lock{mutex_};
        inputs.swap(waiting_);
    }
    for (const Waiting& one : inputs) {
        const std::string fault = act_(one.input);
        if (fault.empty()) continue;
        port_->refuse(one.origin, fault);
        fault_ = fault;
        ++refused_;
    }
}

OscStatus DeskOsc::status() const {
    OscStatus status = port_->status();
    status.counts.refused += refused_;
    if (status.counts.fault.empty()) status.counts.fault = fault_;
    return status;
}

} // namespace physvib
