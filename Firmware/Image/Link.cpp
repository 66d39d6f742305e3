// SPDX-License-Identifier: MIT
// Executes messages from the serial line, sends replies, and silences the board when messages stop.
#include "Link.h"
#include <algorithm>

namespace physvib::board {
namespace {

constexpr std::uint32_t framesPerMs = limits::board::sampleRateHz / 1000;
constexpr std::uint32_t fadeFrames = 3 * framesPerMs; // queued frames and fade: silence is on time
constexpr std::uint32_t watchdogFrames(int ms) noexcept {
    return static_cast<std::uint32_t>(std::clamp(ms, 20, wire::defaultWatchdogMs)) * framesPerMs - fadeFrames;
}

} // namespace

void Link::start(const Machine& machine, BoardRenderer& renderer, Outputs& outputs,
                 SerialPort& serial) noexcept {
    machine_ = machine;
    renderer_ = &renderer;
    outputs_ = &outputs;
    serial_ = &serial;
    watchdogFrames_ = watchdogFrames(wire::defaultWatchdogMs);
}

void Link::poll() noexcept {
    std::uint8_t byte;
    Moment ended;
    while (serial_->take(byte, ended))
        if (const auto payload = decoder_.feed(byte); !payload.empty()) handle(payload, ended);
    watch();
}

void Link::watch() noexcept {
    if (silenced_ || outputs_->played() - heardAt_ < watchdogFrames_) return;
    silenced_ = true;
    stopAll();
}

void Link::handle(std::span<const std::uint8_t> payload, Moment ended) noexcept {
    heardAt_ = ended.frame;
    silenced_ = false;
    switch (static_cast<wire::Type>(payload[0])) {
    case wire::Type::hello:
        if (wire::Hello m; wire::decode(payload, m)) greet(m);
        break;
    case wire::Type::strike:
        if (wire::Strike m; wire::decode(payload, m)) play(m.sequence, m.event);
        break;
    case wire::Type::compactStrike:
        if (wire::CompactStrike m; wire::decode(payload, m))
            play(m.sequence, wire::expand(m, renderer_->frame()).event);
        break;
    case wire::Type::segment:
        if (wire::Segment m; wire::decode(payload, m)) play(m.sequence, m.segment);
        break;
    case wire::Type::gains:
        if (wire::Gains m; wire::decode(payload, m)) {
            BoardRenderer::Gains gains;
            for (std::size_t j = 0; j < gains.size(); ++j)
                gains[j] = static_cast<float>(m.gains[j]) / static_cast<float>(limits::board::amplitudeUnit);
            renderer_->setGains(gains);
        }
        break;
    case wire::Type::ping:
        if (wire::Ping m; wire::decode(payload, m)) send(wire::Pong{m.id, ended.frame, ended.fraction});
        break;
    case wire::Type::telemetryRequest: sendTelemetry(); break;
    case wire::Type::stopAll: stopAll(); break;
    case wire::Type::selfTest:
        stopAll();
        selfTest_.begin(*renderer_);
        break;
    default: break; // message of a later protocol version
    }
}

void Link::greet(const wire::Hello& hello) noexcept {
    stopAll();
    greeted_ = true;
    order_ = {};
    watchdogFrames_ = watchdogFrames(hello.watchdogMs);
    wire::HelloReply reply;
    // older hosts get the version that they sent
    reply.version = std::min(hello.version, wire::protocolVersion);
    reply.channels = BoardRenderer::channels;
    reply.sampleRateHz = limits::board::sampleRateHz;
    reply.maxModes = limits::board::maxModes;
    reply.maxPending = limits::board::maxPending;
    reply.aheadFrames = Outputs::aheadFrames;
    reply.watchdogMs = static_cast<std::uint16_t>((watchdogFrames_ + fadeFrames) / framesPerMs);
    reply.crystal = machine_.clock.isCrystal ? 1 : 0;
    reply.resets = machine_.watchdogResets;
    send(reply);
}

template <class Event>
void Link::play(std::uint8_t sequence, const Event& event) noexcept {
    if (!greeted_ || selfTest_.isRunning()) return;
    if (order_.isNew(sequence, event.frame, renderer_->frame())) renderer_->schedule(event);
}

void Link::sendTelemetry() noexcept {
    const BoardStatus status = renderer_->status();
    wire::Telemetry t;
    t.frame = outputs_->played();
    t.good = decoder_.good();
    t.bad = decoder_.bad();
    t.lost = order_.lost();
    t.overruns = serial_->overruns();
    t.played = status.played;
    t.late = status.late;
    t.dropped = status.dropped;
    t.stolen = status.stolen;
    t.missedFrames = outputs_->missed();
    t.worstBlockCycles = worstBlockCycles_;
    t.stackFree = machine_.stackFree();
    t.modes = static_cast<std::uint8_t>(status.modes);
    t.pending = static_cast<std::uint8_t>(status.pending);
    t.silenced = silenced_ ? 1 : 0;
    t.guarded = static_cast<std::uint16_t>(renderer_->guard().episodes());
    worstBlockCycles_ = 0;
    send(t);
}

void Link::stopAll() noexcept {
    renderer_->stopAll();
    outputs_->fadeOut();
}

void Link::beforeBlock() noexcept {
    if (selfTest_.isRunning()) selfTest_.strike(*renderer_);
}

void Link::afterBlock(BoardRenderer::Codes& block, std::uint32_t cycles) noexcept {
    worstBlockCycles_ = std::max(worstBlockCycles_, cycles);
    if (!selfTest_.isRunning()) return;
    wire::SelfTestReply reply;
    reply.cyclesPerBlock = machine_.clock.cyclesPerFrame() * BoardRenderer::blockFrames;
    if (selfTest_.take(block, cycles, *renderer_, reply)) {
        renderer_->stopAll();
        send(reply);
    }
    for (auto& frame : block) frame.fill(BoardRenderer::midScale);
}

template <class Message>
void Link::send(const Message& message) noexcept {
    std::array<std::uint8_t, wire::maxFrame> frame;
    // if the line is full, replies are dropped; hosts repeat requests whose reply matters
    serial_->send({frame.data(), wire::encode(message, frame)});
}

} // namespace physvib::board
