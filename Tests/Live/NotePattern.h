// SPDX-License-Identifier: GPL-3.0-or-later
// The notes that hosts from outside are given, and that a bounce is given for comparison.
#pragma once
#include <cstdint>

namespace physvib::test {

struct PatternNote {
    std::int64_t frame; ///< of the transport
    std::uint8_t note, velocity;
};

/// Note k of the pattern, in the order of time: ten or so a second, anywhere in a block, all over the field.
constexpr PatternNote patternNote(int k) noexcept {
    return {1000 + 4801LL * k, static_cast<std::uint8_t>(36 + k * 5 % 24),
            static_cast<std::uint8_t>(127 - k * 37 % 100)};
}

} // namespace physvib::test
