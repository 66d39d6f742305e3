// SPDX-License-Identifier: GPL-3.0-or-later
// What may be sent back to a sender. Its address may be somebody else's: nobody is to get a flood from here
// that he did not send.
#pragma once
#include "Live/Messages/ComplaintLimit.h"
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// A packet is answered with as many bytes as it has; beyond that an address gets at most `freeBytes` in any
/// second, and a refusal of one cause once in `refusalEveryNs`. An address is another computer, or a port of
/// this one. The clock is the caller's. One thread at a time.
class OscReplies {
public:
    static constexpr std::size_t freeBytes = 2000;
    static constexpr std::int64_t secondNs = 1'000'000'000, refusalEveryNs = 100'000'000;
    static constexpr std::size_t mostSenders = 64; ///< addresses in a second; more get no replies

    /// A packet of so many bytes has come from HOST:PORT; what is asked next is about replies to it.
    void begin(std::string_view sender, std::size_t bytes, std::int64_t nowNs);

    /// Whether a reply of so many bytes may be sent; if so, it counts as sent.
    bool mayReply(std::size_t bytes);

    /// Whether a refusal of that reason may be.
    bool mayRefuse(std::string_view reason);

    /// What was not sent so far.
    std::uint64_t heldBack() const noexcept { return heldBack_; }

private:
    struct Spent {
        std::int64_t atNs;
        std::size_t bytes;
    };
    struct Sender {
        std::string name;
        std::int64_t lastNs;
        std::vector<Spent> spent;
        ComplaintLimit refusals{refusalEveryNs};
    };
    Sender* find(std::string_view name);

    std::vector<Sender> senders_;
    Sender* current_ = nullptr; // null: there are too many
    std::size_t bytesLeft_ = 0; // of the packet
    std::int64_t nowNs_ = 0;
    std::uint64_t heldBack_ = 0;
};

} // namespace physvib
