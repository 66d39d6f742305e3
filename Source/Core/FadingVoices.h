// SPDX-License-Identifier: MIT
// Voices that sound from one frame to another and can all be faded out: what players of recordings and of
// moving tones share.
#pragma once
#include "Core/Limits.h"
#include <algorithm>
#include <array>
#include <cstdint>

namespace physvib {

/// When a voice sounds, on the absolute frame grid.
struct VoiceTime {
    static constexpr std::int64_t never = INT64_MAX / 2;
    std::int64_t onset = 0, end = 0, fadeFrame = never;
};

/// At most `mostSounding` voices at once, of a type derived from VoiceTime. R only, but for prepare: M.
template <class Voice, int mostSounding>
class FadingVoices {
public:
    /// Silence. M, not while rendering.
    void prepare(int sampleRateHz) noexcept {
        fadeFrames_ = std::max(1, static_cast<int>(limits::channelRampSeconds * sampleRateHz));
        count_ = 0;
    }

    /// A place for a voice that begins then; null if too many sound at that time.
    Voice* add(std::int64_t onset) noexcept {
        if (count_ == voices_.size() || soundingAt(onset) >= mostSounding) return nullptr;
        voices_[count_] = {};
        voices_[count_].onset = onset;
        return &voices_[count_++];
    }

    /// Whatever sounds fades out from `frame` on, in limits::channelRampSeconds.
    void fadeAll(std::int64_t frame) noexcept {
        for (Voice& voice : *this) {
            voice.fadeFrame = std::min(voice.fadeFrame, frame);
            voice.end = std::min(voice.end, voice.fadeFrame + fadeFrames_);
        }
    }

    float fadeAt(const Voice& voice, std::int64_t frame) const noexcept {
        return frame < voice.fadeFrame
                   ? 1.0f
                   : 1.0f - static_cast<float>(frame - voice.fadeFrame) / static_cast<float>(fadeFrames_);
    }

    /// Those that have ended by `frame` go; the others keep their order, in which their samples are added.
    void forget(std::int64_t frame) noexcept {
        count_ = static_cast<std::size_t>(
            std::remove_if(begin(), end(), [=](const Voice& v) { return v.end <= frame; }) - begin());
    }

    int count() const noexcept { return static_cast<int>(count_); }
    Voice* begin() noexcept { return voices_.data(); }
    Voice* end() noexcept { return voices_.data() + count_; }

private:
    // Whether there is room depends on the onset alone, not on when what has ended was forgotten: blocks do
    // not matter.
    int soundingAt(std::int64_t frame) const noexcept {
        return static_cast<int>(std::count_if(voices_.data(), voices_.data() + count_,
                                              [=](const Voice& v) { return v.end > frame; }));
    }

    int fadeFrames_ = 1;
    // those that end in this tile wait in it
    std::array<Voice, static_cast<std::size_t>(2 * mostSounding)> voices_{};
    std::size_t count_ = 0;
};

} // namespace physvib
