// SPDX-License-Identifier: GPL-3.0-or-later
// Open Sound Control input and output of a live session, on threads of its own.
#pragma once
#include "Core/RenderControl.h"
#include "Host/Osc/OscDoor.h"
#include "Host/Osc/OscReplies.h"
#include "Host/Osc/OscSocket.h"
#include "Live/Session/Input.h"
#include "Live/Session/OutputClock.h"
#include "Live/Session/Sink.h"
#include <atomic>
#include <mutex>
#include <optional>
#include <thread>

namespace physvib {

inline constexpr const char* oscThisComputer = "127.0.0.1";
inline constexpr const char* oscAnyComputer = "0.0.0.0";
constexpr int oscUsualPort = 9000; ///< default port of phone sensor programs

struct OscSettings {
    std::string address = oscThisComputer; ///< local address to receive on
    std::optional<int> port;  ///< if taken, the next free port is used; 0: any; nullopt: no input
    std::string receiver;     ///< HOST:PORT that gets hits and status; empty: none
    double turnRadians = 0.0; ///< angle at which the phone is held, counter-clockwise from upright
};

struct OscStatus {
    std::string address; ///< ADDRESS:PORT; empty: no input
    OscCounts counts;
    std::uint64_t sent = 0, unsent = 0; ///< packets with hits and status
};

/// One thread reads packets and silences at once if a packet requests it; a second thread executes the
/// packets in order.
class OscPort final : public Sink {
public:
    static constexpr std::int64_t statusEveryNs = 1'000'000'000;

    /// All arguments outlive the port. Check error() afterwards. M.
    OscPort(const OscSettings& settings, Session& session, MessageRouter& messages, OutputClock& device,
            OscHooks hooks);
    ~OscPort() override;

    /// Empty, or one line why the port is not open. Any thread.
    const std::string& error() const noexcept { return error_; }

    /// Number of the port; 0: no input. Any thread.
    int port() const noexcept { return in_.port(); }
    int bufferBytes() const { return in_.bufferBytes(); }

    /// Sends the hit to the receiver. M.
    void played(const PlayedEvent& played, int sampleRateHz) override;

    /// Sends a refusal of an action that a hook had accepted but that failed later. Any thread but R.
    void refuse(const OscOrigin& origin, const std::string& reason);

    /// Any thread but R.
    OscStatus status() const;

private:
    /// A packet that was read but not yet executed.
    struct Packet {
        std::vector<char> bytes;
        OscSender from;
        std::uint64_t silences = 0; // requests before this packet
    };
    void read();
    void readAll();
    void run();
    void receive();
    void reply(std::size_t packetBytes, const OscSender& to);
    void refuseLate();
    void sendRefusal(const OscRefusal& refusal, const OscSender& to);
    void followClock();
    void tellStatus();
    void count(bool left) noexcept;

    Session& session_;
    OutputClock& device_;
    OscDoor door_;
    OscSocket in_, out_;
    std::string error_;
    std::string address_, fault_;
    std::vector<std::vector<char>> answers_;
    OscReplies replies_;
    std::int64_t unixAheadNs_ = 0, nextStatusNs_ = 0;
    mutable std::mutex mutex_; // guards the members below; only the port's thread changes the clock
    OscClock clock_;
    OscCounts counts_;
    std::vector<std::pair<OscRefusal, OscSender>> late_; // the port's thread sends them
    std::uint64_t lateHeld_ = 0;                         // refusals that found `late_` full
    std::atomic<std::uint64_t> sent_{0}, unsent_{0};
    std::atomic<bool> stop_{false};
    InputQueue<Packet> packets_;
    std::atomic<std::uint64_t> lost_{0}; // packets dropped here or by the system, not yet counted
    std::thread thread_, reader_;
};

} // namespace physvib
