// SPDX-License-Identifier: MIT
// A channel's envelope as an .ahap plays it: in pieces, a continuous event each.
//
// On a phone a curve acts on every event of its pattern, so that a curve at 0.1 makes a transient beside it a
// tenth. So while a transient sounds, the envelope's level stands in the events, not in the curves: both
// curves are neutral where it begins.
#pragma once
#include "Formats/ClipEnvelope.h"
#include <optional>
#include <vector>

namespace physvib {

struct AhapPiece {
    std::vector<EnvelopePoint> points;    ///< two or more
    std::optional<EnvelopePoint> level{}; ///< what its event has, for a transient sounds beside it; none:
                                          ///< full intensity, no sharpness
};

/// In time order; silences are left out, except where a transient sounds. `channel.transients` are in time
/// order. Any thread.
std::vector<AhapPiece> ahapPieces(const ClipChannel& channel);

} // namespace physvib
