// SPDX-License-Identifier: GPL-3.0-or-later
// OSC controls of the output tab: accepted senders, receiver of impacts, and orientation of a phone.
#include "Mixer/Output/OutputTab.h"
#include "Mixer/Window/Parts.h"

namespace physvib {
namespace {

// in the order of OscUse
constexpr std::array<const char*, 3> oscUses{"from nobody", "from this computer",
                                             "from any computer, and phones"};
struct PhoneHold {
    const char* words;
    double turnDegrees;
};
// direction of its top edge
constexpr std::array<PhoneHold, 4> phoneHolds{
    {{"up", 0.0}, {"left", 90.0}, {"down", 180.0}, {"right", -90.0}}};
constexpr int nobodyId = 1, knownReceiverId = 2, otherReceiverId = 3; // item ids of the list of receivers

} // namespace

void OutputTab::prepareOsc() {
    caption(oscName_, "Messages by OSC");
    osc_.setTitle("OSC");
    osc_.setTooltip(
        "Who may strike, tilt and set gains by messages over the network: phones, Pd, Max (Docs/osc.md)");
    for (int use = 0; use < static_cast<int>(oscUses.size()); ++use)
        osc_.addItem(oscUses[static_cast<std::size_t>(use)], use + 1);
    caption(hitsName_, "Hits by OSC to");
    hits_.setTitle("Hits by OSC");
    hits_.setTooltip(
        "HOST:PORT of a program that hears of each hit as it is felt, and of the status once a second");
    caption(phoneName_, "A phone's top is");
    phone_.setTitle("Phone");
    phone_.setTooltip("How a phone is held that tilts the world by OSC: where its top points");
    for (int k = 0; k < static_cast<int>(phoneHolds.size()); ++k)
        phone_.addItem(phoneHolds[static_cast<std::size_t>(k)].words, k + 1);
    for (auto* box : {&osc_, &phone_}) box->onChange = [this] { listen(); };
    hits_.onChange = [this] { chooseReceiver(); };
}

void OutputTab::listen() {
    OscChoice choice = desk_.inputs().choice();
    choice.use = static_cast<OscUse>(osc_.getSelectedItemIndex());
    if (const int hold = phone_.getSelectedItemIndex(); hold >= 0)
        choice.turnDegrees = phoneHolds[static_cast<std::size_t>(hold)].turnDegrees;
    useOsc(choice, "Messages by OSC: ");
}

void OutputTab::tellHits(const juce::String& receiver) {
    OscChoice choice = desk_.inputs().choice();
    choice.receiver = receiver.trim().toStdString();
    useOsc(choice, "Hits by OSC: ");
}

void OutputTab::useOsc(const OscChoice& choice, const juce::String& what) {
    if (const auto error = desk_.inputs().use(choice); !error.empty()) desk_.report(what + utf8(error));
    showOsc();
}

void OutputTab::chooseReceiver() {
    const int id = hits_.getSelectedId();
    if (id != otherReceiverId) return tellHits(id == knownReceiverId ? hits_.getText() : juce::String{});
    showOsc();
    ask("Hits by OSC", "HOST:PORT of the program", hits_.getItemText(hits_.indexOfItemId(knownReceiverId)),
        [this](const juce::String& receiver) { tellHits(receiver); });
}

// A receiver stays in the list when it is switched off.
void OutputTab::showOsc() {
    const OscChoice& choice = desk_.inputs().choice();
    const auto known = choice.receiver.empty() ? hits_.getItemText(hits_.indexOfItemId(knownReceiverId))
                                               : utf8(choice.receiver);
    osc_.setSelectedItemIndex(static_cast<int>(choice.use), juce::dontSendNotification);
    hits_.clear(juce::dontSendNotification);
    hits_.addItem("nobody", nobodyId);
    if (known.isNotEmpty()) hits_.addItem(known, knownReceiverId);
    hits_.addItem("another program" + dots(), otherReceiverId);
    hits_.setSelectedId(choice.receiver.empty() ? nobodyId : knownReceiverId, juce::dontSendNotification);
    const auto hold = std::ranges::find(phoneHolds, choice.turnDegrees, &PhoneHold::turnDegrees);
    phone_.setSelectedItemIndex(static_cast<int>(hold - phoneHolds.begin()), juce::dontSendNotification);
}

juce::String OutputTab::oscState(Shade& state) const {
    const auto osc = desk_.inputs().status();
    state = osc ? Shade::text : Shade::muted;
    if (!osc) return "none";
    const OscCounts& c = osc->counts;
    const auto count = [](std::uint64_t n) { return juce::String{static_cast<juce::int64>(n)}; };
    if (c.wrong() + c.lost + c.late + osc->unsent > 0) state = Shade::now;
    juce::StringArray parts;
    if (!osc->address.empty())
        parts.add(utf8(osc->address) + ": " + count(c.messages - c.refused) + " good, " + count(c.wrong()) +
                  " bad, " + count(c.late) + " late" +
                  (c.lost > 0 ? ", " + count(c.lost) + " lost" : juce::String{}));
    if (!desk_.inputs().choice().receiver.empty())
        parts.add("to " + utf8(desk_.inputs().choice().receiver) + ": " + count(osc->sent) + " sent" +
                  (osc->unsent > 0 ? ", " + count(osc->unsent) + " not taken" : juce::String{}));
    const auto words = parts.joinIntoString("; ");
    return c.fault.empty() ? words : words + "; " + utf8(c.fault);
}

} // namespace physvib
