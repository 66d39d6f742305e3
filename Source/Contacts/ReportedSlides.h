// SPDX-License-Identifier: MIT
// Converts the lasting contacts (rolling, sliding) that a foreign engine reports per step to tracked contact
// points.
#pragma once
#include "Contacts/IntegerMap.h"
#include "Contacts/LastingContacts.h"
#include "Contacts/Vector3.h"
#include <cstddef>
#include <cstdint>
#include <vector>

namespace physvib {

/// A pair in contact whose contact point moves. A ball that rolls at v over a floor: v along both. A box that
/// slides at v: v along the floor, 0 along the box.
struct Rub {
    std::int32_t a = 0, b = 0; ///< slots of the FixtureTable
    double newtonSeconds = 0.0;
    Vector3 point;                     ///< world
    double alongA = 0.0, alongB = 0.0; ///< m/s, speed of the point along each surface; their difference is
                                       ///< the slip
};

/// One point per pair: impulses of several points are summed, the last one's place is used. Positions along
/// the surfaces are integrated from the speeds, starting at 0 with the contact. All methods: the world's
/// thread (M).
class ReportedSlides {
public:
    void tell(const Rub& rub);
    /// Passes the step's points to `lasting`; contacts that were not reported have ended.
    void endStep(double seconds, LastingContacts& lasting);
    void forget(std::int32_t slot); ///< the slot is freed or reassigned

private:
    struct Track {
        std::uint64_t key;
        LastingPoint point;
        Vector3 before;
        bool isNew, isTold;
    };
    void drop(std::size_t track);

    std::vector<Track> tracks_;
    IntegerMap trackOf_;
};

} // namespace physvib
