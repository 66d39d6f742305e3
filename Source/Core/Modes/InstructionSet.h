// SPDX-License-Identifier: MIT
// The vector instruction sets that the mode bank can use, chosen at run time so that one binary suits every
// processor.
#pragma once
#include <array>
#include <string_view>

namespace physvib {

/// The vector sets give the same bytes as each other. `scalar` computes in double precision throughout: it is
/// the reference, within a millionth of them.
enum class InstructionSet { best, scalar, sse4, avx2, avx512, neon };

constexpr std::array<std::string_view, 6> instructionSetNames{"best", "scalar", "sse4",
                                                              "avx2", "avx512", "neon"};

constexpr std::string_view nameOf(InstructionSet set) noexcept {
    return instructionSetNames[static_cast<std::size_t>(set)];
}

/// True if this build and this processor can run it; `best` and `scalar` always can. Any thread.
bool isAvailable(InstructionSet set) noexcept;

} // namespace physvib
