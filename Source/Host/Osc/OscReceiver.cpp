// SPDX-License-Identifier: GPL-3.0-or-later
// OscReceiver, which dispatches messages by their addresses; OscClock; PhoneSensors.
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

std::string_view toText(std::span<const char> bytes) { return {bytes.data(), bytes.size()}; }

/// The address of a packet that is not valid OSC, as far as it resembles one.
std::string_view readAddress(std::span<const char> bytes) {
    const std::string_view text = toText(bytes);
    return text.starts_with('/') ? text.substr(0, text.find('\0')) : std::string_view{};
}

/// Whether that address requests silence, also as an OSC pattern ("/physvib/sil*").
bool isForSilence(std::string_view address) {
    return !isReply(address) && ((address.starts_with(oscPrefix) && containsSilenceWord(address)) ||
                                 matchesOscPattern(address, oscSilenceAddress));
}

/// Whether a packet that cannot be read may have been meant for silence.
bool resemblesSilence(std::span<const char> bytes) {
    const std::string_view text = toText(bytes);
    if (containsSilenceWord(text)) return true;
    for (std::size_t at = text.find('/'); at != text.npos; at = text.find('/', text.find('\0', at)))
        if (isForSilence(text.substr(at, text.find('\0', at) - at))) return true;
    return false;
}

/// What a message to such an address requests. A malformed message has an error and still requests silence.
/// The control needs no scene.
Result<SilenceControl> readSilence(const OscMessage& message) {
    if (message.address != oscSilenceAddress) return Failure{"expected " + std::string(oscSilenceAddress)};
    const auto plain = parseOscValues(oscSilenceAddress.substr(oscPrefix.size()), message.values);
    return plain ? readPlainSilence(plain.value.values) : Failure{plain.error};
}

} // namespace

OscReceiver::OscReceiver(Session& session, MessageRouter& messages, OscHooks hooks, double phoneAngleRadians)
    : session_{session}
    , messages_{messages}
    , hooks_{std::move(hooks)}
    , sensors_{phoneAngleRadians} {}

void OscReceiver::receive(std::span<const char> bytes, const OscClock& clock,
                          std::vector<std::vector<char>>& answers, std::uint64_t silences,
                          const UdpSender& from) {
    silences_ = silences;
    origin_.from = from;
    ++counts_.packets;
    refusals_.clear();
    const auto read = readOscPacket(bytes);
    if (!read) {
        ++counts_.malformed;
        origin_.address = readAddress(bytes);
        refuse(origin_.address, resemblesSilence(bytes) ? silence(Failure{read.error}, answers) : read.error);
    }
    for (const OscMessage& message : read.value) {
        ++counts_.messages;
        origin_.address = message.address;
        const std::string error = execute(message, clock, answers);
        if (error.empty()) continue;
        ++counts_.refused;
        refuse(message.address, error);
    }
}

OscRefusal makeRefusal(std::string_view address, std::string_view reason) {
    return {printable(address), cleanLine(reason)};
}

void OscReceiver::refuse(std::string_view address, std::string_view reason) {
    OscRefusal refusal = makeRefusal(address, reason);
    counts_.lastError = refusal.reason;
    if (!isReply(address)) refusals_.push_back(std::move(refusal));
}

std::string OscReceiver::execute(const OscMessage& message, const OscClock& clock,
                                 std::vector<std::vector<char>>& answers) {
    if (isForSilence(message.address)) return silence(readSilence(message), answers);
    if (hooks_.closed)
        if (auto reason = hooks_.closed(); !reason.empty()) return reason;
    // phone sensors have no address with our prefix: /physvib/gravity is an input
    const bool isOurs = message.address.starts_with(oscPrefix);
    if (const auto* format = isOurs ? nullptr : sensorFormat(message.address)) {
        const auto gravity = sensors_.read(*format, message);
        return gravity && gravity.value ? hooks_.apply(Action{*gravity.value}, origin_) : gravity.error;
    }
    if (!isOurs)
        return inQuotes(message.address) + ": expected an address that begins with " +
               std::string(oscPrefix) + ", or one of a sensor program";
    const auto plain =
        parseOscValues(std::string_view{message.address}.substr(oscPrefix.size()), message.values);
    if (!plain) return plain.error;
    if (std::ranges::find(messageTable, plain.value.name, &MessageDescription::name) != messageTable.end())
        return route(plain.value, message.tag, clock, answers);
    auto input = readPlainInput(plain.value, session_.world().state().scene->materials, session_.channels());
    return input ? hooks_.apply(input.value, origin_) : input.error;
}

