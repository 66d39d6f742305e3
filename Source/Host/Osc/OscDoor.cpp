// SPDX-License-Identifier: GPL-3.0-or-later
// Which of the kinds an address is; what they mean stands in the rooms where lines are taken.
#include "Host/Osc/OscDoor.h"
#include "Io/Text/NumberText.h"
#include <algorithm>

namespace physvib {
namespace {

/// What such a program as this sends by itself.
bool isReply(std::string_view address) { return address.starts_with(oscAnswerPrefix) || address == oscErrorAddress || address == oscHitAddress; }

/// Of a packet that is none of OSC's, as far as it looks like one.
std::string_view addressIn(std::span<const char> bytes) {
    const std::string_view text{bytes.data(), bytes.size()};
    return text.starts_with('/') ? text.substr(0, text.find('\0')) : std::string_view{};
}

bool isMessage(const std::string& name) { return std::ranges::find(messageTable, name, &MessageDescription::name) != messageTable.end(); }

} // namespace

OscDoor::OscDoor(Session& session, MessageRouter& messages, OscHooks hooks, double turnRadians)
    : session_{session}
    , messages_{messages}
    , hooks_{std::move(hooks)}
    , sensors_{turnRadians} {}

void OscDoor::take(std::span<const char> bytes, const OscClock& clock,
                   std::vector<std::vector<char>>& answers, std::uint64_t silences, const OscSender& from) {
    silences_ = silences;
    origin_.from = from;
    ++counts_.packets;
    refusals_.clear();
    const auto read = readOscPacket(bytes);
    if (!read) {
        ++counts_.bad;
        refuse(addressIn(bytes), read.error);
    }
    for (const OscMessage& message : read.value) {
        ++counts_.messages;
        origin_.address = message.address;
        const std::string fault = act(message, clock, answers);
        if (fault.empty()) continue;
        ++counts_.refused;
        refuse(message.address, fault);
    }
}

OscRefusal refusalOf(std::string_view address, std::string_view reason) { return {printable(address), cleanLine(reason)}; }

void OscDoor::refuse(std::string_view address, std::string_view reason) {
    OscRefusal refusal = refusalOf(address, reason);
    counts_.fault = refusal.reason;
    if (!isReply(address)) refusals_.push_back(std::move(refusal));
}

std::string OscDoor::act(const OscMessage& message, const OscClock& clock, std::vector<std::vector<char>>& answers) {
    if (hooks_.closed && message.address != oscSilenceAddress)
        if (auto why = hooks_.closed(); !why.empty()) return why;
    const bool isOurs = message.address.starts_with(oscPrefix); // no phone is called so: /physvib/gravity is an input
    if (const auto* format = isOurs ? nullptr : sensorFormat(message.address)) return turn(*format, message);
    if (!isOurs) return inQuotes(message.address) + ": expected an address that begins with " + std::string(oscPrefix) + ", or one of a sensor program";
    const auto plain = plainOf(std::string_view{message.address}.substr(oscPrefix.size()), message.values);
    if (!plain) return plain.error;
    if (isMessage(plain.value.name)) return route(plain.value, message.tag, clock, answers);
    return actPlain(plain.value, answers);
}

std::string OscDoor::actPlain(const PlainMessage& plain, std::vector<std::vector<char>>& answers) {
    auto input = readPlainInput(plain, session_.world().state().scene->materials, session_.channels());
    if (!input) return input.error;
    auto* silence = std::get_if<SilenceControl>(&input.value);
    if (silence != nullptr) silence->number = silence->isOn ? ++silences_ : silences_;
    std::string fault = hooks_.act(input.value, origin_);
    if (silence != nullptr && fault.empty())
        answers.push_back(oscPacket(std::string(oscAnswerPrefix) + plain.name,
                                    {plain.name, {{"on", silence->isOn ? 1.0 : 0.0}}}));
    return fault;
}

std::string OscDoor::turn(const SensorFormat& format, const OscMessage& message) {
    const auto gravity = sensors_.take(format, message);
    return gravity && gravity.value ? hooks_.act(Action{*gravity.value}, origin_) : gravity.error;
}

std::string OscDoor::route(const PlainMessage& plain, OscTag tag, const OscClock& clock, std::vector<std::vector<char>>& answers) {
    MessageTag at;
    const bool isTagged = tag != oscNow && clock.isReady(); // before the first block all is now
    if (isTagged) at.sessionNs = clock.sessionNs(unixNsOf(tag));
    auto answer = messages_.take(plain, isTagged ? &at : nullptr, hooks_.clips);
    if (at.isLate && answer) ++counts_.late;
    if (answer.value.name.empty()) return answer.error;
    if (answer.value.name == "status") addCounts(answer.value);
    answers.push_back(oscPacket(std::string(oscAnswerPrefix) + answer.value.name, answer.value));
    return {};
}

void OscDoor::addCounts(PlainMessage& answer) const {
    for (const auto& [name, count] : {std::pair{"osc_packets", counts_.packets}, {"osc_bad", counts_.bad}, {"osc_lost", counts_.lost}, {"osc_refused", counts_.refused}, {"osc_late", counts_.late}, {"osc_held_back", counts_.held}})
        answer.values.push_back({name, static_cast<double>(count)});
}

PlainMessage OscDoor::status() {
    auto answer = messages_.take({"status", {}}).value;
    addCounts(answer);
    return answer;
}

// Read as act() reads it; a control needs no scene.
std::uint64_t silencesIn(std::span<const char> bytes) {
    if (std::string_view(bytes.data(), bytes.size()).find(oscSilenceAddress) == std::string_view::npos)
        return 0;
    return static_cast<std::uint64_t>(
        std::ranges::count_if(readOscPacket(bytes).value, [](const OscMessage& message) {
            if (message.address != oscSilenceAddress) return false;
            const auto plain = plainOf(oscSilenceAddress.substr(oscPrefix.size()), message.values);
            if (!plain) return false;
            const auto input = readPlainInput(plain.value, {}, 1);
            const auto* silence = std::get_if<SilenceControl>(&input.value);
            return silence != nullptr && silence->isOn;
        }));
}

} // namespace physvib
