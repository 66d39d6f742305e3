// SPDX-License-Identifier: MIT
// A delay of one channel that can be changed while it plays: the old and the new place of reading are faded over.
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace physvib {

/// At most `Capacity` frames. R only, but for prepare: M.
template <int Capacity>
class ChannelDelay {
public:
    /// Rests at `frames`, with silence in it. M, not while rendering.
    void prepare(int fadeFrames, int frames) noexcept {
        fadeFrames_ = std::max(1, fadeFrames);
        delay_ = before_ = std::clamp(frames, 0, Capacity);
        faded_ = fadeFrames_;
        next_ = none;
        ring_.fill(0.0f);
        silentFrames_ = Capacity;
    }

    void moveTo(int frames) noexcept {
        frames = std::clamp(frames, 0, Capacity);
        if (faded_ < fadeFrames_) { // one fade after the other
            next_ = frames;
            return;
        }
        if (frames == delay_) return;
        before_ = delay_;
        delay_ = frames;
        faded_ = 0;
    }

    /// True if what comes out is what goes in.
    bool isOut() const noexcept { return delay_ == 0 && faded_ == fadeFrames_; }

    /// In place. `isSilent`: all of the input is 0. True if all of the output is.
    bool process(float* io, int frames, bool isSilent) noexcept {
        if (isSilent && silentFrames_ >= Capacity) {
            faded_ = std::min(fadeFrames_, faded_ + frames);
            goOn();
            return true;
        }
        const bool passes = isOut(); // what passes is kept as well: a delay that is set later begins with it
        for (int n = 0; n < frames; ++n) {
            if (passes) keep(io[n]);
            else io[n] = step(io[n]);
        }
        silentFrames_ = isSilent ? std::min(Capacity, silentFrames_ + frames) : 0;
        return passes && isSilent;
    }

private:
    static constexpr int none = -1;
    static constexpr std::size_t size = static_cast<std::size_t>(Capacity) + 1;

    float at(int delay) const noexcept { return ring_[(write_ + size - static_cast<std::size_t>(delay)) % size]; }
    void keep(float x) noexcept {
        write_ = write_ + 1 == size ? 0 : write_ + 1;
        ring_[write_] = x;
    }
    float step(float x) noexcept {
        keep(x);
        if (faded_ == fadeFrames_) return at(delay_);
        const float share = static_cast<float>(++faded_) / static_cast<float>(fadeFrames_);
        const float y = at(before_) + share * (at(delay_) - at(before_));
        goOn();
        return y;
    }
    void goOn() noexcept {
        if (faded_ == fadeFrames_ && next_ != none) moveTo(std::exchange(next_, none));
    }

    std::array<float, size> ring_{};
    std::size_t write_ = 0;
    int delay_ = 0, before_ = 0, faded_ = 1, fadeFrames_ = 1, next_ = none;
    int silentFrames_ = Capacity; // put in last; no more than matters
};

/// No delay where there is no room for one.
template <>
class ChannelDelay<0> {
public:
    void prepare(int, int) noexcept {}
    void moveTo(int) noexcept {}
    bool process(float*, int, bool isSilent) noexcept { return isSilent; }
};

} // namespace physvib
