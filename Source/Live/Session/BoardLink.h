// SPDX-License-Identifier: MIT
// The computer's side of the four-channel vibration board: serial ports and lines, and a link thread that
// finds the board, tracks its clock and sends events.
//
// The link thread owns the serial line and all state of the connection. Events arrive through a wait-free
// queue, commands and the status under a lock that is never held while waiting. An event is sent as soon as
// the line is free, at most `sendAheadMs` before its onset; excess events are dropped (StrikeBacklog). If the
// board is silent for too long, the line is closed and opened again, as long as this object exists.
#pragma once
#include "Core/EventQueue.h"
#include "Wire/BoardStrike.h"
#include "Wire/FrameDecoder.h"
#include "Wire/LinkClock.h"
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

namespace physvib {

// Serial port at the board's speed, by libserialport, or a pseudo-terminal, which that library does not open.

/// A serial port of the system.
struct SerialPortName {
    std::string path, description;
    bool isLikelyBoard = false; ///< its USB vendor is that of an ST-Link
};

/// Message thread (M) or link thread.
std::vector<SerialPortName> listSerialPorts();

/// An open serial line. One thread at a time.
class SerialLine {
public:
    virtual ~SerialLine() = default;

    /// Waits up to `milliseconds` for bytes. Returns the number received, at most bytes.size(); -1 if the
    /// line is gone.
    virtual int read(std::span<std::uint8_t> bytes, int milliseconds) = 0;

    /// False if the line is gone or does not accept the bytes.
    virtual bool write(std::span<const std::uint8_t> bytes) = 0;
};

/// The opened line, or nullptr with a one-line reason in `error`.
std::unique_ptr<SerialLine> openSerialLine(const std::string& path, std::string& error);

/// Whether the path, after symbolic links, is a pseudo-terminal (a simulated board); never on Windows. Any
/// thread but the render thread (R).
bool isPseudoTerminal(const std::string& path);

/// As openSerialLine(), for a pseudo-terminal.
std::unique_ptr<SerialLine> openPseudoTerminal(const std::string& path, std::string& error);

/// Port name: the first port on which a board answers.
inline constexpr const char* anyBoard = "auto";

/// State of the link, for display.
struct BoardLinkStatus {
    enum class State { searching, greeting, synchronising, ready };
    State state = State::searching;
    std::string port, error;                     ///< error: why there is no connection
    wire::HelloReply board;                      ///< latest reply of the board
    wire::Telemetry telemetry;                   ///< latest telemetry
    std::optional<wire::SelfTestReply> selfTest; ///< after requestSelfTest
    double outputLatencyMs = 0.0; ///< time before its onset at which an event must be known; 0: not known yet
    double driftPpm = 0.0;        ///< the board's clock relative to this computer's
    std::uint64_t sent = 0, thinned = 0, refused = 0; ///< events: sent; thinned (dropped for lack
                                                      ///< of bandwidth); unplayable or too old, or segments
    std::uint64_t segments = 0, coarseSegments = 0; ///< segments of moving tones: sent; sent in longer pieces
                                                    ///< than planned for lack of bandwidth
    std::uint64_t connections = 0, badFrames = 0;
};

class BoardLink {
public:
    static constexpr std::int64_t sendAheadMs = 80; // in it 58 events are sent; the board stores 64

    /// `port`: a path, or anyBoard. Message thread (M).
    explicit BoardLink(std::string port);
    ~BoardLink();
    BoardLink(const BoardLink&) = delete;
    BoardLink& operator=(const BoardLink&) = delete;

    /// Waits until the board is ready and has sent telemetry. Empty, or the error. Gives up early on a port
    /// that could never be opened, but waits for a board that is starting. Any thread but the link thread.
    std::string awaitReady(const std::function<bool()>& keepGoing) const;

    /// The clock of BoardStrike::onsetNs. Any thread.
    static std::int64_t nowNs() noexcept;

    /// Queues an event. False, and counted as thinned, if the queue is full. One producer, wait-free.
    bool push(const BoardStrike& strike) noexcept { return strikes_.push(strike); }

