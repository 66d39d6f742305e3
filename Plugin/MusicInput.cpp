// SPDX-License-Identifier: GPL-3.0-or-later
// MusicDelay: a ring buffer in the renderer's frames, and its mix of left and right for each actuator.
#include "MusicInput.h"
#include <algorithm>

namespace physvib {

MusicDelay::MusicDelay(const ActuatorLayout& layout, int channels, int sampleRateHz,
                       std::int64_t maxDelayFrames)
    : sampleRateHz_{sampleRateHz}
    , ring_(static_cast<std::size_t>(maxDelayFrames))
    , rightShare_(static_cast<std::size_t>(channels), 0.5f)
    , samples_(static_cast<std::size_t>(channels * limits::tileFrames)) {
    for (std::size_t j = 0; j < rightShare_.size(); ++j) {
        channels_.push_back(samples_.data() + j * static_cast<std::size_t>(limits::tileFrames));
        if (j < static_cast<std::size_t>(layout.count) && layout.count > 1 && layout.extentWidthMetres > 0.0)
            rightShare_[j] =
                static_cast<float>(std::clamp(layout.places[j].xMetres / layout.extentWidthMetres, 0.0, 1.0));
    }
    reset();
}

void MusicDelay::reset() noexcept {
    endFrame_ = silenceStartFrame_ = silenceEndFrame_ = 0;
    lastPair_ = {};
    playGain_.prepare(sampleRateHz_, limits::channelRampSeconds, 1.0f);
}

void MusicDelay::write(std::int64_t startFrame, const float* left, const float* right, int frames) noexcept {
    for (std::int64_t gap = std::max(endFrame_, startFrame - static_cast<std::int64_t>(ring_.size()));
         gap < startFrame; ++gap)
        pairAt(gap) = {};
    for (int i = 0; i < frames; ++i) pairAt(startFrame + i) = {left[i], right[i]};
    endFrame_ = startFrame + frames;
}

void MusicDelay::silence(std::int64_t from, std::int64_t until) noexcept {
    silenceStartFrame_ = from;
    silenceEndFrame_ = std::max(until, from + static_cast<std::int64_t>(minPauseSeconds * sampleRateHz_));
}

// Fills `tile_`, fading the last samples beyond the music's end. False if all of it is 0.
bool MusicDelay::read(std::int64_t frame, int frames) noexcept {
    bool isAudible = false;
    for (int i = 0; i < frames; ++i) {
        const std::int64_t n = frame + i;
        const bool isWritten = n < endFrame_;
        if (isWritten) lastPair_ = pairAt(n);
        playGain_.moveTo(isWritten && (n < silenceStartFrame_ || n >= silenceEndFrame_) ? 1.0f : 0.0f);
        const float gain = playGain_.next();
        StereoSample& pair = tile_[static_cast<std::size_t>(i)];
        pair = {gain * lastPair_.left, gain * lastPair_.right};
        isAudible = isAudible || pair.left != 0.0f || pair.right != 0.0f;
    }
    return isAudible;
}

const float* const* MusicDelay::samplesFrom(std::int64_t frame, int frames) noexcept {
    if (!read(frame, frames)) return nullptr;
    for (std::size_t j = 0; j < rightShare_.size(); ++j) {
        float* const out = samples_.data() + j * static_cast<std::size_t>(limits::tileFrames);
        const float right = rightShare_[j], left = 1.0f - right;
        std::transform(tile_.begin(), tile_.begin() + frames, out,
                       [=](const StereoSample& pair) { return left * pair.left + right * pair.right; });
    }
    return channels_.data();
}

} // namespace physvib
