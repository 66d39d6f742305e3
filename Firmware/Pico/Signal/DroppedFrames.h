// SPDX-License-Identifier: MIT
// What follows missing frames joins what was before: from the last frame that was sent to the stream that
// goes on, within a millisecond. A step would be a click. Each sample lies between those two, so nothing
// becomes stronger than what the host sent.
#pragma once
#include "Fixed.h"

namespace physvib::pico {

/// Interrupt of the output only.
template <int channels>
class DroppedFrames {
public:
    static constexpr std::int32_t fadeFrames = 4 * tileFrames; // 1.3 ms; a power of two, for a chip that
                                                               // divides slowly

    /// Frames are missing behind the last one that joined.
    void miss() noexcept {
        held_ = last_;
        left_ = fadeFrames;
    }
    /// Nothing is to be joined: the output is silent.
    void forget() noexcept { left_ = 0; }

    bool isJoining() const noexcept { return left_ > 0; }
    /// In the place of join() while nothing is to be joined.
    void keep(const Frame<channels>& frame) noexcept { last_ = frame; }
    void join(Frame<channels>& frame) noexcept {
        if (left_ > 0) {
            for (std::size_t j = 0; j < frame.size(); ++j) {
                const std::int32_t y = held_[j] * left_ + frame[j] * (fadeFrames - left_);
                frame[j] = static_cast<std::int16_t>(y / fadeFrames);
            }
            --left_;
        }
        last_ = frame;
    }
    const Frame<channels>& last() const noexcept { return last_; } ///< the last one that joined

private:
    Frame<channels> held_{}, last_{};
    std::int32_t left_ = 0;
};

} // namespace physvib::pico
