// SPDX-License-Identifier: MIT
// Controls on their way to a renderer or a sink. A panner is fifty times larger than any other control, so it
// waits in a place of its own: the sender fills the place, the reader hands it back.
#pragma once
#include "Core/EventQueue.h"
#include "Core/RenderControl.h"
#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <new>

namespace physvib {

/// At most `Most` panners that wait for their reader. One sender, one reader.
template <std::size_t Most>
class PannerPool {
public:
    PannerPool() = default;
    PannerPool(const PannerPool&) = delete;
    PannerPool& operator=(const PannerPool&) = delete;
    ~PannerPool() {
        std::for_each_n(places_.begin(), made_, [](Place* place) { delete place; });
    }

    /// Makes `count` places, at most `Most`. The sender's, if it does not render. False: no memory.
    bool reserve(std::size_t count) noexcept {
        for (; made_ < std::min(count, Most); ++made_)
            if ((places_[made_] = new (std::nothrow) Place) == nullptr) return false;
        return true;
    }

    /// A copy that stays until it is handed back; null: all places are in use. The sender's, wait-free.
    const PhantomPanner* put(const PhantomPanner& panner) noexcept {
        Place* const place = free();
        if (place == nullptr) return nullptr;
        static_cast<PhantomPanner&>(*place) = panner;
        place->isFree.store(false, std::memory_order_relaxed);
        return place;
    }
    bool hasRoom() const noexcept { return free() != nullptr; } ///< the sender's, wait-free
    std::size_t made() const noexcept { return made_; }         ///< the sender's

    /// Hands back what put() of any pool has returned. The reader's, wait-free.
    static void handBack(const PhantomPanner* kept) noexcept {
        if (kept != nullptr) static_cast<const Place*>(kept)->isFree.store(true, std::memory_order_release);
    }

    /// All places are free. While neither side uses it.
    void clear() noexcept {
        std::for_each_n(places_.begin(), made_, [](Place* place) { handBack(place); });
    }

private:
    struct Place : PhantomPanner {
        mutable std::atomic<bool> isFree{true};
    };
    Place* free() const noexcept {
        const auto end = places_.begin() + static_cast<std::ptrdiff_t>(made_);
        const auto found = std::find_if(places_.begin(), end, [](const Place* place) {
            return place->isFree.load(std::memory_order_acquire);
        });
        return found == end ? nullptr : *found;
    }

    std::array<Place*, Most> places_{};
    std::size_t made_ = 0;
};

/// Up to `Capacity` controls from one sender to one reader. Places of panners are made when they are needed,
/// up to `Capacity`: then pushing a panner may allocate. With `Panners` as many are made at once and none
/// later, for a sender that renders.
template <std::size_t Capacity, std::size_t Panners = 0>
class ControlQueue {
public:
    ControlQueue() noexcept { panners_.reserve(Panners); }

    /// False, and counted: the queue is full, or all places of panners are in use. The control's panner is
    /// copied. The sender's.
    bool push(RenderControl control) noexcept {
        if (control.panner != nullptr && (control.panner = keep(*control.panner)) == nullptr) {
            refused_.store(refused_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
            return false;
        }
        if (controls_.push(control)) return true;
        done(control);
        return false;
    }

    /// False: the queue is empty. The reader's, wait-free. Call done() when the control's panner was used.
    bool pop(RenderControl& control) noexcept { return controls_.pop(control); }
    /// Hands the control's panner back to its sender. The reader's, wait-free.
    static void done(const RenderControl& control) noexcept { Pool::handBack(control.panner); }

    /// Forgets all controls, also those that were popped and are not done. While neither side uses it.
    void clear() noexcept {
        for (RenderControl undone; controls_.pop(undone);) {
        }
        panners_.clear();
    }

    /// How many controls were refused. Any thread, wait-free.
    std::size_t overflows() const noexcept {
        return controls_.overflows() + refused_.load(std::memory_order_relaxed);
    }

private:
    using Pool = PannerPool<(Panners > 0 ? Panners : Capacity)>;
    const PhantomPanner* keep(const PhantomPanner& panner) noexcept {
        const PhantomPanner* kept = panners_.put(panner);
        if (kept != nullptr || Panners > 0) return kept;
        return panners_.reserve(panners_.made() + 1) ? panners_.put(panner) : nullptr;
    }

    EventQueue<RenderControl, Capacity> controls_;
    Pool panners_;
    std::atomic<std::size_t> refused_{0};
};

} // namespace physvib