std::string OscReceiver::silence(const Result<SilenceControl>& request,
                                 std::vector<std::vector<char>>& answers) {
    SilenceControl control = request.value;
    control.number = control.isOn ? ++silences_ : silences_;
    const std::string error = hooks_.apply(control, origin_);
    if (error.empty())
        answers.push_back(
            oscPacket(std::string(oscAnswerPrefix) + "silence", {"", {{"on", control.isOn ? 1.0 : 0.0}}}));
    return request ? error : request.error + std::string(silencedAnyway);
}

std::string OscReceiver::route(const PlainMessage& plain, OscTag tag, const OscClock& clock,
                               std::vector<std::vector<char>>& answers) {
    MessageTag messageTag;
    const bool isTagged = tag != oscNow && clock.isReady(); // before the first block, every message acts now
    if (isTagged) messageTag.sessionNs = clock.sessionNsFromUnix(unixNsFromTag(tag));
    auto answer = messages_.handle(plain, isTagged ? &messageTag : nullptr, hooks_.clips);
    if (messageTag.isLate && answer) ++counts_.late;
    if (answer.value.name.empty()) return answer.error;
    if (answer.value.name == "status") addCounts(answer.value);
    answers.push_back(oscPacket(std::string(oscAnswerPrefix) + answer.value.name, answer.value));
    return {};
}

void OscReceiver::addCounts(PlainMessage& answer) const {
    for (const auto& [name, count] : {std::pair{"osc_packets", counts_.packets},
                                      {"osc_bad", counts_.malformed},
                                      {"osc_lost", counts_.lost},
                                      {"osc_refused", counts_.refused},
                                      {"osc_late", counts_.late},
                                      {"osc_held_back", counts_.heldBack}})
        answer.values.push_back({name, static_cast<double>(count)});
}

PlainMessage OscReceiver::status() {
    auto answer = messages_.handle({"status", {}}).value;
    addCounts(answer);
    return answer;
}

std::uint64_t countSilenceRequests(std::span<const char> bytes) {
    if (!containsSilenceWord(toText(bytes)) &&
        toText(bytes).find_first_of(oscPatternCharacters) == std::string_view::npos)
        return 0;
    const auto read = readOscPacket(bytes);
    const auto silences = [](const OscMessage& message) {
        return isForSilence(message.address) && readSilence(message).value.isOn;
    };
    return read ? static_cast<std::uint64_t>(std::ranges::count_if(read.value, silences))
                : static_cast<std::uint64_t>(resemblesSilence(bytes));
}

// Converts OSC time tags, and estimates the system time at which the session started.

namespace {

constexpr std::int64_t secondNs = 1'000'000'000, era = std::int64_t{1} << 32;

template <class Clock>
std::int64_t clockNs() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now().time_since_epoch()).count();
}

} // namespace

