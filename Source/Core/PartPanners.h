// SPDX-License-Identifier: MIT
// Panners of a layout's parts of the body, kept between events.
#pragma once
#include "Core/PhantomPanner.h"
#include "Core/Storage.h"
#include <algorithm>
#include <array>
#include <cstddef>

namespace physvib {

/// A panner and those of its parts. A part's is found when it is first struck, which may take 10 us, and kept
/// until the panner changes. Of more parts than `maxKept`, or than were prepared, the oldest is found anew.
class PartPanners {
public:
    static constexpr std::size_t maxKept = 16; ///< Core/BodyLayouts.h names 15

    /// Makes room for the parts of a panner of at most so many actuators: each part has one of its own.
    /// False: no memory. Message thread (M), not while rendering.
    bool prepare(int actuators) noexcept {
        const std::size_t count = std::min(maxKept, static_cast<std::size_t>(actuators));
        parts_.fill(0);
        next_ = 0;
        kept_ = panners_.resize(count) ? count : 0;
        return kept_ == count;
    }

    /// Forgets the parts of the panner of before.
    PartPanners& operator=(const PhantomPanner& whole) noexcept {
        whole_ = whole;
        parts_.fill(0);
        next_ = 0;
        return *this;
    }

    const PhantomPanner& whole() const noexcept { return whole_; } ///< The panner itself.

    /// As PhantomPanner::gainsAt.
    void gainsAt(const CollisionEvent& event, PhantomPanner::Gains& gains) noexcept {
        if (kept_ == 0 || !whole_.divides(event.source.part)) return whole_.gainsAt(event, gains);
        whole_.gainsAt(event, panners_[indexOf(event.source.part)], gains);
    }

private:
    std::size_t indexOf(PartNumber part) noexcept {
        for (std::size_t i = 0; i < kept_; ++i)
            if (parts_[i] == part) return i;
        const std::size_t i = next_;
        next_ = (next_ + 1) % kept_;
        parts_[i] = part;
        panners_[i] = whole_.onPart(part);
        return i;
    }

    PhantomPanner whole_;
    std::array<PartNumber, maxKept> parts_{}; // 0: none
    Storage<PhantomPanner, maxKept, true> panners_;
    std::size_t kept_ = 0, next_ = 0; // next_: the one to be replaced
};

} // namespace physvib