    /// True if the connected board plays segments; otherwise moving tones are sent as series of events. Link
    /// thread, as the methods up to refuseSegment().
    bool supportsSegments() const noexcept { return status_.board.version >= wire::firstVersionWithSegments; }
    /// True if a segment due at `dueNs` can be sent now: the clock is known, line and board have room.
    bool canSendSegment(std::int64_t dueNs);
    /// The board's frame at that time, with its fraction; only while the clock is known.
    double frameAt(std::int64_t steadyNs) const noexcept { return clock_.frameAt(steadyNs); }
    /// The earliest time at which a segment that is sent now can be played.
    std::int64_t segmentReadyNs() const;
    /// Sends a segment; one that is over by segmentReadyNs() is counted as refused. Only if canSendSegment().
    void sendSegment(const BoardSegment& segment, bool isCoarse);
    void refuseSegment() noexcept { ++status_.refused; }

    /// Sets the function that the link thread calls about every millisecond; empty: none. Only it may push
    /// events, give commands and send segments, and it must be quick. When this returns, the link thread has
    /// left the previous function. M.
    void setFeed(std::function<void()> feed);

    void stopAll() {
        addCommand([](Commands& commands) { commands.stopAll = true; });
    }
    void requestSelfTest() {
        addCommand([](Commands& commands) { commands.selfTest = true; });
    }
    /// Negative gains invert the polarity; -8 to 8. Sent repeatedly, at first at short intervals, because the
    /// line may lose them and the board may be switched off.
    void setGains(const std::array<double, limits::board::channels>& gains);

    BoardLinkStatus status() const;
    bool hasConnected() const { ///< whether a board has ever answered
        const std::scoped_lock lock{mutex_};
        return publishedStatus_.connections > 0;
    }

private:
    using State = BoardLinkStatus::State;
    struct Commands {
        bool stopAll = false, selfTest = false;
        std::optional<wire::Gains> gains;
    };
    template <class Change>
    void addCommand(Change change) {
        const std::scoped_lock lock{mutex_};
        change(commands_);
    }
    void run();
    void search();
    void disconnect(const std::string& why);
    void receive();
    void handle(std::span<const std::uint8_t> payload);
    void handleHello(const wire::HelloReply& board);
    void handlePong(const wire::Pong& pong);
    void greet();                // repeats Hello until the board answers
    void sendPeriodicMessages(); // pings, requests for telemetry, and gains, when due
    void executeCommands();
    void sendStrikes();
    void publish();
    double transitMs() const; // longest time from sending to playing
    bool isLineFree(std::int64_t now) const;
    template <class Message>
    void send(const Message& message);

    const std::string port_;
    EventQueue<BoardStrike, 1024> strikes_;
    std::mutex feedMutex_; // guards feed_; locked before mutex_
    std::function<void()> feed_;
    mutable std::mutex mutex_; // guards commands_ and publishedStatus_
    Commands commands_;
    BoardLinkStatus publishedStatus_;
    std::atomic<bool> isStopping_{false};

    // The following members belong to the link thread.
    std::unique_ptr<SerialLine> line_;
    wire::FrameDecoder decoder_;
    LinkClock clock_;
    StrikeBacklog backlog_;
    BoardLinkStatus status_;
    std::optional<wire::Gains> gains_;
    std::array<std::int64_t, 256> pingSentNs_{}; // 0: no ping with this id is unanswered
    std::int64_t lastReceivedNs_ = 0, nextHelloNs_ = 0, nextPingNs_ = 0, nextTelemetryNs_ = 0,
                 nextGainsNs_ = 0, gainsRepeatNs_ = 0, nextSearchNs_ = 0, lineFreeNs_ = 0;
    std::vector<std::uint32_t> segmentEnds_; // end frames of segments in transit or on the board
    std::size_t portsTried_ = 0;
    std::uint8_t pingId_ = 0, sequence_ = 0xFF;
    std::thread thread_;
};

} // namespace physvib
