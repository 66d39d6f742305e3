// SPDX-License-Identifier: GPL-3.0-or-later
// Dispatches an OSC message by its address: silence, message, input or control, or phone sensor.
#include "Host/Osc/OscDoor.h"
#include "Io/Text/NumberText.h"
#include <algorithm>

namespace physvib {
namespace {

/// Whether a program such as this one sends that address by itself.
bool isReply(std::string_view address) {
    return address.starts_with(oscAnswerPrefix) || address == oscErrorAddress || address == oscHitAddress;
}

std::string_view textOf(std::span<const char> bytes) { return {bytes.data(), bytes.size()}; }

/// The address of a packet that is not valid OSC, as far as it resembles one.
std::string_view addressIn(std::span<const char> bytes) {
    const std::string_view text = textOf(bytes);
    return text.starts_with('/') ? text.substr(0, text.find('\0')) : std::string_view{};
}

/// An address of silence, also as a pattern of OSC ("/physvib/sil*"), which no other address may be.
bool isForSilence(std::string_view address) {
    return !isReply(address) && ((address.starts_with(oscPrefix) && namesSilence(address)) ||
                                 matchesOscPattern(address, oscSilenceAddress));
}

/// Whether a packet that cannot be read may have been meant for silence.
bool resemblesSilence(std::span<const char> bytes) {
    const std::string_view text = textOf(bytes);
    if (namesSilence(text)) return true;
    for (std::size_t at = text.find('/'); at != text.npos; at = text.find('/', text.find('\0', at)))
        if (isForSilence(text.substr(at, text.find('\0', at) - at))) return true;
    return false;
}

/// What a message to such an address requests. A malformed message has an error and still requests silence.
/// The control needs no scene.
Result<SilenceControl> silenceOf(const OscMessage& message) {
    if (message.address != oscSilenceAddress) return Failure{"expected " + std::string(oscSilenceAddress)};
    const auto plain = plainOf(oscSilenceAddress.substr(oscPrefix.size()), message.values);
    return plain ? readPlainSilence(plain.value.values) : Failure{plain.error};
}

bool isMessage(const std::string& name) {
    return std::ranges::find(messageTable, name, &MessageDescription::name) != messageTable.end();
}

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
        origin_.address = addressIn(bytes);
        refuse(origin_.address, resemblesSilence(bytes) ? silence(Failure{read.error}, answers) : read.error);
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

OscRefusal refusalOf(std::string_view address, std::string_view reason) {
    return {printable(address), cleanLine(reason)};
}

void OscDoor::refuse(std::string_view address, std::string_view reason) {
    OscRefusal refusal = refusalOf(address, reason);
    counts_.fault = refusal.reason;
    if (!isReply(address)) refusals_.push_back(std::move(refusal));
}

std::string OscDoor::act(const OscMessage& message, const OscClock& clock,
                         std::vector<std::vector<char>>& answers) {
    if (isForSilence(message.address)) return silence(silenceOf(message), answers);
    if (hooks_.closed)
        if (auto why = hooks_.closed(); !why.empty()) return why;
    // phone sensors have no address with our prefix: /physvib/gravity is an input
    const bool isOurs = message.address.starts_with(oscPrefix);
    if (const auto* format = isOurs ? nullptr : sensorFormat(message.address)) return turn(*format, message);
    if (!isOurs)
        return inQuotes(message.address) + ": expected an address that begins with " +
               std::string(oscPrefix) + ", or one of a sensor program";
    const auto plain = plainOf(std::string_view{message.address}.substr(oscPrefix.size()), message.values);
    if (!plain) return plain.error;
    if (isMessage(plain.value.name)) return route(plain.value, message.tag, clock, answers);
    return actPlain(plain.value);
}

std::string OscDoor::actPlain(const PlainMessage& plain) {
    auto input = readPlainInput(plain, session_.world().state().scene->materials, session_.channels());
    return input ? hooks_.act(input.value, origin_) : input.error;
}

std::string OscDoor::silence(const Result<SilenceControl>& asked, std::vector<std::vector<char>>& answers) {
    SilenceControl control = asked.value;
    control.number = control.isOn ? ++silences_ : silences_;
    const std::string fault = hooks_.act(control, origin_);
    if (fault.empty())
        answers.push_back(
            oscPacket(std::string(oscAnswerPrefix) + "silence", {"", {{"on", control.isOn ? 1.0 : 0.0}}}));
    return asked ? fault : asked.error + std::string(silencedAllTheSame);
}

std::string OscDoor::turn(const SensorFormat& format, const OscMessage& message) {
    const auto gravity = sensors_.take(format, message);
    return gravity && gravity.value ? hooks_.act(Action{*gravity.value}, origin_) : gravity.error;
}

std::string OscDoor::route(const PlainMessage& plain, OscTag tag, const OscClock& clock,
                           std::vector<std::vector<char>>& answers) {
    MessageTag at;
    const bool isTagged = tag != oscNow && clock.isReady(); // before the first block, every message acts now
    if (isTagged) at.sessionNs = clock.sessionNs(unixNsOf(tag));
    auto answer = messages_.take(plain, isTagged ? &at : nullptr, hooks_.clips);
    if (at.isLate && answer) ++counts_.late;
    if (answer.value.name.empty()) return answer.error;
    if (answer.value.name == "status") addCounts(answer.value);
    answers.push_back(oscPacket(std::string(oscAnswerPrefix) + answer.value.name, answer.value));
    return {};
}

void OscDoor::addCounts(PlainMessage& answer) const {
    for (const auto& [name, count] : {std::pair{"osc_packets", counts_.packets},
                                      {"osc_bad", counts_.bad},
                                      {"osc_lost", counts_.lost},
                                      {"osc_refused", counts_.refused},
                                      {"osc_late", counts_.late},
                                      {"osc_held_back", counts_.held}})
        answer.values.push_back({name, static_cast<double>(count)});
}

PlainMessage OscDoor::status() {
    auto answer = messages_.take({"status", {}}).value;
    addCounts(answer);
    return answer;
}

std::uint64_t silencesIn(std::span<const char> bytes) {
    if (!namesSilence(textOf(bytes)) &&
        textOf(bytes).find_first_of(oscPatternMarks) == std::string_view::npos)
        return 0;
    const auto read = readOscPacket(bytes);
    const auto silences = [](const OscMessage& message) {
        return isForSilence(message.address) && silenceOf(message).value.isOn;
    };
    return read ? static_cast<std::uint64_t>(std::ranges::count_if(read.value, silences))
                : static_cast<std::uint64_t>(resemblesSilence(bytes));
}

} // namespace physvib
