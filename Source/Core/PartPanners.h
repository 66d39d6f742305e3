// SPDX-License-Identifier: MIT
// Panners of a layout's parts of the body, kept between events.
#pragma once
#include "Core/PhantomPanner.h"
#include <array>
#include <cstddef>

namespace physvib {

/// A panner and those of its parts. A part's is found when it is first struck, which may take 10 us, and kept
/// until the panner changes. Of more parts than `mostKept` the oldest is found anew. No heap. One thread.
class PartPanners {
public:
    static constexpr std::size_t mostKept = 16; ///< Core/BodyLayouts.h names 15

    PartPanners() = default;
    explicit PartPanners(const PhantomPanner& whole) noexcept
        : whole_{whole} {}

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
        if (!whole_.divides(event.source.part)) return whole_.gainsAt(event, gains);
        whole_.gainsAt(event, panners_[indexOf(event.source.part)], gains);
    }

private:
    std::size_t indexOf(PartNumber part) noexcept {
        for (std::size_t i = 0; i < mostKept; ++i)
            if (parts_[i] == part) return i;
        const std::size_t i = next_;
        next_ = (next_ + 1) % mostKept;
        parts_[i] = part;
        panners_[i] = whole_.onPart(part);
        return i;
    }

    PhantomPanner whole_;
    std::array<PartNumber, mostKept> parts_{}; // 0: none
    std::array<PhantomPanner, mostKept> panners_{};
    std::size_t next_ = 0; // the one to be replaced
};

} // namespace physvib
