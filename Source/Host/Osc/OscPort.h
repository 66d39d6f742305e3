// SPDX-License-Identifier: GPL-3.0-or-later
// Open Sound Control in and out of a live session, on a thread of its own.
#pragma once
#include "Core/RenderControl.h"
#include "Host/Osc/OscDoor.h"
#include "Host/Osc/OscReplies.h"
#include "Host/Osc/OscSocket.h"
#include "Live/Session/FeltOutput.h"
#include "Live/Session/InputQueue.h"
#include "Live/Session/Sink.h"
#include <atomic>
#include <mutex>
#include <optional>
#include <thread>

namespace physvib {

inline constexpr const char* oscThisComputer = "127.0.0.1";
inline constexpr const char* oscAnyComputer = "0.0.0.0";
constexpr int oscUsualPort = 9000; ///< where sensor programs send unless told otherwise

struct OscSettings {
    std::string address = oscThisComputer; ///< of this computer, that packets are taken at
    std::optional<int> port;               ///< or the next free one; 0: any; nullopt: nothing is taken
    std::string receiver;                  ///< HOST:PORT of hits and status; empty: none
    double turnRadians = 0.0;              ///< by which a phone is held counter-clockwise of upright
};

struct OscStatus {
    std::string address; ///< ADDRESS:PORT; empty: nothing is taken
    OscCounts counts;
    std::uint64_t sent = 0, unsent = 0; ///< hits and status
};

/// One thread reads packets, and silences at once if one of them says so; another does what they say, in
/// their order.
class OscPort final : public Sink {
public:
    static constexpr std::int64_t statusEveryNs = 1'000'000'000;

    /// All outlive it. See error(). M.
    OscPort(const OscSettings& settings, Session& session, MessageRouter& messages, FeltOutput& device,
            OscHooks hooks);
    ~OscPort() override;

    /// Empty, or why it is not open: one line. Any thread.
    const std::string& error() const noexcept { return error_; }

    /// The number of the port; 0: nothing is taken. Any thread.
    int port() const noexcept { return in_.port(); }
    int bufferBytes() const { return in_.bufferBytes(); }

    /// To the receiver. M.
    void played(const PlayedEvent& played, int sampleRateHz) override;

    /// What a hook has taken could not be done after all: its sender is told. Any thread but R.
    void refuse(const OscOrigin& origin, const std::string& reason);

    /// Any thread but R.
    OscStatus status() const;

private:
    /// What was read and is still to be done.
    struct Packet {
        std::vector<char> bytes;
        OscSender from;
        std::uint64_t silences = 0; // asked for before it
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
    FeltOutput& device_;
    OscDoor door_;
    OscSocket in_, out_;
    std::string error_;
    std::string address_, fault_;
    std::vector<std::vector<char>> answers_;
    OscReplies replies_;
    std::int64_t unixAheadNs_ = 0, nextStatusNs_ = 0;
    mutable std::mutex mutex_; // guards what follows; the clock is changed by the port's thread alone
    OscClock clock_;
    OscCounts counts_;
    std::vector<std::pair<OscRefusal, OscSender>> late_; // to be sent by the port's thread
    std::uint64_t lateHeld_ = 0;                         // that found no room there
    std::atomic<std::uint64_t> sent_{0}, unsent_{0};
    std::atomic<bool> stop_{false};
    InputQueue<Packet> packets_;
    std::atomic<std::uint64_t> lost_{0}; // that had no room, here or in the system, and are not counted yet
    std::thread thread_, reader_;
};

} // namespace physvib
