// SPDX-License-Identifier: MIT
// Decides which contact points of a touching pair are new, by comparing numbers or places with those of the
// last step.
#pragma once
#include "Contacts/ContactFeed.h"
#include "Contacts/Vector3.h"
#include <cstdint>
#include <utility>
#include <vector>

namespace physvib {

/// Points of pairs, of this step and of the last. All methods: the world's thread (M). Allocates only to
/// grow.
class FedPoints {
public:
    static constexpr std::int32_t none = -1; ///< of a chain: empty

    /// The points of one pair; the pair stores it.
    struct Chain {
        std::int32_t now = none, before = none;
    };

    /// Records a point of this step. True if the pair did not have it in the last step: no point of that
    /// number, or none within `withinMetres` across the normal. Distance along the normal does not count,
    /// because surfaces sink into each other, by several centimetres where contacts are springs.
    bool isNew(Chain& chain, std::int32_t id, Vector3 place, Vector3 normal, double withinMetres) {
        bool isOld = false;
        for (std::int32_t at = chain.before; at != none && !isOld;
             at = before_[static_cast<std::size_t>(at)].next) {
            const Point& point = before_[static_cast<std::size_t>(at)];
            isOld = id == FedContact::byPlace ? across(point.place - place, normal) <= withinMetres
                                              : point.id == id;
        }
        now_.push_back({place, id, chain.now});
        chain.now = static_cast<std::int32_t>(now_.size()) - 1;
        return !isOld;
    }

    /// This step's points become those of the last; the owner of each chain updates it likewise.
    void endStep() {
        std::swap(before_, now_);
        now_.clear();
    }

private:
    static double across(Vector3 way, Vector3 normal) noexcept { return lengthOf(cross(way, normal)); }

    struct Point {
        Vector3 place;
        std::int32_t id, next;
    };
    std::vector<Point> now_, before_;
};

} // namespace physvib
