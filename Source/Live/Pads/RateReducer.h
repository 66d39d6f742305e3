// SPDX-License-Identifier: MIT
// Reduces the sample rate of two channels to that of a controller's coils, with a windowed sinc of six zeros
// on each side: flat to 0.35 of the lower rate, 40 dB down from 0.62 on. Later by 6.2 of its frames (2 ms at
// 3 kHz).
#pragma once
#include "Live/Pads/PadReports.h"
#include <deque>
#include <vector>

namespace physvib {

/// One thread.
class RateReducer {
public:
    /// From `inHz` to the lower `outHz`, from silence.
    RateReducer(int inHz, int outHz);

    void push(const CoilFrame& frame);
    /// Frames that can be pulled.
    std::size_t size() const noexcept { return ready_.size(); }
    /// The next frame; silence if there is none.
    CoilFrame pull();

private:
    CoilFrame filtered(std::size_t phase) const;

    int in_, out_;                            // both rates, in lowest terms
    std::vector<std::vector<float>> kernels_; // per phase, oldest frame first; each sums to 1
    std::vector<CoilFrame> ring_;             // the newest input frames
    std::size_t oldest_ = 0;                  // of the ring, overwritten next
    int due_ = 0;                             // until the next output frame, in 1/out_ of an input frame
    std::deque<CoilFrame> ready_;
};

} // namespace physvib
