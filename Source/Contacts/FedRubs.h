// SPDX-License-Identifier: MIT
// What other engines tell of contacts that last, step by step, becomes points that are followed.
#pragma once
#include "Contacts/IntegerMap.h"
#include "Contacts/LastingContacts.h"
#include "Contacts/Vector2.h"
#include <cstddef>
#include <cstdint>
#include <vector>

namespace physvib {

/// A pair that goes on pushing while the point of contact moves. A ball that rolls at v over a floor: v along
/// both. A box that slides at v: v along the floor, 0 along the box.
struct Rub {
    std::int32_t a = 0, b = 0; ///< slots of the FixtureTable
    double newtonSeconds = 0.0;
    Vector2 point;                     ///< world
    double alongA = 0.0, alongB = 0.0; ///< m/s, how fast the point moves along each surface; their difference
                                       ///< is the slip
};

/// One point of each pair: what several points push is summed up, where the last of them is. Places along the
/// surfaces are summed up from the speeds, from 0 where the pair began. All methods: the world's thread (M).
class FedRubs {
public:
    void tell(const Rub& rub);
    /// The step's, to `lasting`; what was not told has ended.
    void endStep(double seconds, LastingContacts& lasting);
    void forget(std::int32_t slot); ///< it has another owner from now on

private:
    struct Track {
        std::uint64_t key;
        LastingPoint point;
        Vector2 before;
        bool isNew, isTold;
    };
    void drop(std::size_t track);

    std::vector<Track> tracks_;
    IntegerMap trackOf_;
};

} // namespace physvib
