// SPDX-License-Identifier: MIT
// Sorts numbers of actuators.
#pragma once
#include <cstdint>

namespace physvib {

/// By insertion, the smallest key first: a layout has at most 64 actuators, and a sort of the standard
/// library is a hundredth of the page in a browser. Any thread.
template <class Key>
void sortActuators(std::uint8_t* begin, std::uint8_t* end, const Key& key) noexcept {
    for (std::uint8_t* next = begin; next < end; ++next) {
        const std::uint8_t moved = *next;
        const auto of = key(moved);
        std::uint8_t* at = next;
        for (; at > begin && of < key(*(at - 1)); --at) *at = *(at - 1);
        *at = moved;
    }
}

} // namespace physvib
