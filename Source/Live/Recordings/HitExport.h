// SPDX-License-Identifier: MIT
// Exports hits to files of other programs, as curves of a haptic clip or as WAV samples. Levels are those of
// the events, before gains, equaliser and limiter.
#pragma once
#include "Core/PhantomPanner.h"
#include "Formats/ClipFile.h"
#include "Formats/StrikeClip.h"
#include "Scene/LayoutFile.h"
#include <span>
#include <string>
#include <vector>

namespace physvib {

/// The hits to export, and the actuators that play them.
struct HitExport {
    std::string source;                     ///< where the hits come from, for messages
    std::string title;                      ///< of the clip
    std::span<const CollisionEvent> events; ///< playable, in time order
    const LayoutDescription& layout;
    std::string layoutName; ///< for messages
    std::string actuator{}; ///< of all actuators; empty: each has its own
};

/// A clip with a channel per actuator, drawn by `settings`; or the error in one line. M.
Result<Clip> makeHitClip(const HitExport& hits, const EventClipSettings& settings);

/// One file of an exported clip.
struct ClipPart {
    std::string path;
    Clip clip;
};

/// The files of a clip: one; for single-channel formats, one per channel that is not empty: NAME-A.haptic,
/// NAME-B.haptic... Any thread.
std::vector<ClipPart> splitClip(const Clip& clip, const std::string& targetPath, ClipFormat format);

/// Empty, or one line on a part's file that is there already, if that is not `targetPath`: nobody was asked
/// whether it may be replaced. Not on the render thread.
std::string replacedPartError(const std::vector<ClipPart>& parts, const std::string& targetPath);

/// Writes all files or none. `defaultScale`: frequency range that the format's 0 to 1 stands for, where the
/// channel's actuator has no known band. Returns one line per file with its length and size, or one line with
/// the reason. M only.
Result<std::string> writeParts(const std::vector<ClipPart>& parts, ClipFormat format,
                               const FrequencyScale& defaultScale = {});

/// Lines on what the format cannot express, without duplicates. Any thread.
std::vector<std::string> listLosses(const std::vector<ClipPart>& parts, ClipFormat format,
                                    const FrequencyScale& defaultScale = {});

/// Writes one channel per actuator of the panner, from 0 s until all events have decayed. Returns empty, or
/// one line with the reason. M only.
std::string writeHitsWav(const HitExport& hits, const PhantomPanner& panner, int sampleRateHz,
                         const std::string& path, const std::string& comment);

} // namespace physvib
