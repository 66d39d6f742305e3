// SPDX-License-Identifier: MIT
// The wire from GP9 to ground that allows full scale. Without it, as when it falls out, the ceiling is a
// quarter; so it has to lie still for a while before it counts, and is gone at the first look that misses it.
#pragma once
#include "Fixed.h"

namespace physvib::pico {

/// Main loop only. Times are counts of tiles since power-on.
class CeilingJumper {
public:
    static constexpr std::uint32_t stillTiles = tilesPerSecond / 10; // a contact bounces for some 10 ms

    /// True: full scale is allowed.
    bool see(std::uint32_t tiles, bool isTied) noexcept {
        if (!isTied || !wasTied_) tiedAt_ = tiles;
        if (!isTied) isFull_ = false;
        wasTied_ = isTied;
        isFull_ = isFull_ || (isTied && tiles - tiedAt_ >= stillTiles);
        return isFull_;
    }

private:
    std::uint32_t tiedAt_ = 0;
    bool wasTied_ = false, isFull_ = false;
};

} // namespace physvib::pico
