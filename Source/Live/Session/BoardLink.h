// SPDX-License-Identifier: MIT
// The four-channel board from the computer's side: a thread of its own (L) that finds it, keeps its clock and
// sends.
//
// L owns the serial line and all state of the connection. Strikes come by a wait-free queue, orders and the
// status under a lock that nobody holds while waiting. A strike leaves as soon as the line is free, at most
// `sendAheadMs` before its onset; what the line cannot carry is thinned (StrikeBacklog). When the board is
// silent for too long, the line is closed and opened again, for as long as the link lives.
#pragma once
#include "Core/EventQueue.h"
#include "Live/Session/SerialLine.h"
#include "Wire/BoardStrike.h"
#include "Wire/FrameDecoder.h"
#include "Wire/LinkClock.h"
#include <atomic>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace physvib {

/// As a port: the first on which a board answers.
inline constexpr const char* anyBoard = "auto";

/// A moment of the link, for people.
struct BoardLinkStatus {
    enum class State { searching, greeting, synchronising, ready };
    State state = State::searching;
    std::string port, trouble;                   ///< trouble: why there is no connection
    wire::HelloReply board;                      ///< as it answered last
    wire::Telemetry telemetry;                   ///< the newest
    std::optional<wire::SelfTestReply> selfTest; ///< after requestSelfTest
    double playOutMs = 0.0; ///< an onset has to be known so long before it is felt; 0: not yet known
    double driftPpm = 0.0;  ///< the board's clock against this computer's
    std::uint64_t sent = 0, thinned = 0, refused = 0; ///< strikes: sent; lost for want of line; not playable
                                                      ///< or too old, as legs may be
    std::uint64_t legs = 0, coarseLegs = 0; ///< of what moves: sent; of these longer than their law asks for,
                                            ///< for want of line
    std::uint64_t connections = 0, badFrames = 0;
};

/// Somebody whom the link asks for strikes and orders, about once a millisecond.
class BoardSource {
public:
    virtual ~BoardSource() = default;
    /// L; may push, order, and send legs. Quick.
    virtual void feed() = 0;
};

class BoardLink {
public:
    static constexpr std::int64_t sendAheadMs = 80; // the board holds 64 strikes, the line brings 58 in this
                                                    // time

    /// `port`: a path, or anyBoard. M.
    explicit BoardLink(std::string port);
    ~BoardLink();
    BoardLink(const BoardLink&) = delete;
    BoardLink& operator=(const BoardLink&) = delete;

    /// Waits until the board is ready and has told how it does; empty, or why not. A port that could never be
    /// opened is not waited for long, a board that starts is. Any thread but L.
    std::string awaitReady(const std::function<bool()>& goesOn) const;

    /// The clock of BoardStrike::onsetNs. Any thread.
    static std::int64_t nowNs() noexcept;

    /// False if the queue is full; the queue counts it. One producer, wait-free.
    bool push(const BoardStrike& strike) noexcept { return strikes_.push(strike); }

    /// Whether the board that answered last plays legs: else what moves has to be strikes. L, as what
    /// follows.
    bool playsLegs() const noexcept { return now_.board.version >= wire::legsSince; }
    /// Whether it could be sent one now that is due then: there is a clock, and room on the line and on the
    /// board.
    bool takesLeg(std::int64_t dueNs);
    /// The board's frame then, between two as a rule; while there is a clock.
    double frameAt(std::int64_t steadyNs) const noexcept { return clock_.frameAt(steadyNs); }
    /// When a leg that is sent now can be played.
    std::int64_t legReadyNs() const;
    /// Sends it; one that is over by then is counted as refused. While it takes one.
    void sendLeg(const BoardLeg& leg, bool isCoarse);
    void refuseLeg() noexcept { ++now_.refused; }

    /// From now on L asks this one, or nobody (null), and nobody else pushes. When it returns, L is not in
    /// the one before. M.
    void follow(BoardSource* source);

    void stopAll() {
        order([](Orders& o) { o.stopAll = true; });
    }
    void requestSelfTest() {
        order([](Orders& o) { o.selfTest = true; });
    }
    /// Negative gains turn the polarity; -8 to 8. Repeated, soon at first, since a line may lose them and a
    /// board its power.
    void setGains(const std::array<double, limits::board::channels>& gains);

    BoardLinkStatus status() const;

private:
    using State = BoardLinkStatus::State;
    struct Orders {
        bool stopAll = false, selfTest = false;
        std::optional<wire::Gains> gains;
    };
    template <class Change>
    void order(Change change) {
        const std::scoped_lock lock{mutex_};
        change(orders_);
    }
    void run();
    void askSource();
    void search();
    void disconnect(const std::string& why);
    void receive();
    void handle(std::span<const std::uint8_t> payload);
    void meet(const wire::HelloReply& board);
    void take(const wire::Pong& pong);
    void greet();
    void keepInTouch();
    void obey();
    void sendStrikes();
    void publish();
    double transitMs() const;
    double playOutMs() const;
    bool isLineFree(std::int64_t now) const;
    template <class Message>
    void send(const Message& message);

    const std::string wanted_;
    EventQueue<BoardStrike, 1024> strikes_;
    std::mutex sourceMutex_; // guards source_, taken first
    BoardSource* source_ = nullptr;
    mutable std::mutex mutex_; // guards orders_ and published_
    Orders orders_;
    BoardLinkStatus published_;
    std::atomic<bool> stop_{false};

    // What follows belongs to L.
    std::unique_ptr<SerialLine> line_;
    wire::FrameDecoder decoder_;
    LinkClock clock_;
    StrikeBacklog backlog_;
    BoardLinkStatus now_;
    std::optional<wire::Gains> gains_;
    std::array<std::int64_t, 256> pingSentNs_{}; // 0: not on its way
    std::int64_t heardNs_ = 0, nextHelloNs_ = 0, nextPingNs_ = 0, nextTelemetryNs_ = 0, nextGainsNs_ = 0,
                 gainsPauseNs_ = 0, nextSearchNs_ = 0, lineFreeNs_ = 0;
    std::vector<std::uint32_t> legEnds_; // of legs on their way or on the board: the frames from which on
                                         // they are over
    std::size_t searched_ = 0;           // ports tried so far
    std::uint8_t pingId_ = 0, sequence_ = 0xFF;
    std::thread thread_;
};

} // namespace physvib
