// SPDX-License-Identifier: GPL-3.0-or-later
// Default assignment of beat bands to actuators, and its parser.
#include "Host/Music/BeatStrikes.h"
#include <algorithm>

namespace physvib {

std::array<EnchanterSet, beatBands.size()> usualBeatEnchanters(int count) noexcept {
    const auto last = static_cast<std::size_t>(count - 1);
    std::array<EnchanterSet, beatBands.size()> sets{};
    sets.front()[0] = sets.back()[last] = true;
    for (std::size_t j = std::min<std::size_t>(1, last); j < std::max<std::size_t>(last, 1); ++j)
        sets[1][j] = true;
    if (count == 2) sets[1] = sets.back();
    return sets;
}

bool parseEnchanters(std::string_view letters, int count, EnchanterSet& enchanters) {
    enchanters.reset();
    for (const char letter : letters) {
        const int j = letter - 'A';
        if (j < 0 || j >= count || enchanters[static_cast<std::size_t>(j)]) return false;
        enchanters[static_cast<std::size_t>(j)] = true;
    }
    return true;
}

} // namespace physvib
