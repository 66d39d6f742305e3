// SPDX-License-Identifier: MIT
// Splits a channel's envelope into pieces for an .ahap file, one continuous event each.
//
// On a phone a curve affects every event of its pattern: a curve at 0.1 reduces a transient beside it to a
// tenth. So while a transient sounds, the envelope's level is stored in the events, not in the curves: both
// curves are neutral where it begins.
#pragma once
#include "Formats/ClipEnvelope.h"
#include <optional>
#include <vector>

namespace physvib {

struct AhapPiece {
    std::vector<EnvelopePoint> points;    ///< two or more
    std::optional<EnvelopePoint> level{}; ///< level of the piece's event if a transient sounds beside it;
                                          ///< nullopt: full intensity, no sharpness
};

/// In time order; silences are omitted, except where a transient sounds. `channel.transients` must be in time
/// order. Any thread.
std::vector<AhapPiece> ahapPieces(const ClipChannel& channel);

} // namespace physvib
