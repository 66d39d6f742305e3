// SPDX-License-Identifier: GPL-3.0-or-later
// The delay of music: a ring buffer in the renderer's frames, and distribution over the actuators.
#include "MusicInput.h"
#include <algorithm>

namespace physvib {

MusicDelay::MusicDelay(const EnchanterLayout& layout, int channels, int sampleRateHz,
                       std::int64_t longestFrames)
    : sampleRateHz_{sampleRateHz}
    , ring_(static_cast<std::size_t>(longestFrames))
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
    end_ = silentFrom_ = silentUntil_ = 0;
    last_ = {};
    open_.prepare(sampleRateHz_, limits::channelRampSeconds, 1.0f);
}

void MusicDelay::write(std::int64_t at, const float* left, const float* right, int frames) noexcept {
    for (std::int64_t gap = std::max(end_, at - static_cast<std::int64_t>(ring_.size())); gap < at; ++gap)
        of(gap) = {};
    for (int i = 0; i < frames; ++i) of(at + i) = {left[i], right[i]};
    end_ = at + frames;
}

void MusicDelay::silence(std::int64_t from, std::int64_t until) noexcept {
    silentFrom_ = from;
    silentUntil_ = std::max(until, from + static_cast<std::int64_t>(shortestPauseSeconds * sampleRateHz_));
}

// False: all of it is 0.
bool MusicDelay::read(std::int64_t frame, int frames) noexcept {
    bool sounds = false;
    for (int i = 0; i < frames; ++i) {
        const std::int64_t n = frame + i;
        const bool isThere = n < end_;
        if (isThere) last_ = of(n);
        open_.moveTo(isThere && (n < silentFrom_ || n >= silentUntil_) ? 1.0f : 0.0f);
        const float gain = open_.next();
        Pair& pair = tile_[static_cast<std::size_t>(i)];
        pair = {gain * last_.left, gain * last_.right};
        sounds = sounds || pair.left != 0.0f || pair.right != 0.0f;
    }
    return sounds;
}

const float* const* MusicDelay::at(std::int64_t frame, int frames) noexcept {
    if (!read(frame, frames)) return nullptr;
    for (std::size_t j = 0; j < rightShare_.size(); ++j) {
        float* const out = samples_.data() + j * static_cast<std::size_t>(limits::tileFrames);
        const float right = rightShare_[j], left = 1.0f - right;
        std::transform(tile_.begin(), tile_.begin() + frames, out,
                       [=](const Pair& pair) { return left * pair.left + right * pair.right; });
    }
    return channels_.data();
}

} // namespace physvib
