// SPDX-License-Identifier: GPL-3.0-or-later
// Dispatches an OSC message by its address: silence, message, input or control, or phone sensor.
#include "Host/Osc/OscReceiver.h"
#include "Io/Text/NumberText.h"
#include "Scene/SceneLimits.h"
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>

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

/// Whether that address requests silence, also as an OSC pattern ("/physvib/sil*").
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

} // namespace

OscReceiver::OscReceiver(Session& session, MessageRouter& messages, OscHooks hooks, double turnRadians)
    : session_{session}
    , messages_{messages}
    , hooks_{std::move(hooks)}
    , sensors_{turnRadians} {}

void OscReceiver::receive(std::span<const char> bytes, const OscClock& clock,
                          std::vector<std::vector<char>>& answers, std::uint64_t silences,
                          const UdpSender& from) {
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

void OscReceiver::refuse(std::string_view address, std::string_view reason) {
    OscRefusal refusal = refusalOf(address, reason);
    counts_.fault = refusal.reason;
    if (!isReply(address)) refusals_.push_back(std::move(refusal));
}

std::string OscReceiver::act(const OscMessage& message, const OscClock& clock,
                             std::vector<std::vector<char>>& answers) {
    if (isForSilence(message.address)) return silence(silenceOf(message), answers);
    if (hooks_.closed)
        if (auto why = hooks_.closed(); !why.empty()) return why;
    // phone sensors have no address with our prefix: /physvib/gravity is an input
    const bool isOurs = message.address.starts_with(oscPrefix);
    if (const auto* format = isOurs ? nullptr : sensorFormat(message.address)) {
        const auto gravity = sensors_.read(*format, message);
        return gravity && gravity.value ? hooks_.act(Action{*gravity.value}, origin_) : gravity.error;
    }
    if (!isOurs)
        return inQuotes(message.address) + ": expected an address that begins with " +
               std::string(oscPrefix) + ", or one of a sensor program";
    const auto plain = plainOf(std::string_view{message.address}.substr(oscPrefix.size()), message.values);
    if (!plain) return plain.error;
    if (std::ranges::find(messageTable, plain.value.name, &MessageDescription::name) != messageTable.end())
        return route(plain.value, message.tag, clock, answers);
    auto input = readPlainInput(plain.value, session_.world().state().scene->materials, session_.channels());
    return input ? hooks_.act(input.value, origin_) : input.error;
}

std::string OscReceiver::silence(const Result<SilenceControl>& asked,
                                 std::vector<std::vector<char>>& answers) {
    SilenceControl control = asked.value;
    control.number = control.isOn ? ++silences_ : silences_;
    const std::string fault = hooks_.act(control, origin_);
    if (fault.empty())
        answers.push_back(
            oscPacket(std::string(oscAnswerPrefix) + "silence", {"", {{"on", control.isOn ? 1.0 : 0.0}}}));
    return asked ? fault : asked.error + std::string(silencedAllTheSame);
}

std::string OscReceiver::route(const PlainMessage& plain, OscTag tag, const OscClock& clock,
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

void OscReceiver::addCounts(PlainMessage& answer) const {
    for (const auto& [name, count] : {std::pair{"osc_packets", counts_.packets},
                                      {"osc_bad", counts_.bad},
                                      {"osc_lost", counts_.lost},
                                      {"osc_refused", counts_.refused},
                                      {"osc_late", counts_.late},
                                      {"osc_held_back", counts_.held}})
        answer.values.push_back({name, static_cast<double>(count)});
}

PlainMessage OscReceiver::status() {
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

// Converts OSC time tags, and estimates the system time at which the session started.

namespace {

constexpr std::int64_t second = 1'000'000'000, era = std::int64_t{1} << 32;

template <class Clock>
std::int64_t nowOf() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now().time_since_epoch()).count();
}

} // namespace

std::int64_t unixNsOf(OscTag tag) noexcept {
    auto seconds = static_cast<std::int64_t>(tag >> 32);
    if (seconds < era / 2) seconds += era;
    const auto fraction = static_cast<std::int64_t>(
        ((tag & 0xffff'ffffu) * static_cast<std::uint64_t>(second) + (std::uint64_t{1} << 31)) >> 32);
    return (seconds - oscEpochSeconds) * second + fraction;
}

OscTag tagOf(std::int64_t unixNs) noexcept {
    const std::int64_t since = std::max<std::int64_t>(0, unixNs);
    const auto fraction =
        ((static_cast<std::uint64_t>(since % second) << 32) + static_cast<std::uint64_t>(second) / 2) /
        static_cast<std::uint64_t>(second);
    return (static_cast<OscTag>(since / second + oscEpochSeconds) << 32) + fraction;
}

std::int64_t unixAheadNs() noexcept {
    std::int64_t best = INT64_MAX, ahead = 0;
    for (int k = 0; k < 3; ++k) { // the thread may be interrupted between two clock reads
        const std::int64_t before = nowOf<std::chrono::steady_clock>(),
                           unix = nowOf<std::chrono::system_clock>(),
                           after = nowOf<std::chrono::steady_clock>();
        if (after - before >= best) continue;
        best = after - before;
        ahead = unix - before - best / 2;
    }
    return ahead;
}

void OscClock::follow(const OutputMoment& moment, std::int64_t unixAheadNs) noexcept {
    if (moment.steadyNs == 0) return;
    clock_.add({moment.sessionNs + moment.behindNs, moment.steadyNs});
    behindNs_ = moment.behindNs;
    const std::int64_t seen = clock_.steadyAt(0) + unixAheadNs, away = seen - beganNs_;
    if (std::abs(away) > jumpNs) { // first estimate, another device, or the system clock was set
        beganNs_ = seen;
        settledNs_ = moment.steadyNs + settleNs;
    } else if (moment.steadyNs < settledNs_) {
        beganNs_ = std::min(beganNs_, seen);
    } else if (std::abs(away) > slackNs) {
        const std::int64_t most = (moment.steadyNs - followedNs_) * maxSlewPpm / 1'000'000;
        beganNs_ += std::clamp(away, -most, most);
    }
    followedNs_ = moment.steadyNs;
}

// Adds up gravity and motion readings of a phone, and rotates them by the angle at which it is held.

namespace {

bool isOf(std::string_view address, std::string_view format) {
    if (!format.starts_with('*')) return address == format;
    const auto rest = address.substr(std::min<std::size_t>(1, address.size())).find('/'); // skips the name
    return rest != std::string_view::npos && address.substr(rest + 1) == format.substr(1);
}

bool isReading(const OscValue& value) {
    return std::holds_alternative<double>(value) && std::isfinite(std::get<double>(value));
}

double bounded(double pull) {
    return std::clamp(pull, -sceneLimits::maxAccelerationMetresPerSecond2,
                      sceneLimits::maxAccelerationMetresPerSecond2);
}

} // namespace

const SensorFormat* sensorFormat(std::string_view address) noexcept {
    const auto found = std::ranges::find_if(
        sensorFormats, [&](const SensorFormat& format) { return isOf(address, format.address); });
    return found == sensorFormats.end() ? nullptr : &*found;
}

Result<std::optional<GravityAction>> PhoneSensors::read(const SensorFormat& format,
                                                        const OscMessage& message) {
    using Part = SensorFormat::Part;
    const bool isAxis = format.part == Part::x || format.part == Part::y || format.part == Part::unused;
    const std::size_t wanted = isAxis ? 1 : 3;
    if (message.values.size() != wanted || !std::ranges::all_of(message.values, isReading))
        return Failure{printable(message.address) + ": expected " + std::to_string(wanted) +
                       (isAxis ? " number" : " numbers")};
    const auto reading = [&](std::size_t i) { return format.toPull * std::get<double>(message.values[i]); };
    switch (format.part) {
    case Part::x: gravity_.x = reading(0); break;
    case Part::y: gravity_.y = reading(0); break;
    case Part::unused: return std::optional<GravityAction>{};
    case Part::motion: motion_ = {reading(0), reading(1)}; break;
    case Part::pull: motion_ = {}; [[fallthrough]];
    case Part::gravity: gravity_ = {reading(0), reading(1)};
    }
    const Pull pull{gravity_.x + motion_.x, gravity_.y + motion_.y};
    if (hasTold_ && std::hypot(pull.x - told_.x, pull.y - told_.y) < leastChange)
        return std::optional<GravityAction>{};
    told_ = pull;
    hasTold_ = true;
    const double c = std::cos(turnRadians_), s = std::sin(turnRadians_);
    return std::optional{GravityAction{{bounded(c * pull.x - s * pull.y), bounded(s * pull.x + c * pull.y)}}};
}

} // namespace physvib
