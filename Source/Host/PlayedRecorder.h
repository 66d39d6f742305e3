// SPDX-License-Identifier: GPL-3.0-or-later
// What a live session plays, to a WAV file: the render role fills a ring, the message thread empties it to disk.
#pragma once
#include "Core/Nonblocking.h"
#include "Host/WavSink.h"
#include <atomic>
#include <cstdint>
#include <juce_core/juce_core.h>
#include <string>
#include <vector>

namespace physvib {

/// Every channel of the session, in its own level (before the output's master gain).
class PlayedRecorder {
public:
    /// Room for `seconds` until drain() is called. M.
    PlayedRecorder(const std::string& path, int channels, int sampleRateHz, double seconds = 4.0);

    int sampleRateHz() const noexcept { return sampleRateHz_; }

    /// R, wait-free. Samples that find no room are lost and counted.
    void take(const float* const* channels, int frames) noexcept PHYSVIB_NONBLOCKING;

    /// Writes what has come. M, often enough.
    void drain();

    /// The last samples, the header, and the file is complete; empty or one line with the reason. M, after R stopped.
    std::string finish();

    std::uint64_t framesLost() const noexcept { return lost_.load(std::memory_order_relaxed); }

private:
    int sampleRateHz_;
    WavSink wav_;
    std::vector<std::vector<float>> ring_;
    juce::AbstractFifo fifo_;
    std::atomic<std::uint64_t> lost_{0};
};

} // namespace physvib