std::int64_t unixNsFromTag(OscTag tag) noexcept {
    auto seconds = static_cast<std::int64_t>(tag >> 32);
    if (seconds < era / 2) seconds += era;
    const auto fraction = static_cast<std::int64_t>(
        ((tag & 0xffff'ffffu) * static_cast<std::uint64_t>(secondNs) + (std::uint64_t{1} << 31)) >> 32);
    return (seconds - oscEpochSeconds) * secondNs + fraction;
}

OscTag tagFromUnixNs(std::int64_t unixNs) noexcept {
    const std::int64_t since = std::max<std::int64_t>(0, unixNs);
    const auto fraction =
        ((static_cast<std::uint64_t>(since % secondNs) << 32) + static_cast<std::uint64_t>(secondNs) / 2) /
        static_cast<std::uint64_t>(secondNs);
    return (static_cast<OscTag>(since / secondNs + oscEpochSeconds) << 32) + fraction;
}

std::int64_t unixMinusSteadyNs() noexcept {
    std::int64_t shortestNs = INT64_MAX, offsetNs = 0;
    for (int k = 0; k < 3; ++k) { // the thread may be interrupted between two clock reads
        const std::int64_t before = clockNs<std::chrono::steady_clock>(),
                           unix = clockNs<std::chrono::system_clock>(),
                           after = clockNs<std::chrono::steady_clock>();
        if (after - before >= shortestNs) continue;
        shortestNs = after - before;
        offsetNs = unix - before - shortestNs / 2;
    }
    return offsetNs;
}

void OscClock::update(const OutputMoment& moment, std::int64_t unixMinusSteadyNs) noexcept {
    if (moment.steadyNs == 0) return;
    clock_.add({moment.sessionNs + moment.lagNs, moment.steadyNs});
    outputLatencyNs_ = moment.lagNs;
    const std::int64_t estimateNs = clock_.steadyAt(0) + unixMinusSteadyNs,
                       errorNs = estimateNs - startUnixNs_;
    if (std::abs(errorNs) > jumpNs) { // first estimate, another device, or the system clock was set
        startUnixNs_ = estimateNs;
        settlesAtNs_ = moment.steadyNs + settleNs;
    } else if (moment.steadyNs < settlesAtNs_) {
        startUnixNs_ = std::min(startUnixNs_, estimateNs);
    } else if (std::abs(errorNs) > slackNs) {
        const std::int64_t maxStepNs = (moment.steadyNs - updatedAtNs_) * maxSlewPpm / 1'000'000;
        startUnixNs_ += std::clamp(errorNs, -maxStepNs, maxStepNs);
    }
    updatedAtNs_ = moment.steadyNs;
}

// Adds up gravity and motion readings of a phone, and rotates them by the angle at which it is held.

namespace {

bool matchesFormat(std::string_view address, std::string_view format) {
    if (!format.starts_with('*')) return address == format;
    const auto rest = address.substr(std::min<std::size_t>(1, address.size())).find('/'); // skips the name
    return rest != std::string_view::npos && address.substr(rest + 1) == format.substr(1);
}

bool isReading(const OscValue& value) {
    return std::holds_alternative<double>(value) && std::isfinite(std::get<double>(value));
}

double bounded(double acceleration) {
    return std::clamp(acceleration, -sceneLimits::maxAccelerationMetresPerSecond2,
                      sceneLimits::maxAccelerationMetresPerSecond2);
}

} // namespace

const SensorFormat* sensorFormat(std::string_view address) noexcept {
    const auto found = std::ranges::find_if(
        sensorFormats, [&](const SensorFormat& format) { return matchesFormat(address, format.address); });
    return found == sensorFormats.end() ? nullptr : &*found;
}

Result<std::optional<GravityAction>> PhoneSensors::read(const SensorFormat& format,
                                                        const OscMessage& message) {
    using Part = SensorFormat::Part;
    const bool isAxis = format.part == Part::x || format.part == Part::y || format.part == Part::unused;
    const std::size_t valueCount = isAxis ? 1 : 3;
    if (message.values.size() != valueCount || !std::ranges::all_of(message.values, isReading))
        return Failure{printable(message.address) + ": expected " + std::to_string(valueCount) +
                       (isAxis ? " number" : " numbers")};
    const auto reading = [&](std::size_t i) {
        return format.metresPerSecond2PerUnit * std::get<double>(message.values[i]);
    };
    switch (format.part) {
    case Part::x: gravity_.x = reading(0); break;
    case Part::y: gravity_.y = reading(0); break;
    case Part::unused: return std::optional<GravityAction>{};
    case Part::motion: motion_ = {reading(0), reading(1)}; break;
    case Part::pull: motion_ = {}; [[fallthrough]];
    case Part::gravity: gravity_ = {reading(0), reading(1)};
    }
    const Acceleration sum{gravity_.x + motion_.x, gravity_.y + motion_.y};
    if (hasReported_ &&
        std::hypot(sum.x - lastReported_.x, sum.y - lastReported_.y) < minChangeMetresPerSecond2)
        return std::optional<GravityAction>{};
    lastReported_ = sum;
    hasReported_ = true;
    const double c = std::cos(phoneAngleRadians_), s = std::sin(phoneAngleRadians_);
    return std::optional{GravityAction{{bounded(c * sum.x - s * sum.y), bounded(s * sum.x + c * sum.y)}}};
}

} // namespace physvib
