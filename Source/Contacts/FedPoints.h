// SPDX-License-Identifier: MIT
// Which points of a pair that touches were there in the step before, by their numbers or by their places.
#pragma once
#include "Contacts/ContactFeed.h"
#include "Contacts/Vector2.h"
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace physvib {

/// Points of pairs, of this step and of the one before it. All methods: the world's thread (M). Allocates
/// only when it outgrows what it has had.
class FedPoints {
public:
    static constexpr std::int32_t none = -1; ///< of a chain: empty

    /// The points of one pair, kept by the pair.
    struct Chain {
        std::int32_t now = none, before = none;
    };

    /// Notes a point of this step. Whether the pair did not have it in the step before: no point of that
    /// number, or none within so many metres across the normal. Along it surfaces sink into each other,
    /// several centimetres where contacts are springs.
    bool isNew(Chain& chain, std::int32_t id, Vector2 place, Vector2 normal, double withinMetres) {
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

    /// The points of this step are those of the one before, from now on; the owner of each chain does the
    /// same.
    void endStep() {
        std::swap(before_, now_);
        now_.clear();
    }

private:
    static double across(Vector2 way, Vector2 normal) noexcept {
        return std::abs(static_cast<double>(way.y * normal.x - way.x * normal.y));
    }

    struct Point {
        Vector2 place;
        std::int32_t id, next;
    };
    std::vector<Point> now_, before_;
};

} // namespace physvib
