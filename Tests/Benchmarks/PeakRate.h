// SPDX-License-Identifier: GPL-3.0-or-later
// What a core can do at most: single-precision multiply-adds per second with everything in registers.
#pragma once
#include "Core/Modes/InstructionSet.h"

namespace physvib::bench {

/// Does about 2 million multiply-adds per call with this set and returns how many; 0 if it is not available.
/// SSE4 has no fused one: there a product and a sum count as one. scalar: as the compiler's base line has it,
/// one lane at a time.
double multiplyAdds(InstructionSet set);

} // namespace physvib::bench
