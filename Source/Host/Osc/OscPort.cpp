// SPDX-License-Identifier: GPL-3.0-or-later
// Receives packets, follows the device's clock, and sends the session's status once a second.
#include "Host/Osc/OscPort.h"
#include <chrono>

namespace physvib {
namespace {

constexpr int pollMilliseconds = 10;           // polling period of the device's blocks
constexpr std::size_t mostAtOnce = 1000;       // packets per round; pending late refusals
constexpr std::int64_t clockSlackNs = 100'000; // two clocks cannot be read at the same moment

} // namespace

OscPort::OscPort(const OscSettings& settings, Session& session, MessageRouter& messages, OutputClock& device,
                 OscHooks hooks)
    : session_{session}
    , device_{device}
    , input_{session, messages, std::move(hooks), settings.turnRadians} {
    const auto use = [this](UdpSocket& socket, Result<UdpSocket> opened) {
        if (error_.empty()) error_ = opened.error;
        socket = std::move(opened.value);
    };
    if (settings.port) use(in_, UdpSocket::listening(settings.address, *settings.port));
    if (!settings.receiver.empty()) use(out_, UdpSocket::connected(settings.receiver));
    if (!error_.empty()) return;
    if (in_.isOpen()) address_ = settings.address + ":" + std::to_string(in_.port());
    if (in_.isOpen()) reader_ = std::thread{[this] { read(); }};
    thread_ = std::thread{[this] { run(); }};
    if (out_.isOpen()) session_.sinks().attach(*this);
}

OscPort::~OscPort() {
    session_.sinks().detach(*this);
    stop_ = true;
    if (reader_.joinable()) reader_.join();
    if (thread_.joinable()) thread_.join();
}

// A packet that finds the queue full still silences. Its sender gets no reply and may repeat it.
void OscPort::read() {
    while (!stop_) {
        if (!in_.wait(pollMilliseconds)) continue;
        MuteRequests& silence = device_.silence();
        while (!stop_) {
            const auto bytes = in_.receive();
            if (!bytes) break;
            const std::uint64_t before = silence.asked(MuteRequester::osc), asked = silencesIn(*bytes);
            if (asked > 0) silence.request(MuteRequester::osc, before + asked);
            if (!packets_.push({{bytes->begin(), bytes->end()}, in_.sender(), before}, bytes->size()))
                ++lost_;
        }
        lost_ += in_.takeLost();
    }
}

void OscPort::run() {
    while (!stop_) {
        const bool hasCome = packets_.wait(std::chrono::milliseconds{pollMilliseconds});
        followClock();
        if (hasCome || lost_ > 0) receive();
        refuseLate();
        if (out_.isOpen()) tellStatus();
    }
}

void OscPort::followClock() {
    if (const std::int64_t ahead = physvib::unixAheadNs(); std::abs(ahead - unixAheadNs_) > clockSlackNs)
        unixAheadNs_ = ahead;
    const std::lock_guard lock{mutex_};
    clock_.follow(device_.felt(), unixAheadNs_);
}

void OscPort::receive() {
    for (std::size_t taken = 0; taken < mostAtOnce; ++taken) {
        const auto packet = packets_.pop();
        if (!packet) break;
        const std::uint64_t wrong = input_.counts().wrong();
        answers_.clear();
        input_.receive(packet->bytes, clock_, answers_, packet->silences, packet->from);
        if (input_.counts().wrong() != wrong) fault_ = packet->from.text() + ": " + input_.counts().fault;
        reply(packet->bytes.size(), packet->from);
    }
    input_.lose(lost_.exchange(0));
    const std::lock_guard lock{mutex_};
    counts_ = input_.counts();
    counts_.fault = fault_;
}

// Replies go first, so that refusals do not use up their byte limit.
void OscPort::reply(std::size_t packetBytes, const UdpSender& to) {
    if (answers_.empty() && input_.refusals().empty()) return;
    replies_.begin(to.text(), packetBytes, steadyNs());
    for (const auto& answer : answers_)
        if (replies_.mayReply(answer.size())) in_.answer(answer, to);
    for (const OscRefusal& refusal : input_.refusals()) sendRefusal(refusal, to);
    input_.holdBack(replies_.heldBack());
}

void OscPort::sendRefusal(const OscRefusal& refusal, const UdpSender& to) {
    if (!replies_.mayRefuse(refusal.reason)) return;
    const auto bytes = oscWords(std::string(oscErrorAddress), {refusal.address, refusal.reason});
    if (replies_.mayReply(bytes.size())) in_.answer(bytes, to);
}

void OscPort::refuse(const OscOrigin& origin, const std::string& reason) {
    const std::lock_guard lock{mutex_};
    if (late_.size() < mostAtOnce)
        late_.emplace_back(refusalOf(origin.address, reason), origin.from);
    else
        ++lateHeld_;
}

void OscPort::refuseLate() {
    std::vector<std::pair<OscRefusal, UdpSender>> late;
    {
        const std::lock_guard lock{mutex_};
        late.swap(late_);
    }
    if (late.empty()) return;
    for (const auto& [refusal, to] : late) {
        replies_.begin(to.text(), 0, steadyNs());
        sendRefusal(refusal, to);
    }
    input_.holdBack(replies_.heldBack());
    const std::lock_guard lock{mutex_};
    counts_.held = replies_.heldBack();
}

void OscPort::count(bool left) noexcept { (left ? sent_ : unsent_).fetch_add(1, std::memory_order_relaxed); }

// The bundle's tag is that session time on the system's clock.
void OscPort::tellStatus() {
    const std::int64_t now = steadyNs();
    if (now < nextStatusNs_ || !clock_.isReady()) return;
    nextStatusNs_ = now + statusEveryNs;
    const std::int64_t present = session_.timeline().presentNs();
    const PlainMessage status = input_.status();
    count(out_.send(
        oscBundle(std::string(oscAnswerPrefix) + status.name, status, tagOf(clock_.presentUnixNs(present)))));
}

void OscPort::played(const PlayedEvent& played, int sampleRateHz) {
    if (!out_.isOpen() || sampleRateHz == 0) return;
    const CollisionEvent& e = played.event;
    const std::int64_t timeNs = played.isLate ? played.frame * 1'000'000'000 / sampleRateHz : e.timeNs;
    OscTag tag = oscNow;
    if (const std::lock_guard lock{mutex_}; clock_.isReady()) tag = tagOf(clock_.feltUnixNs(timeNs));
    const PlainMessage hit{"hit",
                           {{"session_s", static_cast<double>(timeNs) * 1e-9},
                            {"frequency_hz", e.frequencyHz},
                            {"decay_per_s", e.decayPerSecond},
                            {"amplitude", e.amplitude},
                            {"x_m", e.x},
                            {"y_m", e.y}}};
    count(out_.send(oscBundle(std::string(oscHitAddress), hit, tag)));
}

OscStatus OscPort::status() const {
    const std::lock_guard lock{mutex_};
    OscStatus now{address_, counts_, sent_, unsent_};
    now.counts.held += lateHeld_;
    return now;
}

} // namespace physvib
