// SPDX-License-Identifier: GPL-3.0-or-later
// OscPort: OSC input and output of a live session, on its own threads; OscReplyLimiter limits its replies.
#pragma once
#include "Core/RenderControl.h"
#include "Host/Osc/OscReceiver.h"
#include "Live/Messages/MessageRouter.h"
#include "Live/Session/OutputClock.h"
#include "Live/Session/Scheduler.h"
#include "Live/Session/Sink.h"
#include "Live/Sockets/UdpSocket.h"
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace physvib {

/// Limits the replies to each sender: its address can be forged, so PhysVib must not amplify traffic towards
/// it. A reply may be as long as the packet that it answers. Beyond that, an address gets at most `freeBytes`
/// in any second, and a refusal for one reason once per `refusalIntervalNs`. An address is another computer,
/// or a port of this one. The caller provides the clock. One thread at a time.
class OscReplyLimiter {
public:
    static constexpr std::size_t freeBytes = 2000;
    static constexpr std::int64_t secondNs = 1'000'000'000, refusalIntervalNs = 100'000'000;
    static constexpr std::size_t maxSenders = 64; ///< addresses per second; further ones get no replies

    /// A packet of that size has come from HOST:PORT; the next calls are about replies to it.
    void packetReceived(std::string_view sender, std::size_t bytes, std::int64_t nowNs) {
        nowNs_ = nowNs;
        bytesLeft_ = bytes;
        current_ = find(isLoopback(sender) ? sender : sender.substr(0, sender.rfind(':')));
        if (current_ == nullptr) return;
        current_->lastNs = nowNs;
        std::erase_if(current_->sentReplies,
                      [nowNs](const SentReply& sent) { return sent.atNs <= nowNs - secondNs; });
    }

    /// Whether a reply of that size may be sent; if so, it counts as sent.
    bool tryReply(std::size_t bytes) {
        const std::size_t extraBytes = bytes - std::min(bytes, bytesLeft_);
        const auto add = [](std::size_t sum, const SentReply& sent) { return sum + sent.bytes; };
        if (current_ == nullptr || std::accumulate(current_->sentReplies.begin(), current_->sentReplies.end(),
                                                   extraBytes, add) > freeBytes)
            return ++heldBack_, false;
        bytesLeft_ -= bytes - extraBytes;
        if (extraBytes > 0) current_->sentReplies.push_back({nowNs_, extraBytes});
        return true;
    }

    /// Whether a refusal for that reason may be sent.
    bool tryRefusal(std::string_view reason) {
        return (current_ != nullptr && current_->refusals.shouldReport(reason, nowNs_)) ||
               (++heldBack_, false);
    }

    /// Number of replies not sent so far.
    std::uint64_t heldBack() const noexcept { return heldBack_; }

private:
    static bool isLoopback(std::string_view sender) {
        return sender.starts_with("127.") || sender.starts_with("::1:");
    }

    struct SentReply {
        std::int64_t atNs;
        std::size_t bytes;
    };
    struct Sender {
        std::string name;
        std::int64_t lastNs;
        std::vector<SentReply> sentReplies;
        ErrorRateLimit refusals{refusalIntervalNs};
    };
    // A sender that was quiet for a second has spent nothing, so its place is reused.
    Sender* find(std::string_view name) {
        const auto found = std::ranges::find(senders_, name, &Sender::name);
        if (found != senders_.end()) return &*found;
        const auto quiet = std::ranges::min_element(senders_, {}, &Sender::lastNs);
        if (senders_.size() < maxSenders)
            senders_.push_back({std::string(name), nowNs_, {}});
        else if (quiet->lastNs <= nowNs_ - secondNs)
            return &(*quiet = {std::string(name), nowNs_, {}});
        else
            return nullptr;
        return &senders_.back();
    }

    std::vector<Sender> senders_;
    Sender* current_ = nullptr; // null: too many senders
    std::size_t bytesLeft_ = 0; // free reply bytes for this packet
    std::int64_t nowNs_ = 0;
    std::uint64_t heldBack_ = 0;
};

inline constexpr const char* oscLoopbackAddress = "127.0.0.1";
inline constexpr const char* oscAnyAddress = "0.0.0.0";
constexpr int oscDefaultPort = 9000; ///< default port of phone sensor programs

struct OscSettings {
    std::string address = oscLoopbackAddress; ///< local address to receive on
    std::optional<int> port;        ///< if taken, the next free port is used; 0: any; nullopt: no input
    std::string receiver;           ///< HOST:PORT that gets hits and status; empty: none
    double phoneAngleRadians = 0.0; ///< angle at which the phone is held, counter-clockwise from upright
};

struct OscStatus {
    std::string address; ///< ADDRESS:PORT; empty: no input
    OscCounts counts;
    std::uint64_t sent = 0, unsent = 0; ///< packets with hits and status
};

/// One thread reads packets and silences at once if one requests it; a second executes them in order.
class OscPort final : public Sink {
public:
    static constexpr std::int64_t statusIntervalNs = 1'000'000'000;

    /// All arguments outlive the port. Check error() afterwards. M.
    OscPort(const OscSettings& settings, Session& session, MessageRouter& messages, OutputClock& device,
            OscHooks hooks);
    ~OscPort() override;

    /// Empty, or one line why the port is not open. Any thread.
    const std::string& error() const noexcept { return error_; }

    /// Number of the port; 0: no input. Any thread.
    int port() const noexcept { return inputSocket_.port(); }
    int bufferBytes() const { return inputSocket_.bufferBytes(); }

    /// Sends the hit to the receiver. M.
    void onPlayed(const PlayedEvent& played, int sampleRateHz) override;

    /// Sends a refusal of an action that a hook had accepted but that failed later. Any thread but R.
    void refuse(const OscOrigin& origin, const std::string& reason);

    /// Any thread but R.
    OscStatus status() const;

private:
    /// A packet that was read but not yet executed.
    struct Packet {
        std::vector<char> bytes;
        UdpSender from;
        std::uint64_t silences = 0; // requests before this packet
    };
    void runReader();
    void runExecutor();
    void receive();
    void reply(std::size_t packetBytes, const UdpSender& to);
    void sendLateRefusals();
    void sendRefusal(const OscRefusal& refusal, const UdpSender& to);
    void updateClock();
    void sendStatus();
    void count(bool sent) noexcept;

    Session& session_;
    OutputClock& device_;
    OscReceiver receiver_;
    UdpSocket inputSocket_, outputSocket_;
    std::string error_;
    std::string address_, lastError_;
    std::vector<std::vector<char>> pendingReplies_;
    OscReplyLimiter replyLimiter_;
    std::int64_t unixMinusSteadyNs_ = 0, nextStatusNs_ = 0;
    mutable std::mutex mutex_; // guards the members below; only the port's thread changes the clock
    OscClock clock_;
    OscCounts counts_;
    std::vector<std::pair<OscRefusal, UdpSender>> lateRefusals_; // the port's thread sends them
    std::uint64_t droppedLateRefusals_ = 0;                      // refusals that found `lateRefusals_` full
    std::atomic<std::uint64_t> sent_{0}, unsent_{0};
    std::atomic<bool> isStopping_{false};
    InputQueue<Packet> packets_;
    std::atomic<std::uint64_t> lost_{0}; // packets dropped here or by the system, not yet counted
    std::thread executor_, reader_;
};

} // namespace physvib
