// SPDX-License-Identifier: MIT
// Queue of controls to a renderer or a sink (ControlQueue), and its pool of panners (PannerPool): a panner is
// fifty times larger than a control, so a control points to a copy, which the reader hands back.
#pragma once
#include "Core/EventQueue.h"
#include "Core/RenderControl.h"
#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <new>

namespace physvib {

/// At most `Max` panners that wait for their reader. One sender, one reader.
template <std::size_t Max>
class PannerPool {
public:
    PannerPool() = default;
    PannerPool(const PannerPool&) = delete;
    PannerPool& operator=(const PannerPool&) = delete;
    ~PannerPool() {
        std::for_each_n(slots_.begin(), count_, [](Slot* slot) { delete slot; });
    }

    /// Makes `count` places, at most `Max`. Sender only, not while it renders. False: no memory.
    bool reserve(std::size_t count) noexcept {
        for (; count_ < std::min(count, Max); ++count_)
            if ((slots_[count_] = new (std::nothrow) Slot) == nullptr) return false;
        return true;
    }

    /// A copy that stays until it is handed back; null: all places are in use. Sender only, wait-free.
    const PhantomPanner* store(const PhantomPanner& panner) noexcept {
        Slot* const slot = findFree();
        if (slot == nullptr) return nullptr;
        static_cast<PhantomPanner&>(*slot) = panner;
        slot->isFree.store(false, std::memory_order_relaxed);
        return slot;
    }
    bool hasRoom() const noexcept { return findFree() != nullptr; } ///< sender only, wait-free
    std::size_t count() const noexcept { return count_; }           ///< sender only

    /// Hands back what store() of any pool has returned. Reader only, wait-free.
    static void release(const PhantomPanner* copy) noexcept {
        if (copy != nullptr) static_cast<const Slot*>(copy)->isFree.store(true, std::memory_order_release);
    }

    /// Frees all places. Only while neither side uses it.
    void clear() noexcept {
        std::for_each_n(slots_.begin(), count_, [](Slot* slot) { release(slot); });
    }

private:
    struct Slot : PhantomPanner {
        mutable std::atomic<bool> isFree{true};
    };
    Slot* findFree() const noexcept {
        const auto end = slots_.begin() + static_cast<std::ptrdiff_t>(count_);
        const auto found = std::find_if(slots_.begin(), end, [](const Slot* slot) {
            return slot->isFree.load(std::memory_order_acquire);
        });
        return found == end ? nullptr : *found;
    }

    std::array<Slot*, Max> slots_{};
    std::size_t count_ = 0;
};

/// Up to `Capacity` controls from one sender to one reader. Places of panners are made when they are needed,
/// up to `Capacity`: then pushing a panner may allocate. With `Panners` as many are made at once and none
/// later, for a sender that renders.
template <std::size_t Capacity, std::size_t Panners = 0>
class ControlQueue {
public:
    ControlQueue() noexcept { panners_.reserve(Panners); }

    /// False, and counted: the queue is full, or all places of panners are in use. The control's panner is
    /// copied. Sender only.
    bool push(RenderControl control) noexcept {
        if (control.panner != nullptr && (control.panner = copyOf(*control.panner)) == nullptr) {
            refusedCount_.store(refusedCount_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
            return false;
        }
        if (controls_.push(control)) return true;
        done(control);
        return false;
    }

    /// False: the queue is empty. Reader only, wait-free. Call done() when the control's panner was used.
    bool pop(RenderControl& control) noexcept { return controls_.pop(control); }
    /// Hands the control's panner back to its sender. Reader only, wait-free.
    static void done(const RenderControl& control) noexcept { Pool::release(control.panner); }

    /// Forgets all controls, also those that were popped and are not done. Only while neither side uses it.
    void clear() noexcept {
        for (RenderControl unread; controls_.pop(unread);) {
        }
        panners_.clear();
    }

    /// How many controls were refused. Any thread, wait-free.
    std::size_t overflows() const noexcept {
        return controls_.overflows() + refusedCount_.load(std::memory_order_relaxed);
    }

private:
    using Pool = PannerPool<(Panners > 0 ? Panners : Capacity)>;
    const PhantomPanner* copyOf(const PhantomPanner& panner) noexcept {
        const PhantomPanner* copy = panners_.store(panner);
        if (copy != nullptr || Panners > 0) return copy;
        return panners_.reserve(panners_.count() + 1) ? panners_.store(panner) : nullptr;
    }

    EventQueue<RenderControl, Capacity> controls_;
    Pool panners_;
    std::atomic<std::size_t> refusedCount_{0};
};

} // namespace physvib
