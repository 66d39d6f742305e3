// SPDX-License-Identifier: MIT
// Trigger output: a channel with a pulse at the sample of each onset, for equipment that records event times.
#pragma once
#include "Core/CollisionEvent.h"
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <string_view>

namespace physvib {

/// The events that are marked.
enum class MarkedOnsets {
    all,     ///< every onset; not the later segments of a path, which continue a tone
    hits,    ///< impacts of two bodies: neither grains nor events that no world produced
    messages ///< events that no world produced
};
inline constexpr std::array<std::string_view, 3> markedOnsetsNames{"all", "hits", "messages"};
constexpr std::string_view nameOf(MarkedOnsets which) noexcept {
    return markedOnsetsNames[static_cast<std::size_t>(which)];
}

/// Full scale from the first frame at or after the onset, else 0. A pulse ends early if necessary, so that
/// each onset has its own rising edge. Only onsets within leastApartSeconds after an edge share its pulse.
class OnsetMarks {
public:
    static constexpr double pulseSeconds = 0.002, restSeconds = 0.00025, leastApartSeconds = 0.0005;

    explicit OnsetMarks(MarkedOnsets which) noexcept
        : which_{which} {}

    /// Starts with the sample of `firstFrame`, which may be below 0, and without onsets. Message thread (M),
    /// not while rendering.
    void prepare(int sampleRateHz, std::int64_t firstFrame) noexcept {
        const auto framesOf = [=](double seconds) {
            return static_cast<std::int64_t>(std::ceil(seconds * sampleRateHz));
        };
        pulse_ = framesOf(pulseSeconds);
        rest_ = framesOf(restSeconds);
        apart_ = framesOf(leastApartSeconds);
        position_ = firstFrame;
        first_ = last_ = 0;
        lastEdge_ = offFrame_ = INT64_MIN / 2;
    }

    /// The event is played from `frame` on. That frame must be at least restSeconds after the last rendered
    /// sample, so that an earlier pulse can end. Render thread (R), wait-free.
    void strike(const CollisionEvent& event, std::int64_t frame) noexcept {
        if (!isMarked(event)) return;
        if (frame <= lastEdge_ + apart_) return count(shared_);
        // cannot happen with blocks of the permitted length
        if (last_ - first_ == edges_.size()) return count(shared_);
        edges_[last_++ % edges_.size()] = lastEdge_ = frame;
        count(made_);
    }

    /// R, wait-free.
    void render(float* out, int frames) noexcept {
        for (int n = 0; n < frames; ++n, ++position_) {
            if (position_ >= nextEdge()) {
                offFrame_ = position_ + pulse_;
                ++first_;
            }
            out[n] = position_ < std::min(offFrame_, nextEdge() - rest_) ? 1.0f : 0.0f;
        }
    }

    /// Number of pulses, and of onsets that shared the pulse of another. Any thread.
    std::uint64_t made() const noexcept { return made_.load(std::memory_order_relaxed); }
    std::uint64_t shared() const noexcept { return shared_.load(std::memory_order_relaxed); }

private:
    bool isMarked(const CollisionEvent& event) const noexcept {
        const bool isOfWorld = event.source.fixture >= 0;
        if (event.course.sinceNs > 0) return false;
        return which_ == MarkedOnsets::all ||
               (which_ == MarkedOnsets::hits ? isOfWorld && event.source.kind == ContactKind::hit
                                             : !isOfWorld);
    }
    std::int64_t nextEdge() const noexcept {
        return first_ == last_ ? INT64_MAX : edges_[first_ % edges_.size()];
    }
    static void count(std::atomic<std::uint64_t>& counter) noexcept {
        counter.store(counter.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
    }

    const MarkedOnsets which_;
    std::int64_t pulse_ = 0, rest_ = 0, apart_ = 0, position_ = 0;
    std::array<std::int64_t, 4096> edges_{}; // a block of 8192 frames at 5 kHz has 2048 of them
    std::size_t first_ = 0, last_ = 0;
    std::int64_t lastEdge_ = 0, offFrame_ = 0;
    std::atomic<std::uint64_t> made_{0}, shared_{0};
};

} // namespace physvib
