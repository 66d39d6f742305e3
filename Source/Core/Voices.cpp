// SPDX-License-Identifier: MIT
// Starts a moving tone: computes its phase, decay and end as integers.
#include "Core/Voices.h"
#include "Core/Modes/ModeIncrements.h"
#include <algorithm>

namespace physvib {
bool MovingTones::strike(const CollisionEvent& event, FramePosition onset, std::int64_t closeFrame) noexcept {
    Voice* const voice = voices_.add(onset.frame);
    if (voice == nullptr) return false;
    voice->event = event;
    voice->leadFrames = onset.leadFrames;
    voice->phaseIncrement = phaseIncrementOf(event.frequencyHz, rate_);
    voice->decayIncrement = decayIncrementOf(event.decayPerSecond, rate_);
    voice->phase = phaseAfter(event.frequencyHz * static_cast<double>(event.course.toneAgeNs) * 1e-9);
    voice->level =
        static_cast<double>(event.amplitude * shareLeft(event.decayPerSecond,
                                                        static_cast<double>(event.course.toneAgeNs) * 1e-9));
    const std::int64_t life = lifeFramesOf(voice->decayIncrement);
    voice->end = voice->closeFrame =
        std::min({closeFrame, VoiceTime::never, life < VoiceTime::never ? onset.frame + life : life});
    return true;
}

} // namespace physvib
