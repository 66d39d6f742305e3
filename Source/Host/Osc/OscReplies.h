// SPDX-License-Identifier: GPL-3.0-or-later
// Limits the replies to each sender. A sender's address can be forged, so PhysVib must not amplify traffic
// towards it.
#pragma once
#include "Live/Messages/ErrorRateLimit.h"
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// A reply may be as long as the packet that it answers. Beyond that, an address gets at most `freeBytes` in
/// any second, and a refusal for one reason once per `refusalEveryNs`. An address is another computer, or a
/// port of this one. The caller provides the clock. One thread at a time.
class OscReplies {
public:
    static constexpr std::size_t freeBytes = 2000;
    static constexpr std::int64_t secondNs = 1'000'000'000, refusalEveryNs = 100'000'000;
    static constexpr std::size_t mostSenders = 64; ///< addresses per second; further ones get no replies

    /// A packet of that size has come from HOST:PORT; the next calls are about replies to it.
    void begin(std::string_view sender, std::size_t bytes, std::int64_t nowNs) {
        nowNs_ = nowNs;
        bytesLeft_ = bytes;
        current_ = find(isThisComputer(sender) ? sender : sender.substr(0, sender.rfind(':')));
        if (current_ == nullptr) return;
        current_->lastNs = nowNs;
        std::erase_if(current_->spent, [nowNs](const Spent& one) { return one.atNs <= nowNs - secondNs; });
    }

    /// Whether a reply of that size may be sent; if so, it counts as sent.
    bool mayReply(std::size_t bytes) {
        const std::size_t beyond = bytes - std::min(bytes, bytesLeft_);
        const auto add = [](std::size_t sum, const Spent& one) { return sum + one.bytes; };
        if (current_ == nullptr ||
            std::accumulate(current_->spent.begin(), current_->spent.end(), beyond, add) > freeBytes)
            return ++heldBack_, false;
        bytesLeft_ -= bytes - beyond;
        if (beyond > 0) current_->spent.push_back({nowNs_, beyond});
        return true;
    }

    /// Whether a refusal for that reason may be sent.
    bool mayRefuse(std::string_view reason) {
        return (current_ != nullptr && current_->refusals.take(reason, nowNs_)) || (++heldBack_, false);
    }

    /// Number of replies not sent so far.
    std::uint64_t heldBack() const noexcept { return heldBack_; }

private:
    static bool isThisComputer(std::string_view sender) {
        return sender.starts_with("127.") || sender.starts_with("::1:");
    }

    struct Spent {
        std::int64_t atNs;
        std::size_t bytes;
    };
    struct Sender {
        std::string name;
        std::int64_t lastNs;
        std::vector<Spent> spent;
        ErrorRateLimit refusals{refusalEveryNs};
    };
    // A sender that was quiet for a second has spent nothing, so its place is reused.
    Sender* find(std::string_view name) {
        const auto known = std::ranges::find(senders_, name, &Sender::name);
        if (known != senders_.end()) return &*known;
        const auto quiet = std::ranges::min_element(senders_, {}, &Sender::lastNs);
        if (senders_.size() < mostSenders)
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

} // namespace physvib
