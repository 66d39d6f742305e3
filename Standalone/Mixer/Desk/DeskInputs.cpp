// SPDX-License-Identifier: GPL-3.0-or-later
// Opens the OSC port, and applies inputs and controls to the mixer.
#include "Mixer/Desk/DeskInputs.h"
#include "Core/Units.h"
#include "Mixer/Desk/Desk.h"
#include <algorithm>
#include <cmath>
#include <utility>

namespace physvib {
namespace {

double stripDb(float gain) {
    return gain == 0.0f
               ? leastStripDb
               : std::clamp(toDecibels(std::abs(static_cast<double>(gain))), leastStripDb, mostStripDb);
}

} // namespace

std::string DeskInputs::use(const OscChoice& choice) {
    const OscChoice before = std::exchange(choice_, choice);
    std::string error = open();
    if (error.empty()) return error;
    choice_ = before;
    if (!open().empty()) choice_ = {};
    return error;
}

// Closes the open port first, because it may be the one to be opened.
std::string DeskInputs::open() {
    osc_.reset();
    messages_ = 0;
    if (choice_.use == OscUse::off && choice_.receiver.empty()) return {};
    osc_ = std::make_unique<DeskOsc>(
        choice_, desk_.session(), desk_.output(), [this](const LineInput& input) { return take(input); },
        [this] { desk_.takePlayed(); });
    std::string error = osc_->error();
    if (!error.empty()) osc_.reset();
    return error;
}

bool DeskInputs::haveCome() {
    if (!osc_) return false;
    const std::uint64_t messages = osc_->status().counts.messages;
    return std::exchange(messages_, messages) != messages;
}

std::string DeskInputs::take(const LineInput& input) {
    if (const auto* action = std::get_if<Action>(&input)) return desk_.world().act(*action);
    if (const auto* control = std::get_if<OwnedControl>(&input)) return take(*control);
    if (const auto* silence = std::get_if<SilenceControl>(&input)) {
        std::string fault = takeSilence(desk_.output().silence(), *silence, MuteRequester::osc);
        desk_.showSilence();
        return fault;
    }
    return {};
}

std::string DeskInputs::take(const RenderControl& control) {
    using Kind = RenderControl::Kind;
    const auto strip = static_cast<std::size_t>(control.channel);
    if (control.channel < 0 || control.channel >= desk_.mix().count())
        return "expected a channel from 1 to " + std::to_string(desk_.mix().count()) + ", found " +
               std::to_string(control.channel + 1);
    if (control.kind != Kind::gain && control.kind != Kind::mute)
        return "expected gain, mute or silence; the rest is set at the desk";
    desk_.change(
        "Strips by message",
        [&](Mix& mix) {
            if (control.kind == Kind::mute)
                mix.strips[strip].isMuted = control.value != 0.0f;
            else
                mix.strips[strip].gainDb = stripDb(control.value),
                mix.strips[strip].isInverted = control.value < 0.0f;
        },
        true);
    return {};
}

} // namespace physvib
