// SPDX-License-Identifier: MIT
// The link thread: finds the board, performs the handshake, synchronises clocks, sends events.
#include "Live/Session/BoardLink.h"
#include "Live/Session/OutputClock.h"
#include <libserialport.h>
#include <utility>

namespace physvib {

namespace {

constexpr std::int64_t ms = 1'000'000, second = 1000 * ms;
constexpr std::int64_t helloEvery = 250 * ms, telemetryEvery = second, gainsEvery = second,
                       searchEvery = second / 2;
constexpr std::int64_t firstGainsAgain = 8 * ms; // later gains are repeated at doubled intervals: if the line
                                                 // loses a mute, it is delayed by milliseconds, not by a
                                                 // second
constexpr std::int64_t givenUpAfter = 3 * second / 2; // so long without an answer: the line is opened again
constexpr std::int64_t tooOld = 50 * ms;              // an event later than this is not sent
constexpr std::int64_t lineAhead = 4 * ms; // limit for data in the system's buffers: what is not written yet
                                           // can still be thinned
constexpr double marginMs = 4.0 + 3.0 + 2.1;   // lineAhead, this thread's sleeps, one event on the line
constexpr std::int64_t longestAnswer = second; // an answer is never later than this
// the clock of a board that did not restart differs by less
constexpr double restartFrames = limits::board::sampleRateHz;
constexpr int crowded = 4; // with more pending events the compact form is sent

/// Why the board cannot be used; empty if it fits this program.
std::string refusal(const wire::HelloReply& board) {
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

constexpr std::size_t compactBytes = 16;       // of an event in the compact form on the line
constexpr std::int64_t earlySegment = 40 * ms; // a segment due later than this can also be sent later
constexpr std::size_t segmentBytes = 36;       // of a segment
constexpr double besidesMs = 3.0; // line time for pings, gains and the last events in the long form

// The board's wrapping frame counter of an unwrapped, fractional frame.
std::uint32_t wrapped(double frame) {
    return static_cast<std::uint32_t>(static_cast<std::int64_t>(std::llround(frame)));
}

constexpr std::int64_t lineNs(std::size_t bytes) {
    return static_cast<std::int64_t>(bytes) * 10 * second / wire::lineBitsPerSecond;
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

std::string textOr(const char* text, const char* otherwise) { return text != nullptr ? text : otherwise; }

} // namespace

std::int64_t BoardLink::nowNs() noexcept { return steadyNs(); }

BoardLink::BoardLink(std::string port)
    : wanted_{port == anyBoard ? std::string{} : std::move(port)}
    , thread_{[this] { run(); }} {}

BoardLink::~BoardLink() {
    stop_ = true;
    thread_.join();
}

void BoardLink::setGains(const std::array<double, limits::board::channels>& gains) {
    wire::Gains message;
    for (std::size_t j = 0; j < gains.size(); ++j)
        message.gains[j] = static_cast<std::int16_t>(
            std::clamp(std::nearbyint(gains[j] * limits::board::amplitudeUnit), -32768.0, 32767.0));
    order([&](Orders& o) { o.gains = message; });
}

void BoardLink::follow(std::function<void()> feed) {
    const std::scoped_lock lock{feedMutex_};
    feed_ = std::move(feed);
}

std::string BoardLink::awaitReady(const std::function<bool()>& keepGoing) const {
    for (const std::int64_t start = nowNs();; std::this_thread::sleep_for(std::chrono::milliseconds(5))) {
        const BoardLinkStatus now = status();
        const std::int64_t waited = nowNs() - start;
        if (now.state == State::ready && now.telemetry.good > 0) return {};
        const bool isNobodyThere = now.port.empty() && !now.trouble.empty() && waited > 2 * second;
        if (isNobodyThere || waited > 20 * second || !keepGoing())
            return now.trouble.empty() ? "no board answers" : now.trouble;
    }
}

BoardLinkStatus BoardLink::status() const {
    const std::scoped_lock lock{mutex_};
    return published_;
}

void BoardLink::run() {
    while (!stop_) {
        if (!line_)
            search();
        else
            receive();
        if (line_ && now_.state == State::greeting)
            greet();
        else if (line_) {
            obey();
            if (line_) keepInTouch();
        }
        {
            const std::scoped_lock lock{feedMutex_};
            if (feed_) feed_();
        }
        sendStrikes();
        publish();
    }
    if (line_ && now_.state != State::greeting) send(wire::StopAll{});
}

// Opens the next port; the handshake follows.
void BoardLink::search() {
    now_.state = State::searching;
    if (nowNs() < nextSearchNs_) {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        return;
    }
    nextSearchNs_ = nowNs() + searchEvery;
    std::string path = wanted_;
    if (path.empty()) {
        auto ports = listSerialPorts();
        std::stable_partition(ports.begin(), ports.end(), [](const auto& p) { return p.isLikelyBoard; });
        if (ports.empty()) {
            now_.trouble = "no serial port";
            return;
        }
        path = ports[searched_++ % ports.size()].path;
    }
    line_ = openSerialLine(path, now_.trouble);
    if (!line_) return;
    now_.port = path;
    now_.state = State::greeting;
    heardNs_ = nowNs();
    nextHelloNs_ = lineFreeNs_ = 0;
    decoder_ = {};
}

void BoardLink::disconnect(const std::string& why) {
    line_.reset();
    clock_.clear();
    now_.trouble = why;
    now_.outputLatencyMs = 0.0;
    now_.state = State::searching;
}

void BoardLink::receive() {
    std::array<std::uint8_t, 256> bytes;
    const int n = line_->read(bytes, 1);
    if (n < 0) return disconnect(now_.port + ": the line is gone");
    for (int i = 0; i < n; ++i)
        if (const auto payload = decoder_.feed(bytes[static_cast<std::size_t>(i)]); !payload.empty())
            handle(payload);
    if (nowNs() - heardNs_ > givenUpAfter) disconnect(now_.port + ": no answer");
}

void BoardLink::handle(std::span<const std::uint8_t> payload) {
    heardNs_ = nowNs();
    // of several replies only the first counts
    if (wire::HelloReply hello; wire::decode(payload, hello) && now_.state == State::greeting)
        return meet(hello);
    if (wire::Pong pong; wire::decode(payload, pong) && now_.state >= State::synchronising) return take(pong);
    if (wire::Telemetry telemetry; wire::decode(payload, telemetry)) now_.telemetry = telemetry;
    if (wire::SelfTestReply reply; wire::decode(payload, reply)) now_.selfTest = reply;
}

void BoardLink::meet(const wire::HelloReply& board) {
    if (auto fault = refusal(board); !fault.empty()) return disconnect(now_.port + ": " + fault);
    now_.board = board;
    now_.trouble.clear();
    nextGainsNs_ = 0, gainsPauseNs_ = firstGainsAgain; // the board may have lost its gains when off
    now_.state = State::synchronising;
    sequence_ = 0xFF;
    segmentEnds_.clear();
    pingSentNs_.fill(0);
    ++now_.connections;
}

// Adds the pong to the clock, unless its ping is unknown or was answered already.
void BoardLink::take(const wire::Pong& pong) {
    const std::int64_t sentNs = std::exchange(pingSentNs_[pong.id], 0);
    if (sentNs == 0 || heardNs_ - sentNs > longestAnswer) return;
    const double frames = clock_.unwrapped(pong.frame, pong.fraction);
    if (!clock_.isEmpty() && std::abs(frames - clock_.frameAt(heardNs_)) > restartFrames)
        return disconnect(now_.port + ": the board has started anew");
    clock_.add(sentNs, frames, heardNs_);
    if (clock_.isReady()) now_.state = State::ready;
}

void BoardLink::greet() {
    if (nowNs() < nextHelloNs_) return;
    nextHelloNs_ = nowNs() + helloEvery;
    line_->write(std::array<std::uint8_t, 1>{0}); // ends a frame that an earlier connection left
    send(wire::Hello{});
}

void BoardLink::keepInTouch() {
    const std::int64_t now = nowNs();
    if (now >= nextPingNs_) {
        nextPingNs_ = now + second / (clock_.isReady() ? wire::pingsPerSecond : wire::firstPingsPerSecond);
        pingSentNs_[++pingId_] = now;
        send(wire::Ping{pingId_});
    }
    if (line_ && now >= nextTelemetryNs_) {
        nextTelemetryNs_ = now + telemetryEvery;
        send(wire::TelemetryRequest{});
    }
    if (line_ && gains_ && now >= nextGainsNs_) {
        nextGainsNs_ = now + gainsPauseNs_;
        gainsPauseNs_ = std::min(2 * gainsPauseNs_, gainsEvery);
        send(*gains_);
    }
}

void BoardLink::obey() {
    Orders orders;
    {
        const std::scoped_lock lock{mutex_};
        std::swap(orders, orders_);
    }
    if (orders.stopAll) {
        backlog_.clear();
        for (BoardStrike waiting; strikes_.pop(waiting);) {
        }
        segmentEnds_.clear();
        if (line_) send(wire::StopAll{});
    }
    if (orders.gains) gains_ = orders.gains, nextGainsNs_ = 0, gainsPauseNs_ = firstGainsAgain;
    if (orders.selfTest && line_) {
        now_.selfTest.reset();
        send(wire::SelfTest{});
    }
}

bool BoardLink::isLineFree(std::int64_t now) const { return lineFreeNs_ - now < lineAhead; }

bool BoardLink::takesSegment(std::int64_t dueNs) {
    const std::int64_t now = nowNs();
    if (!line_ || now_.state != State::ready || !playsSegments() || !isLineFree(now)) return false;
    const std::uint32_t played = wrapped(clock_.frameAt(now));
    std::erase_if(segmentEnds_,
                  [=](std::uint32_t end) { return static_cast<std::int32_t>(end - played) <= 0; });
    const std::size_t kept = dueNs - now > earlySegment ? 2 : 0; // reserved for tones that begin meanwhile
    if (segmentEnds_.size() + kept >= limits::board::maxSegments) return false;
    const std::scoped_lock lock{mutex_};
    return !orders_.stopAll; // the pending stop would delete it at once
}

std::int64_t BoardLink::segmentReadyNs() const {
    return std::max(nowNs(), lineFreeNs_) + lineNs(segmentBytes) +
           static_cast<std::int64_t>(1e6 * transitMs());
}

void BoardLink::sendSegment(const BoardSegment& segment, bool isCoarse) {
    const std::uint32_t end = segment.frame + segment.frames,
                        ready = wrapped(clock_.frameAt(segmentReadyNs()));
    if (!isPlayable(segment) || static_cast<std::int32_t>(end - ready) <= 0) return refuseSegment();
    segmentEnds_.push_back(end);
    send(wire::Segment{++sequence_, segment});
    ++now_.segments;
    now_.coarseSegments += isCoarse ? 1 : 0;
}

void BoardLink::sendStrikes() {
    for (BoardStrike strike; strikes_.pop(strike);) {
        if (isPlayable(strike.event))
            backlog_.push(strike);
        else
            ++now_.refused;
    }
    const std::int64_t now = nowNs();
    while (!backlog_.empty() && backlog_.first().onsetNs < now - tooOld) {
        backlog_.pop();
        ++now_.refused;
    }
    const bool isReady = line_ && now_.state == State::ready;
    if (isReady)
        backlog_.keepTo({std::max(now, lineFreeNs_), lineNs(compactBytes),
                         static_cast<std::int64_t>(1e6 * (transitMs() + besidesMs))});
    while (line_ && isReady && !backlog_.empty() && isLineFree(now) &&
           backlog_.first().onsetNs < now + sendAheadMs * ms) {
        wire::Strike strike{++sequence_, backlog_.first().event};
        strike.event.frame = wrapped(clock_.frameAt(backlog_.first().onsetNs));
        if (backlog_.size() > crowded && wire::fitsCompact(strike.event))
            send(wire::compact(strike));
        else
            send(strike);
        backlog_.pop();
        ++now_.sent;
    }
}

double BoardLink::transitMs() const {
    return 1e3 * clock_.worstDelaySeconds() + now_.board.aheadFrames * 1e3 / limits::board::sampleRateHz;
}

void BoardLink::publish() {
    if (clock_.isReady()) now_.outputLatencyMs = transitMs() + marginMs;
    now_.driftPpm = clock_.drift() * 1e6;
    now_.thinned = backlog_.thinned() + strikes_.overflows();
    now_.badFrames = decoder_.bad();
    const std::scoped_lock lock{mutex_};
    published_ = now_;
}

template <class Message>
void BoardLink::send(const Message& message) {
    std::array<std::uint8_t, wire::maxFrame> frame;
    const std::size_t size = wire::encode(message, frame);
    lineFreeNs_ = std::max(lineFreeNs_, nowNs()) + lineNs(size);
    if (!line_->write({frame.data(), size})) disconnect(now_.port + ": the line is gone");
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
