// SPDX-License-Identifier: MIT
// What every reader of a haptic file of others is asked.
#pragma once
#include "Formats/ClipFile.h"
#include "Formats/StrikeClip.h"
#include "Fuzzing.h"

namespace physvib::fuzz {

/// Refused in one line, or a clip without a fault that every format can write and its own reader reads again,
/// and whose samples are numbers.
inline void tryClip(std::string_view bytes, ClipFormat format) {
    const auto read = [=](std::string_view text) { return readClip(text, "f", format); };
    const auto clip = read(bytes);
    if (!clip) return demandClearRefusal(clip, clip.value == Clip{});
    demand(clipError(clip.value).empty(), "a clip with a fault", clipError(clip.value));
    for (const ClipFormat other : {ClipFormat::hjif, ClipFormat::haptic, ClipFormat::ahap}) {
        const auto again = readClip(clipBytes(clip.value, other), "f", other);
        // of one channel of several, or longer by a rise
        const bool isNothing = again.error.find("silence") != std::string::npos ||
                               again.error.find("at most") != std::string::npos;
        demand(static_cast<bool>(again) || isNothing, "cannot read what was written", again.error);
    }
    constexpr double briefly = 1.0;
    if (clip.value.seconds() > briefly) return;
    for (const auto& channel : clipSound(clip.value, 8000).channels)
        for (const float sample : channel) demand(sample == sample, "a sample that is no number");
}

} // namespace physvib::fuzz
