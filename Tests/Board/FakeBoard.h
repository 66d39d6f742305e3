// SPDX-License-Identifier: GPL-3.0-or-later
// Another end of a board's line, that says what it is told to.
#pragma once
#include "Host/FakeAudioDevice.h"
#include "Live/Devices/AudioOutput.h"
#include "Live/Session/BoardOutput.h"
#include "Session/WallsScene.h"
#include "VirtualBoard.h"
#include "VirtualBoard/PseudoTerminal.h"
#include "Wire/SelfTest.h"
#include <gtest/gtest.h>

namespace physvib {

/// Another end of the line, that says what it is told to.
class FakeBoard {
public:
    FakeBoard(const wire::HelloReply& reply, std::uint32_t first, bool lies = false)
        : reply_{reply}
        , first_{first}
        , lies_{lies} {}
    ~FakeBoard() {
        stop_ = true;
        thread_.join();
    }
    const std::string& port() const { return line_.path(); }
    /// Of its counter, which does not wrap here.
    double frameAt(std::int64_t ns) const {
        return first_ + static_cast<double>(ns - startNs_) * 1e-9 * limits::board::sampleRateHz;
    }
    /// The last that it was told of the first channel.
    int gain() const { return locked(gains_).gains[0]; }
    /// From now on the line loses so many of each new gains, before one is heard.
    void loseGains(int messages) {
        const std::scoped_lock lock{mutex_};
        losses_ = messages;
    }
    /// How often it was asked for telemetry, which is once a second, between the newest gains and their being
    /// heard.
    int secondsLate() const { return locked(secondsLate_); }
    std::vector<wire::Strike> strikes() const { return locked(strikes_); }
    std::vector<BoardSegment> segments() const { return locked(segments_); }
    /// How often it was told to stop, and what came after the last of these.
    int stops() const { return locked(stops_); }
    std::size_t sinceStop() const { return locked(sinceStop_); }
    /// What it answers from now on.
    void count(const wire::Telemetry& telemetry) {
        const std::scoped_lock lock{mutex_};
        telemetry_ = telemetry;
    }

private:
    template <class Value>
    Value locked(const Value& value) const {
        const std::scoped_lock lock{mutex_};
        return value;
    }
    void run() {
        wire::FrameDecoder decoder;
        while (!stop_) {
            for (const auto byte : line_.read())
                if (const auto payload = decoder.feed(byte); !payload.empty()) handle(payload);
            std::this_thread::sleep_for(std::chrono::microseconds(200));
        }
    }
    void handle(std::span<const std::uint8_t> payload) {
        if (wire::Hello hello; wire::decode(payload, hello)) send(reply_);
        if (wire::Ping ping; wire::decode(payload, ping)) {
            const auto frame =
                static_cast<std::uint32_t>(static_cast<std::uint64_t>(frameAt(BoardLink::nowNs())));
            // of a ping that was never sent, or is answered
            if (lies_) send(wire::Pong{static_cast<std::uint8_t>(ping.id + 100), frame + 800, 0});
            send(wire::Pong{ping.id, frame, 0});
            if (lies_) send(wire::Pong{ping.id, frame + 400, 0}); // once more
        }
        if (wire::SelfTest test; wire::decode(payload, test))
            send(wire::expectedSelfTest(*std::make_unique<BoardRenderer>()));
        const std::scoped_lock lock{mutex_};
        if (wire::Strike strike; wire::decode(payload, strike)) strikes_.push_back(strike), ++sinceStop_;
        if (wire::Segment segment; wire::decode(payload, segment))
            segments_.push_back(segment.segment), ++sinceStop_;
        if (wire::StopAll stop; wire::decode(payload, stop)) ++stops_, sinceStop_ = 0;
        if (wire::TelemetryRequest request; wire::decode(payload, request)) {
            ++seconds_;
            if (telemetry_) {
                telemetry_->frame += 1;
                send(*telemetry_);
            }
        }
        if (wire::Gains gains; wire::decode(payload, gains)) hear(gains);
    }
    void hear(const wire::Gains& gains) {
        if (gains.gains != sent_.gains) sent_ = gains, unheard_ = losses_, changedIn_ = seconds_;
        if (unheard_-- > 0) return;
        if (gains_.gains != gains.gains) gains_ = gains, secondsLate_ = seconds_ - changedIn_;
    }
    template <class Message>
    void send(const Message& message) {
        std::array<std::uint8_t, wire::maxFrame> frame;
        line_.write({frame.data(), wire::encode(message, frame)});
    }

    virtualboard::PseudoTerminal line_;
    const wire::HelloReply reply_;
    const std::uint32_t first_;
    const bool lies_;
    const std::int64_t startNs_ = BoardLink::nowNs();
    mutable std::mutex mutex_;
    std::vector<wire::Strike> strikes_;
    std::vector<BoardSegment> segments_;
    std::size_t sinceStop_ = 0;
    int stops_ = 0;
    std::optional<wire::Telemetry> telemetry_;
    wire::Gains gains_, sent_; // heard; as they came last, perhaps lost
    int losses_ = 0, unheard_ = 0, seconds_ = 0, changedIn_ = 0, secondsLate_ = 0;
    std::atomic<bool> stop_{false};
    std::thread thread_{[this] { run(); }};
};

inline wire::HelloReply ours() {
    wire::HelloReply reply;
    reply.channels = limits::board::channels;
    reply.sampleRateHz = limits::board::sampleRateHz;
    reply.aheadFrames = 16;
    reply.watchdogMs = wire::defaultWatchdogMs;
    return reply;
}

/// A session on the board, beside a device that keeps time, whatever else runs here.
struct BesideDevice {
    explicit BesideDevice(const FakeBoard& board)
        : onBoard{board.port(), setup.panner, 0.3} { // other programs may hold this one up
        setup.channels = 4;
        EXPECT_TRUE(test::comesTrue([&] { return onBoard.state().isReady; }));
        session.emplace(setup).sinks().attach(onBoard);
        hands.block = 480;
        EXPECT_EQ(output.emplace(*session, test::fakeDrivers({&hands})).open({"hands", {}, 0, 0, 0.5f}), "");
        together.emplace(session->sinks(), *output);
        due = std::chrono::steady_clock::now();
        for (int i = 0; i < 10; ++i) goOn();
    }
    void goOn() {
        hands.play(hands.block);
        session->advance();
        std::this_thread::sleep_until(due += std::chrono::milliseconds(10));
    }

    SessionSetup setup = test::setupOfWalls();
    BoardOutput onBoard;
    std::optional<Session> session;
    test::FakeInterface hands;
    std::optional<AudioOutput> output;
    std::optional<ScopedFollow> together;
    std::chrono::steady_clock::time_point due; // of the next block
};

} // namespace physvib
