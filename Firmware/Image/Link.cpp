// SPDX-License-Identifier: MIT
// Executes messages from the serial line, sends replies, and silences the board when messages stop.
#include "Link.h"
#include <algorithm>

namespace physvib::board {
namespace {

constexpr std::uint32_t framesPerMs = limits::board::sampleRateHz / 1000;
constexpr std::uint32_t fadeFrames = 3 * framesPerMs; // time to fade out, so that silence is on time
constexpr std::uint32_t watchdogFramesOf(int ms) noexcept {
    return static_cast<std::uint32_t>(std::clamp(ms, 20, wire::defaultWatchdogMs)) * framesPerMs - fadeFrames;
}

} // namespace

void Link::start(const StartupInfo& startup, BoardRenderer& renderer, FrameQueue& outputs,
                 SerialPort& serial) noexcept {
    startup_ = startup;
    renderer_ = &renderer;
    outputs_ = &outputs;
    serial_ = &serial;
    watchdogFrames_ = watchdogFramesOf(wire::defaultWatchdogMs);
}

void Link::poll() noexcept {
    std::uint8_t byte;
    FrameTime arrivedAt;
    while (serial_->readByte(byte, arrivedAt))
        if (const auto payload = decoder_.feed(byte); !payload.empty()) execute(payload, arrivedAt);
    checkTimeout();
}

void Link::checkTimeout() noexcept {
    if (isSilenced_ || outputs_->played() - lastMessageFrame_ < watchdogFrames_) return;
    isSilenced_ = true;
    stopAll();
}

void Link::execute(std::span<const std::uint8_t> payload, FrameTime arrivedAt) noexcept {
    lastMessageFrame_ = arrivedAt.frame;
    isSilenced_ = false;
    switch (static_cast<wire::Type>(payload[0])) {
    case wire::Type::hello:
        if (wire::Hello m; wire::decode(payload, m)) executeHello(m);
        break;
    case wire::Type::strike:
        if (wire::Strike m; wire::decode(payload, m)) schedule(m.sequence, m.event);
        break;
    case wire::Type::compactStrike:
        if (wire::CompactStrike m; wire::decode(payload, m))
            schedule(m.sequence, wire::expand(m, renderer_->frame()).event);
        break;
    case wire::Type::segment:
        if (wire::Segment m; wire::decode(payload, m)) schedule(m.sequence, m.segment);
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
        if (wire::Ping m; wire::decode(payload, m))
            send(wire::Pong{m.id, arrivedAt.frame, arrivedAt.fraction});
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

void Link::executeHello(const wire::Hello& hello) noexcept {
    stopAll();
    hasHello_ = true;
    duplicateFilter_ = {};
    watchdogFrames_ = watchdogFramesOf(hello.watchdogMs);
    wire::HelloReply reply;
    // older hosts get the version that they sent
    reply.version = std::min(hello.version, wire::protocolVersion);
    reply.channels = BoardRenderer::channels;
    reply.sampleRateHz = limits::board::sampleRateHz;
    reply.maxModes = limits::board::maxModes;
    reply.maxPending = limits::board::maxPending;
    reply.aheadFrames = FrameQueue::aheadFrames;
    reply.watchdogMs = static_cast<std::uint16_t>((watchdogFrames_ + fadeFrames) / framesPerMs);
    reply.crystal = startup_.clock.isCrystal ? 1 : 0;
    reply.resets = startup_.watchdogResets;
    send(reply);
}

template <class Event>
void Link::schedule(std::uint8_t sequence, const Event& event) noexcept {
    if (!hasHello_ || selfTest_.isRunning()) return;
    if (duplicateFilter_.isNew(sequence, event.frame, renderer_->frame())) renderer_->schedule(event);
}

void Link::sendTelemetry() noexcept {
    const BoardStatus status = renderer_->status();
    wire::Telemetry telemetry;
    telemetry.frame = outputs_->played();
    telemetry.good = decoder_.goodFrames();
    telemetry.bad = decoder_.badFrames();
    telemetry.lost = duplicateFilter_.lost();
    telemetry.overruns = serial_->overruns();
    telemetry.played = status.played;
    telemetry.late = status.late;
    telemetry.dropped = status.dropped;
    telemetry.stolen = status.stolen;
    telemetry.missedFrames = outputs_->missedFrames();
    telemetry.worstBlockCycles = maxBlockCycles_;
    telemetry.stackFree = startup_.freeStackBytes();
    telemetry.modes = static_cast<std::uint8_t>(status.modes);
    telemetry.pending = static_cast<std::uint8_t>(status.pending);
    telemetry.silenced = isSilenced_ ? 1 : 0;
    telemetry.guarded = static_cast<std::uint16_t>(renderer_->guard().episodes());
    maxBlockCycles_ = 0;
    send(telemetry);
}

void Link::stopAll() noexcept {
    renderer_->stopAll();
    outputs_->fadeOut();
}

void Link::beforeBlock() noexcept {
    if (selfTest_.isRunning()) selfTest_.addNotes(*renderer_);
}

void Link::afterBlock(BoardRenderer::Codes& block, std::uint32_t cycles) noexcept {
    maxBlockCycles_ = std::max(maxBlockCycles_, cycles);
    if (!selfTest_.isRunning()) return;
    wire::SelfTestReply reply;
    reply.cyclesPerBlock = startup_.clock.cyclesPerFrame() * BoardRenderer::blockFrames;
    if (selfTest_.finishBlock(block, cycles, *renderer_, reply)) {
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
