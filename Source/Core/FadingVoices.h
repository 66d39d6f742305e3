// SPDX-License-Identifier: MIT
// Voice pool: voices that sound between two frames and can be faded out together. Shared by the players of
// recordings and of moving tones.
#pragma once
#include "Core/Limits.h"
#include <algorithm>
#include <array>
#include <cstdint>

namespace physvib {

/// When a voice sounds, in absolute frames.
struct VoiceTime {
    static constexpr std::int64_t never = INT64_MAX / 2;
    std::int64_t onset = 0, end = 0, fadeFrame = never;
};

/// At most `mostSounding` voices at once, of a type derived from VoiceTime. Render thread (R) only; prepare:
/// message thread (M).
template <class Voice, int mostSounding>
class FadingVoices {
public:
    /// Ends all voices. M, not while rendering.
    void prepare(int sampleRateHz) noexcept {
        fadeFrames_ = std::max(1, static_cast<int>(limits::channelRampSeconds * sampleRateHz));
        count_ = 0;
    }

    /// A new voice that begins at `onset`; null if `mostSounding` already sound then.
    Voice* add(std::int64_t onset) noexcept {
        if (count_ == voices_.size() || soundingAt(onset) >= mostSounding) return nullptr;
        voices_[count_] = {};
        voices_[count_].onset = onset;
        return &voices_[count_++];
    }

    /// Fades out all voices from `frame` on, within limits::channelRampSeconds.
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

    /// Removes the voices that have ended by `frame`. The others keep their order, in which their samples are
    /// added.
    void forget(std::int64_t frame) noexcept {
        count_ = static_cast<std::size_t>(
            std::remove_if(begin(), end(), [=](const Voice& v) { return v.end <= frame; }) - begin());
    }

    int count() const noexcept { return static_cast<int>(count_); }
    Voice* begin() noexcept { return voices_.data(); }
    Voice* end() noexcept { return voices_.data() + count_; }

private:
    // Counts by time, not by when ended voices were removed, so that the result does not depend on block
    // sizes.
    int soundingAt(std::int64_t frame) const noexcept {
        return static_cast<int>(std::count_if(voices_.data(), voices_.data() + count_,
                                              [=](const Voice& v) { return v.end > frame; }));
    }

    int fadeFrames_ = 1;
    // twice as many, because voices that end within a tile are removed only after it
    std::array<Voice, static_cast<std::size_t>(2 * mostSounding)> voices_{};
    std::size_t count_ = 0;
};

} // namespace physvib
