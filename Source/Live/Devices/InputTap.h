// SPDX-License-Identifier: MIT
// Lock-free queue of audio input with session time, from the render thread to one reader.
#pragma once
#include "Core/EventQueue.h"
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

namespace physvib {

/// Up to 256 samples of the mean of all inputs.
struct HeardPiece {
    std::int64_t sessionNs = 0; ///< of the first sample
    int rateHz = 0;
    int count = 0;
    std::array<float, 256> samples;

    std::span<const float> sound() const noexcept {
        return std::span{samples}.first(static_cast<std::size_t>(count));
    }
};

/// One writer, one reader. The capacity is half a megabyte, 2.7 s at 48 kHz.
class InputTap {
public:
    /// Queues the next samples of each input; the first is at session time `sessionNs`. Pieces that find the
    /// queue full are lost; the time of the next piece shows the gap. R, wait-free.
    void take(const float* const* in, int inputs, int frames, std::int64_t sessionNs,
              int rateHz) noexcept PHYSVIB_NONBLOCKING {
        HeardPiece piece;
        piece.rateHz = rateHz;
        for (int done = 0; done < frames; done += piece.count) {
            piece.sessionNs = sessionNs + std::int64_t{1'000'000'000} * done / rateHz;
            piece.count = std::min(frames - done, static_cast<int>(piece.samples.size()));
            for (int i = 0; i < piece.count; ++i)
                piece.samples[static_cast<std::size_t>(i)] = meanOf(in, inputs, done + i);
            pieces_.push(piece);
        }
    }

    /// False if the queue is empty. The reader, wait-free.
    bool next(HeardPiece& piece) noexcept { return pieces_.pop(piece); }

    std::size_t piecesLost() const noexcept { return pieces_.overflows(); } ///< Any thread.

private:
    static float meanOf(const float* const* in, int inputs, int at) noexcept {
        float sum = 0.0f;
        for (int k = 0; k < inputs; ++k) sum += in[k] != nullptr ? in[k][at] : 0.0f;
        return sum / static_cast<float>(inputs);
    }

    EventQueue<HeardPiece, 512> pieces_;
};

} // namespace physvib
