// SPDX-License-Identifier: MIT
// Requests for silence, counted per input: an output sounds only while no input requests silence.
#pragma once
#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>

namespace physvib {

struct SilenceControl;

/// The inputs that can request silence. machine: the user at this computer, by Esc, a button or the program's
/// own call.
enum class MuteRequester : std::size_t { machine, standardInput, osc };

/// Counts requests and withdrawals per input, so that a delayed "off" does not withdraw a newer request. Any
/// thread, lock-free.
class MuteRequests {
public:
    /// Requests silence; returns the number of the request: 1 for the first of `holder`.
    std::uint64_t request(MuteRequester holder) noexcept { return of(holder).asked.fetch_add(1) + 1; }

    /// The same for a request that has a number already; repeating it changes nothing.
    void request(MuteRequester holder, std::uint64_t number) noexcept { raise(of(holder).asked, number); }

    /// How many times `holder` has requested silence.
    std::uint64_t asked(MuteRequester holder) const noexcept { return of(holder).asked.load(); }

    /// Withdraws the requests of `holder` up to that number.
    void lift(MuteRequester holder, std::uint64_t number) noexcept {
        raise(of(holder).lifted, std::min(number, asked(holder)));
    }

    /// Withdraws all requests of all inputs: only for the machine.
    void liftAll() noexcept {
        for (Requests& all : requests_) raise(all.lifted, all.asked.load());
    }

    bool isHeldBy(MuteRequester holder) const noexcept { return of(holder).isHeld(); }

    /// Wait-free.
    bool isSilent() const noexcept { return std::ranges::any_of(requests_, &Requests::isHeld); }

private:
    using Number = std::atomic<std::uint64_t>;
    static_assert(Number::is_always_lock_free);

    struct Requests {
        Number asked{0}, lifted{0};
        bool isHeld() const noexcept {
            const std::uint64_t until = lifted.load(); // read first, so that it never exceeds `asked`
            return asked.load() > until;
        }
    };
    Requests& of(MuteRequester holder) noexcept { return requests_[static_cast<std::size_t>(holder)]; }
    const Requests& of(MuteRequester holder) const noexcept {
        return requests_[static_cast<std::size_t>(holder)];
    }
    static void raise(Number& number, std::uint64_t least) noexcept {
        for (std::uint64_t now = number.load(); now < least && !number.compare_exchange_weak(now, least);) {
        }
    }

    std::array<Requests, 3> requests_;
};

/// Executes an input's control. Empty, or one line: withdrawn, but other inputs still request silence. Any
/// thread.
std::string takeSilence(MuteRequests& silence, const SilenceControl& control, MuteRequester holder);

} // namespace physvib
