// SPDX-License-Identifier: GPL-3.0-or-later
// What comes from outside by messages: it moves what the desk shows.
#include "Core/Decibels.h"
#include "Mixer/Desk/Desk.h"
#include "Mixer/Desk/DeskWords.h"
#include <algorithm>
#include <cmath>
#include <utility>

namespace physvib {
namespace {

double stripDb(float gain) { return gain == 0.0f ? leastStripDb : std::clamp(toDecibels(std::abs(static_cast<double>(gain))), leastStripDb, mostStripDb); }

} // namespace

std::string Desk::useOsc(const OscChoice& choice) {
    const OscChoice before = std::exchange(oscChoice_, choice);
    std::string error = openOsc();
    if (error.empty()) return error;
    oscChoice_ = before;
    if (!openOsc().empty()) oscChoice_ = {};
    return error;
}

// What is open is closed first: its port may be the one that is wanted.
std::string Desk::openOsc() {
    osc_.reset();
    oscMessages_ = 0;
    if (oscChoice_.use == OscUse::off && oscChoice_.receiver.empty()) return {};
    osc_ = std::make_unique<DeskOsc>(oscChoice_, session_, output_, [this](const LineInput& input) { return take(input); }, [this] { takePlayed(); });
    std::string error = osc_->error();
    if (!error.empty()) osc_.reset();
    return error;
}

std::string Desk::take(const LineInput& input) {
    if (const auto* action = std::get_if<Action>(&input)) return act(*action);
    if (const auto* control = std::get_if<RenderControl>(&input)) return takeControl(*control);
    if (const auto* silence = std::get_if<SilenceControl>(&input)) {
        std::string fault = takeSilence(output_.silence(), *silence, SilenceHolder::osc);
        showSilence();
        return fault;
    }
    return {};
}

std::string Desk::takeControl(const RenderControl& control) {
    using Kind = RenderControl::Kind;
    const auto strip = static_cast<std::size_t>(control.channel);
    if (control.channel < 0 || control.channel >= mix_.count()) return "expected a channel from 1 to " + std::to_string(mix_.count()) + ", found " + std::to_string(control.channel + 1);
    if (control.kind != Kind::gain && control.kind != Kind::mute) return "expected gain, mute or silence; the rest is set at the desk";
    change("Strips by message", [&](Mix& mix) {
        if (control.kind == Kind::mute) mix.strips[strip].isMuted = control.value != 0.0f;
        else mix.strips[strip].gainDb = stripDb(control.value), mix.strips[strip].isInverted = control.value < 0.0f;
    }, true);
    return {};
}

// What a message strikes stands in the session that is saved.
void Desk::watchOsc() {
    if (!osc_) return;
    const std::uint64_t messages = osc_->status().counts.messages;
    if (std::exchange(oscMessages_, messages) != messages) ++edits_;
}

void Desk::feelAt(const juce::StringArray& files, double shareX, double shareY) { feel(files, {shareX * sceneNow_.fieldWidthMetres, shareY * sceneNow_.fieldHeightMetres}, false); }

void Desk::feelOn(const juce::StringArray& files, int enchanter) { feel(files, placeOf(enchanter), true); }

void Desk::feel(const juce::StringArray& files, const EnchanterPlace& at, bool isAlone) {
    if (files.size() != 1) return report("Expected one clip, found " + juce::String{files.size()} + " files");
    clips_.feel(juce::File{files[0]}, at, isAlone);
}

void Desk::takeFelt(const Result<std::string>& note) {
    if (!note) return report(utf8(note.error));
    ++edits_;
    juce::StringArray news{utf8(note.value), board_ ? "The board plays no clips: it is felt on the device alone" : ""};
    news.removeEmptyStrings();
    if (!news.isEmpty()) tell(news.joinIntoString("; "));
    sendChangeMessage(); // who rests looks again
}

} // namespace physvib
