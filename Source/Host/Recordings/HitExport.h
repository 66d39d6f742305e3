// SPDX-License-Identifier: GPL-3.0-or-later
// Hits as files for other programs: drawn as the curves of a clip, or as samples. Levels are as struck: no
// gains, no equaliser, no limiter.
#pragma once
#include "Core/PhantomPanner.h"
#include "Formats/ClipFile.h"
#include "Formats/StrikeClip.h"
#include "Scene/LayoutFile.h"
#include <span>
#include <string>
#include <vector>

namespace physvib {

/// Hits, and on whom they are felt.
struct HitExport {
    std::string source;                     ///< of the hits, for messages
    std::string title;                      ///< of the clip
    std::span<const CollisionEvent> events; ///< playable, in time order
    const LayoutDescription& layout;
    std::string layoutName; ///< for messages
    std::string actuator{}; ///< of all enchanters; empty: each has its own
};

/// Each channel with its place and its enchanter's actuator, hits drawn as `drawn` says; or one line. M only.
Result<Clip> clipOfHits(const HitExport& hits, const StrikeClipSettings& drawn);

/// A file of a clip.
struct ClipPart {
    std::string path;
    Clip clip;
};

/// One file, or, of a format with one channel, one for each channel that has something to say: NAME-A.haptic,
/// NAME-B.haptic... Any thread.
std::vector<ClipPart> partsOf(const Clip& clip, const std::string& to, ClipFormat format);

/// All files, or none; `usual` says what phones' frequencies are where a channel's actuator does not. A line
/// per file of how long and large it is, or one line with the reason. M only.
Result<std::string> writeParts(const std::vector<ClipPart>& parts, ClipFormat format,
                               const FrequencyScale& usual = {});

/// What of the parts the format cannot carry, each line once. Any thread.
std::vector<std::string> lossesOf(const std::vector<ClipPart>& parts, ClipFormat format,
                                  const FrequencyScale& usual = {});

/// A channel per enchanter of the panner, from 0 s until all has decayed. Empty, or one line with the reason.
/// M only.
std::string writeHitsWav(const HitExport& hits, const PhantomPanner& panner, int sampleRateHz,
                         const std::string& path, const std::string& comment);

} // namespace physvib
