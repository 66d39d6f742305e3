// SPDX-License-Identifier: MIT
// The link thread: finds the board, performs the handshake, synchronises clocks, sends events.
#include "Live/Session/BoardLink.h"
#include "Live/Session/OutputClock.h"
#include <libserialport.h>
#include <utility>

namespace physvib {

namespace {

constexpr std::int64_t msNs = 1'000'000, secondNs = 1000 * msNs;
constexpr std::int64_t helloIntervalNs = 250 * msNs, telemetryIntervalNs = secondNs,
                       gainsIntervalNs = secondNs, searchIntervalNs = secondNs / 2;
// gains are repeated after this, then at doubled intervals, so that a lost mute is late by milliseconds only
constexpr std::int64_t firstGainsRepeatNs = 8 * msNs;
constexpr std::int64_t answerTimeOutNs = 3 * secondNs / 2; // without an answer the line is opened again
constexpr std::int64_t maxLatenessNs = 50 * msNs;          // an event this long after its onset is not sent
// limit for data in the system's buffers: events that are not written yet can still be dropped
constexpr std::int64_t maxLineAheadNs = 4 * msNs;
constexpr double marginMs = 4.0 + 3.0 + 2.1; // maxLineAheadNs, this thread's sleeps, one event on the line
constexpr std::int64_t maxAnswerDelayNs = secondNs; // a later answer is ignored
// a larger jump of the board's clock means that it has restarted
constexpr double minRestartJumpFrames = limits::board::sampleRateHz;
constexpr int maxLongFormCount = 4; // with more pending events the compact form is sent

/// Why the board cannot be used; empty if it fits this program.
std::string boardError(const wire::HelloReply& board) {
    if (board.version < 1 || board.version > wire::protocolVersion)
        return "expected a board of protocol 1 to " + std::to_string(wire::protocolVersion) + ", found " +
               std::to_string(board.version);
    if (board.channels != limits::board::channels || board.sampleRateHz != limits::board::sampleRateHz)
        return "expected a board of " + std::to_string(limits::board::channels) + " channels at " +
               std::to_string(limits::board::sampleRateHz) + " Hz, found " + std::to_string(board.channels) +
               " at " + std::to_string(board.sampleRateHz) + " Hz";
    if (board.watchdogMs > wire::defaultWatchdogMs || board.aheadFrames > limits::board::sampleRateHz)
        return "expected a board that is silent " + std::to_string(wire::defaultWatchdogMs) +
               " ms after its computer, and plays within a second";
    return {};
}

constexpr std::size_t compactBytes = 16;           // of an event in the compact form on the line
constexpr std::int64_t earlySegmentNs = 40 * msNs; // segments due later leave room for new tones
constexpr std::size_t segmentBytes = 36;           // of a segment
constexpr double overheadMs = 3.0; // line time for pings, gains and the last events in the long form

// The value of the board's frame counter, modulo 2^32, at an unwrapped, fractional frame.
std::uint32_t wrappedFrame(double frame) {
    return static_cast<std::uint32_t>(static_cast<std::int64_t>(std::llround(frame)));
}

constexpr std::int64_t lineTimeNs(std::size_t bytes) {
    return static_cast<std::int64_t>(bytes) * 10 * secondNs / wire::lineBitsPerSecond;
}

constexpr int stLinkVendor = 0x0483;

struct PortDeleter {
    void operator()(sp_port* port) const { sp_free_port(port); }
};
using Port = std::unique_ptr<sp_port, PortDeleter>;

class PortLine final : public SerialLine {
public:
    explicit PortLine(Port port)
        : port_{std::move(port)} {}
    ~PortLine() override { sp_close(port_.get()); }
    int read(std::span<std::uint8_t> bytes, int milliseconds) override {
        return sp_blocking_read_next(port_.get(), bytes.data(), bytes.size(),
                                     static_cast<unsigned>(milliseconds));
    }
    bool write(std::span<const std::uint8_t> bytes) override {
        return sp_blocking_write(port_.get(), bytes.data(), bytes.size(), 50) ==
               static_cast<int>(bytes.size());
    }

private:
    Port port_;
};

std::string textOr(const char* text, const char* fallback) { return text != nullptr ? text : fallback; }

} // namespace

std::int64_t BoardLink::nowNs() noexcept { return steadyNs(); }

BoardLink::BoardLink(std::string port)
    : port_{port == anyBoard ? std::string{} : std::move(port)}
    , thread_{[this] { run(); }} {}

BoardLink::~BoardLink() {
    isStopping_ = true;
    thread_.join();
}

void BoardLink::setGains(const std::array<double, limits::board::channels>& gains) {
    wire::Gains message;
    for (std::size_t j = 0; j < gains.size(); ++j)
        message.gains[j] = static_cast<std::int16_t>(
            std::clamp(std::nearbyint(gains[j] * limits::board::amplitudeUnit), -32768.0, 32767.0));
    addCommand([&](Commands& commands) { commands.gains = message; });
}

void BoardLink::setFeed(std::function<void()> feed) {
    const std::scoped_lock lock{feedMutex_};
    feed_ = std::move(feed);
}

std::string BoardLink::awaitReady(const std::function<bool()>& keepGoing) const {
    for (const std::int64_t start = nowNs();; std::this_thread::sleep_for(std::chrono::milliseconds(5))) {
        const BoardLinkStatus current = status();
        const std::int64_t waitedNs = nowNs() - start;
        if (current.state == State::ready && current.telemetry.good > 0) return {};
        const bool isMissing = current.port.empty() && !current.error.empty() && waitedNs > 2 * secondNs;
        if (isMissing || waitedNs > 20 * secondNs || !keepGoing())
            return current.error.empty() ? "no board answers" : current.error;
    }
}

BoardLinkStatus BoardLink::status() const {
    const std::scoped_lock lock{mutex_};
    return publishedStatus_;
}

void BoardLink::run() {
    while (!isStopping_) {
        if (!line_)
            search();
        else
            receive();
        if (line_ && status_.state == State::greeting)
            greet();
        else if (line_) {
            executeCommands();
            if (line_) sendPeriodicMessages();
        }
        {
            const std::scoped_lock lock{feedMutex_};
            if (feed_) feed_();
        }
        sendStrikes();
        publish();
    }
    if (line_ && status_.state != State::greeting) send(wire::StopAll{});
}

// Opens the next port; the handshake follows.
void BoardLink::search() {
    status_.state = State::searching;
    if (nowNs() < nextSearchNs_) {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        return;
    }
    nextSearchNs_ = nowNs() + searchIntervalNs;
    std::string path = port_;
    if (path.empty()) {
        auto ports = listSerialPorts();
        std::stable_partition(ports.begin(), ports.end(), [](const auto& p) { return p.isLikelyBoard; });
        if (ports.empty()) {
            status_.error = "no serial port";
            return;
        }
        path = ports[portsTried_++ % ports.size()].path;
    }
    line_ = openSerialLine(path, status_.error);
    if (!line_) return;
    status_.port = path;
    status_.state = State::greeting;
    lastReceivedNs_ = nowNs();
    nextHelloNs_ = lineFreeNs_ = 0;
    decoder_ = {};
}

void BoardLink::disconnect(const std::string& why) {
    line_.reset();
    clock_.clear();
    status_.error = why;
    status_.outputLatencyMs = 0.0;
    status_.state = State::searching;
}

void BoardLink::receive() {
    std::array<std::uint8_t, 256> bytes;
    const int n = line_->read(bytes, 1);
    if (n < 0) return disconnect(status_.port + ": the line is gone");
    for (int i = 0; i < n; ++i)
        if (const auto payload = decoder_.feed(bytes[static_cast<std::size_t>(i)]); !payload.empty())
            handle(payload);
    if (nowNs() - lastReceivedNs_ > answerTimeOutNs) disconnect(status_.port + ": no answer");
}

void BoardLink::handle(std::span<const std::uint8_t> payload) {
    lastReceivedNs_ = nowNs();
    // of several replies only the first counts
    if (wire::HelloReply hello; wire::decode(payload, hello) && status_.state == State::greeting)
        return handleHello(hello);
    if (wire::Pong pong; wire::decode(payload, pong) && status_.state >= State::synchronising)
        return handlePong(pong);
    if (wire::Telemetry telemetry; wire::decode(payload, telemetry)) status_.telemetry = telemetry;
    if (wire::SelfTestReply reply; wire::decode(payload, reply)) status_.selfTest = reply;
}

void BoardLink::handleHello(const wire::HelloReply& board) {
    if (auto error = boardError(board); !error.empty()) return disconnect(status_.port + ": " + error);
    status_.board = board;
    status_.error.clear();
    nextGainsNs_ = 0, gainsRepeatNs_ = firstGainsRepeatNs; // the board may have lost its gains when off
    status_.state = State::synchronising;
    sequence_ = 0xFF;
    segmentEnds_.clear();
    pingSentNs_.fill(0);
    ++status_.connections;
}

// Adds the pong to the clock, unless its ping is unknown or was answered already.
void BoardLink::handlePong(const wire::Pong& pong) {
    const std::int64_t sentNs = std::exchange(pingSentNs_[pong.id], 0);
    if (sentNs == 0 || lastReceivedNs_ - sentNs > maxAnswerDelayNs) return;
    const double frames = clock_.unwrappedFrame(pong.frame, pong.fraction);
    if (!clock_.isEmpty() && std::abs(frames - clock_.frameAt(lastReceivedNs_)) > minRestartJumpFrames)
        return disconnect(status_.port + ": the board has started anew");
    clock_.add(sentNs, frames, lastReceivedNs_);
    if (clock_.isReady()) status_.state = State::ready;
}

void BoardLink::greet() {
    if (nowNs() < nextHelloNs_) return;
    nextHelloNs_ = nowNs() + helloIntervalNs;
    line_->write(std::array<std::uint8_t, 1>{0}); // ends a frame that an earlier connection left
    send(wire::Hello{});
}

void BoardLink::sendPeriodicMessages() {
    const std::int64_t now = nowNs();
    if (now >= nextPingNs_) {
        nextPingNs_ = now + secondNs / (clock_.isReady() ? wire::pingsPerSecond : wire::firstPingsPerSecond);
        pingSentNs_[++pingId_] = now;
        send(wire::Ping{pingId_});
    }
    if (line_ && now >= nextTelemetryNs_) {
        nextTelemetryNs_ = now + telemetryIntervalNs;
        send(wire::TelemetryRequest{});
    }
    if (line_ && gains_ && now >= nextGainsNs_) {
        nextGainsNs_ = now + gainsRepeatNs_;
        gainsRepeatNs_ = std::min(2 * gainsRepeatNs_, gainsIntervalNs);
        send(*gains_);
    }
}

void BoardLink::executeCommands() {
    Commands commands;
    {
        const std::scoped_lock lock{mutex_};
        std::swap(commands, commands_);
    }
    if (commands.stopAll) {
        backlog_.clear();
        for (BoardStrike waiting; strikes_.pop(waiting);) {
        }
        segmentEnds_.clear();
        if (line_) send(wire::StopAll{});
    }
    if (commands.gains) gains_ = commands.gains, nextGainsNs_ = 0, gainsRepeatNs_ = firstGainsRepeatNs;
    if (commands.selfTest && line_) {
        status_.selfTest.reset();
        send(wire::SelfTest{});
    }
}

bool BoardLink::isLineFree(std::int64_t now) const { return lineFreeNs_ - now < maxLineAheadNs; }

bool BoardLink::canSendSegment(std::int64_t dueNs) {
    const std::int64_t now = nowNs();
    if (!line_ || status_.state != State::ready || !supportsSegments() || !isLineFree(now)) return false;
    const std::uint32_t played = wrappedFrame(clock_.frameAt(now));
    std::erase_if(segmentEnds_,
                  [=](std::uint32_t end) { return static_cast<std::int32_t>(end - played) <= 0; });
    const std::size_t reserved = dueNs - now > earlySegmentNs ? 2 : 0; // for tones that begin meanwhile
    if (segmentEnds_.size() + reserved >= limits::board::maxSegments) return false;
    const std::scoped_lock lock{mutex_};
    return !commands_.stopAll; // the pending stop would delete it at once
}

std::int64_t BoardLink::segmentReadyNs() const {
    return std::max(nowNs(), lineFreeNs_) + lineTimeNs(segmentBytes) +
           static_cast<std::int64_t>(1e6 * transitMs());
}

void BoardLink::sendSegment(const BoardSegment& segment, bool isCoarse) {
    const std::uint32_t end = segment.frame + segment.frames,
                        ready = wrappedFrame(clock_.frameAt(segmentReadyNs()));
    if (!isPlayable(segment) || static_cast<std::int32_t>(end - ready) <= 0) return refuseSegment();
    segmentEnds_.push_back(end);
    send(wire::Segment{++sequence_, segment});
    ++status_.segments;
    status_.coarseSegments += isCoarse ? 1 : 0;
}

void BoardLink::sendStrikes() {
    for (BoardStrike strike; strikes_.pop(strike);) {
        if (isPlayable(strike.event))
            backlog_.push(strike);
        else
            ++status_.refused;
    }
    const std::int64_t now = nowNs();
    while (!backlog_.empty() && backlog_.first().onsetNs < now - maxLatenessNs) {
        backlog_.pop();
        ++status_.refused;
    }
    const bool isReady = line_ && status_.state == State::ready;
    if (isReady)
        backlog_.dropLate({std::max(now, lineFreeNs_), lineTimeNs(compactBytes),
                           static_cast<std::int64_t>(1e6 * (transitMs() + overheadMs))});
    while (line_ && isReady && !backlog_.empty() && isLineFree(now) &&
           backlog_.first().onsetNs < now + sendAheadMs * msNs) {
        wire::Strike strike{++sequence_, backlog_.first().event};
        strike.event.frame = wrappedFrame(clock_.frameAt(backlog_.first().onsetNs));
        if (backlog_.size() > maxLongFormCount && wire::fitsCompact(strike.event))
            send(wire::toCompact(strike));
        else
            send(strike);
        backlog_.pop();
        ++status_.sent;
    }
}

double BoardLink::transitMs() const {
    return 1e3 * clock_.worstDelaySeconds() + status_.board.aheadFrames * 1e3 / limits::board::sampleRateHz;
}

void BoardLink::publish() {
    if (clock_.isReady()) status_.outputLatencyMs = transitMs() + marginMs;
    status_.driftPpm = clock_.drift() * 1e6;
    status_.thinned = backlog_.thinned() + strikes_.overflows();
    status_.badFrames = decoder_.badFrames();
    const std::scoped_lock lock{mutex_};
    publishedStatus_ = status_;
}

template <class Message>
void BoardLink::send(const Message& message) {
    std::array<std::uint8_t, wire::maxFrame> frame;
    const std::size_t size = wire::encode(message, frame);
    lineFreeNs_ = std::max(lineFreeNs_, nowNs()) + lineTimeNs(size);
    if (!line_->write({frame.data(), size})) disconnect(status_.port + ": the line is gone");
}

// Serial ports by libserialport.

std::vector<SerialPortName> listSerialPorts() {
    std::vector<SerialPortName> names;
    sp_port** ports = nullptr;
    if (sp_list_ports(&ports) != SP_OK) return names;
    for (sp_port** port = ports; *port != nullptr; ++port) {
        int vendor = 0, product = 0;
        const bool isUsb = sp_get_port_usb_vid_pid(*port, &vendor, &product) == SP_OK;
        names.push_back({textOr(sp_get_port_name(*port), ""),
                         textOr(sp_get_port_description(*port), "serial port"),
                         isUsb && vendor == stLinkVendor});
    }
    sp_free_port_list(ports);
    return names;
}

std::unique_ptr<SerialLine> openSerialLine(const std::string& path, std::string& error) {
    if (isPseudoTerminal(path)) return openPseudoTerminal(path, error);
    sp_port* found = nullptr;
    if (sp_get_port_by_name(path.c_str(), &found) != SP_OK) {
        error = path + ": no such serial port";
        return nullptr;
    }
    Port port{found};
    const bool isReady = sp_open(found, SP_MODE_READ_WRITE) == SP_OK &&
                         sp_set_baudrate(found, wire::lineBitsPerSecond) == SP_OK &&
                         sp_set_bits(found, 8) == SP_OK && sp_set_parity(found, SP_PARITY_NONE) == SP_OK &&
                         sp_set_stopbits(found, 1) == SP_OK &&
                         sp_set_flowcontrol(found, SP_FLOWCONTROL_NONE) == SP_OK;
    if (isReady) return std::make_unique<PortLine>(std::move(port));
    char* reason = sp_last_error_message();
    error = path + ": " + textOr(reason, "cannot be opened");
    sp_free_error_message(reason);
    return nullptr;
}

} // namespace physvib
