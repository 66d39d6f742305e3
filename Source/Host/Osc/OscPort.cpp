// SPDX-License-Identifier: GPL-3.0-or-later
// Receives packets, follows the device's clock, and sends the session's status once a second.
#include "Host/Osc/OscPort.h"
#include "Core/ClockLaw.h"
#include <chrono>

namespace physvib {
namespace {

constexpr int pollMilliseconds = 10;           // polling period of the device's blocks
constexpr std::size_t maxPerRound = 1000;      // packets per round; pending late refusals
constexpr std::int64_t clockSlackNs = 100'000; // two clocks cannot be read at the same moment

} // namespace

OscPort::OscPort(const OscSettings& settings, Session& session, MessageRouter& messages, OutputClock& device,
                 OscHooks hooks)
    : session_{session}
    , device_{device}
    , receiver_{session, messages, std::move(hooks), settings.phoneAngleRadians} {
    const auto adopt = [this](UdpSocket& socket, Result<UdpSocket> opened) {
        if (error_.empty()) error_ = opened.error;
        socket = std::move(opened.value);
    };
    if (settings.port) adopt(inputSocket_, UdpSocket::listenAt(settings.address, *settings.port));
    if (!settings.receiver.empty()) adopt(outputSocket_, UdpSocket::connectTo(settings.receiver));
    if (!error_.empty()) return;
    if (inputSocket_.isOpen()) address_ = settings.address + ":" + std::to_string(inputSocket_.port());
    if (inputSocket_.isOpen()) reader_ = std::thread{[this] { runReader(); }};
    executor_ = std::thread{[this] { runExecutor(); }};
    if (outputSocket_.isOpen()) session_.sinks().attach(*this);
}

OscPort::~OscPort() {
    session_.sinks().detach(*this);
    isStopping_ = true;
    if (reader_.joinable()) reader_.join();
    if (executor_.joinable()) executor_.join();
}

// A packet that finds the queue full still silences. Its sender gets no reply and may repeat it.
void OscPort::runReader() {
    while (!isStopping_) {
        if (!inputSocket_.wait(pollMilliseconds)) continue;
        MuteRequests& silence = device_.silence();
        while (!isStopping_) {
            const auto bytes = inputSocket_.receive();
            if (!bytes) break;
            const std::uint64_t before = silence.requestCount(MuteRequester::osc),
                                requests = countSilenceRequests(*bytes);
            if (requests > 0) silence.request(MuteRequester::osc, before + requests);
            if (!packets_.push({{bytes->begin(), bytes->end()}, inputSocket_.sender(), before},
                               bytes->size()))
                ++lost_;
        }
        lost_ += inputSocket_.resetDroppedCount();
    }
}

void OscPort::runExecutor() {
    while (!isStopping_) {
        const bool hasPacket = packets_.wait(std::chrono::milliseconds{pollMilliseconds});
        updateClock();
        if (hasPacket || lost_ > 0) receive();
        sendLateRefusals();
        if (outputSocket_.isOpen()) sendStatus();
    }
}

void OscPort::updateClock() {
    if (const std::int64_t differenceNs = physvib::unixMinusSteadyNs();
        std::abs(differenceNs - unixMinusSteadyNs_) > clockSlackNs)
        unixMinusSteadyNs_ = differenceNs;
    const std::lock_guard lock{mutex_};
    clock_.update(device_.latestMoment(), unixMinusSteadyNs_);
}

void OscPort::receive() {
    for (std::size_t executed = 0; executed < maxPerRound; ++executed) {
        const auto packet = packets_.pop();
        if (!packet) break;
        const std::uint64_t failuresBefore = receiver_.counts().failures();
        pendingReplies_.clear();
        receiver_.receive(packet->bytes, clock_, pendingReplies_, packet->silences, packet->from);
        if (receiver_.counts().failures() != failuresBefore)
            lastError_ = packet->from.text() + ": " + receiver_.counts().lastError;
        reply(packet->bytes.size(), packet->from);
    }
    receiver_.addLostPackets(lost_.exchange(0));
    const std::lock_guard lock{mutex_};
    counts_ = receiver_.counts();
    counts_.lastError = lastError_;
}

// Replies go first, so that refusals do not use up their byte limit.
void OscPort::reply(std::size_t packetBytes, const UdpSender& to) {
    if (pendingReplies_.empty() && receiver_.refusals().empty()) return;
    replyLimiter_.packetReceived(to.text(), packetBytes, steadyNs());
    for (const auto& answer : pendingReplies_)
        if (replyLimiter_.tryReply(answer.size())) inputSocket_.answer(answer, to);
    for (const OscRefusal& refusal : receiver_.refusals()) sendRefusal(refusal, to);
    receiver_.setHeldBackReplies(replyLimiter_.heldBack());
}

void OscPort::sendRefusal(const OscRefusal& refusal, const UdpSender& to) {
    if (!replyLimiter_.tryRefusal(refusal.reason)) return;
    const auto bytes = oscStringPacket(std::string(oscErrorAddress), {refusal.address, refusal.reason});
    if (replyLimiter_.tryReply(bytes.size())) inputSocket_.answer(bytes, to);
}

void OscPort::refuse(const OscOrigin& origin, const std::string& reason) {
    const std::lock_guard lock{mutex_};
    if (lateRefusals_.size() < maxPerRound)
        lateRefusals_.emplace_back(makeRefusal(origin.address, reason), origin.from);
    else
        ++droppedLateRefusals_;
}

void OscPort::sendLateRefusals() {
    std::vector<std::pair<OscRefusal, UdpSender>> late;
    {
        const std::lock_guard lock{mutex_};
        late.swap(lateRefusals_);
    }
    if (late.empty()) return;
    for (const auto& [refusal, to] : late) {
        replyLimiter_.packetReceived(to.text(), 0, steadyNs());
        sendRefusal(refusal, to);
    }
    receiver_.setHeldBackReplies(replyLimiter_.heldBack());
    const std::lock_guard lock{mutex_};
    counts_.heldBack = replyLimiter_.heldBack();
}

void OscPort::count(bool sent) noexcept { (sent ? sent_ : unsent_).fetch_add(1, std::memory_order_relaxed); }

// The bundle's tag is that session time on the system's clock.
void OscPort::sendStatus() {
    const std::int64_t now = steadyNs();
    if (now < nextStatusNs_ || !clock_.isReady()) return;
    nextStatusNs_ = now + statusIntervalNs;
    const std::int64_t presentNs = session_.timeline().presentNs();
    const PlainMessage status = receiver_.status();
    count(outputSocket_.send(oscBundle(std::string(oscAnswerPrefix) + status.name, status,
                                       tagFromUnixNs(clock_.unixNsFromSession(presentNs)))));
}

void OscPort::onPlayed(const PlayedEvent& played, int sampleRateHz) {
    if (!outputSocket_.isOpen() || sampleRateHz == 0) return;
    const CollisionEvent& e = played.event;
    const std::int64_t timeNs = played.isLate ? FrameClock{sampleRateHz}.timeNs(played.frame) : e.timeNs;
    OscTag tag = oscNow;
    if (const std::lock_guard lock{mutex_}; clock_.isReady())
        tag = tagFromUnixNs(clock_.outputUnixNs(timeNs));
    const PlainMessage hit{"hit",
                           {{"session_s", static_cast<double>(timeNs) * 1e-9},
                            {"frequency_hz", e.frequencyHz},
                            {"decay_per_s", e.decayPerSecond},
                            {"amplitude", e.amplitude},
                            {"x_m", e.x},
                            {"y_m", e.y}}};
    count(outputSocket_.send(oscBundle(std::string(oscHitAddress), hit, tag)));
}

OscStatus OscPort::status() const {
    const std::lock_guard lock{mutex_};
    OscStatus now{address_, counts_, sent_, unsent_};
    now.counts.heldBack += droppedLateRefusals_;
    return now;
}

} // namespace physvib
