// SPDX-License-Identifier: MIT
// Silence is held by who asked for it: an output sounds only while nobody holds it silent.
#pragma once
#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>

namespace physvib {

struct SilenceControl;

/// By which input silence is asked for. The machine is whoever sits at it: Esc, a button, the program's own
/// call.
enum class SilenceHolder : std::size_t { machine, standardInput, osc };

/// Counts what each holder has asked for and how much of that was lifted. So an off that has waited for its
/// turn lifts no silence that was asked for after it. Any thread, without locks.
class SilenceHolders {
public:
    /// The number of this request: 1 for the first of `holder`.
    std::uint64_t ask(SilenceHolder holder) noexcept { return of(holder).asked.fetch_add(1) + 1; }

    /// The same for a request that its input has numbered; done again, it changes nothing.
    void ask(SilenceHolder holder, std::uint64_t number) noexcept { raise(of(holder).asked, number); }

    /// How many times `holder` has asked.
    std::uint64_t asked(SilenceHolder holder) const noexcept { return of(holder).asked.load(); }

    /// Lifts what `holder` has asked for, up to that number.
    void lift(SilenceHolder holder, std::uint64_t number) noexcept {
        raise(of(holder).lifted, std::min(number, asked(holder)));
    }

    /// Lifts what everybody has asked for: only for the machine.
    void liftAll() noexcept {
        for (Requests& all : requests_) raise(all.lifted, all.asked.load());
    }

    bool isHeldBy(SilenceHolder holder) const noexcept { return of(holder).isHeld(); }

    /// Wait-free.
    bool isSilent() const noexcept { return std::ranges::any_of(requests_, &Requests::isHeld); }

private:
    using Number = std::atomic<std::uint64_t>;
    static_assert(Number::is_always_lock_free);

    struct Requests {
        Number asked{0}, lifted{0};
        bool isHeld() const noexcept {
            const std::uint64_t until = lifted.load(); // read first: it never exceeds what was asked
            return asked.load() > until;
        }
    };
    Requests& of(SilenceHolder holder) noexcept { return requests_[static_cast<std::size_t>(holder)]; }
    const Requests& of(SilenceHolder holder) const noexcept {
        return requests_[static_cast<std::size_t>(holder)];
    }
    static void raise(Number& number, std::uint64_t least) noexcept {
        for (std::uint64_t now = number.load(); now < least && !number.compare_exchange_weak(now, least);) {
        }
    }

    std::array<Requests, 3> requests_;
};

/// Does what the control of an input says. Empty, or one line: it is lifted for this input, but others still
/// ask for silence. Any thread.
std::string takeSilence(SilenceHolders& silence, const SilenceControl& control, SilenceHolder holder);

} // namespace physvib
