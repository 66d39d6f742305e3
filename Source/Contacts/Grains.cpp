// SPDX-License-Identifier: MIT
// Chance from numbers.
#include "Contacts/Grains.h"

namespace physvib {

double Grains::chance(std::int64_t index, std::uint64_t which) const noexcept {
    std::uint64_t z = (surface_ * 2 + which) * 0xD1342543DE82EF95U + (static_cast<std::uint64_t>(index) + 1U) * 0x9E3779B97F4A7C15U;
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
    z ^= z >> 31U;
    return static_cast<double>(z >> 11U) * 0x1p-53;
}

Grains::Grain Grains::next(double metres, bool isUp, std::int64_t every) const noexcept {
    const double cell = metres * perMetre_ / static_cast<double>(every);
    auto i = static_cast<std::int64_t>(cell); // towards 0
    if (isUp && cell < static_cast<double>(i)) --i;
    if (!isUp && cell > static_cast<double>(i)) ++i;
    Grain grain = at(i * every); // at most one step before it
    while (isUp ? grain.metres <= metres : grain.metres >= metres) grain = at(grain.index + (isUp ? every : -every));
    return grain;
}

} // namespace physvib
