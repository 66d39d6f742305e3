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

/// Renders pulses: full scale from the first frame at or after an onset, else 0. A pulse ends early if
/// necessary, so that each onset has its own edge; onsets within minIntervalSeconds of an edge share it.
class OnsetMarks {
public:
    static constexpr double pulseSeconds = 0.002, restSeconds = 0.00025, minIntervalSeconds = 0.0005;

    explicit OnsetMarks(MarkedOnsets which) noexcept
        : markedOnsets_{which} {}

    /// Starts with the sample of `firstFrame`, which may be below 0, and without onsets. Message thread (M),
    /// not while rendering.
    void prepare(int sampleRateHz, std::int64_t firstFrame) noexcept {
        const auto toFrames = [=](double seconds) {
            return static_cast<std::int64_t>(std::ceil(seconds * sampleRateHz));
        };
        pulseFrames_ = toFrames(pulseSeconds);
        restFrames_ = toFrames(restSeconds);
        minIntervalFrames_ = toFrames(minIntervalSeconds);
        nextFrame_ = firstFrame;
        firstEdge_ = endEdge_ = 0;
        lastEdgeFrame_ = offFrame_ = INT64_MIN / 2;
    }

    /// The event is played from `frame` on. That frame must be at least restSeconds after the last rendered
    /// sample, so that an earlier pulse can end. Render thread (R), wait-free.
    void addOnset(const CollisionEvent& event, std::int64_t frame) noexcept {
        if (!isMarked(event)) return;
        if (frame <= lastEdgeFrame_ + minIntervalFrames_) return increment(sharedOnsets_);
        // the ring is full, which blocks of the permitted length never cause
        if (endEdge_ - firstEdge_ == edges_.size()) return increment(sharedOnsets_);
        edges_[endEdge_++ % edges_.size()] = lastEdgeFrame_ = frame;
        increment(pulses_);
    }

    /// R, wait-free.
    void render(float* out, int frames) noexcept {
        for (int n = 0; n < frames; ++n, ++nextFrame_) {
            if (nextFrame_ >= nextEdge()) {
                offFrame_ = nextFrame_ + pulseFrames_;
                ++firstEdge_;
            }
            out[n] = nextFrame_ < std::min(offFrame_, nextEdge() - restFrames_) ? 1.0f : 0.0f;
        }
    }

    /// Number of pulses, and of onsets that shared the pulse of another. Any thread.
    std::uint64_t pulses() const noexcept { return pulses_.load(std::memory_order_relaxed); }
    std::uint64_t sharedOnsets() const noexcept { return sharedOnsets_.load(std::memory_order_relaxed); }

private:
    bool isMarked(const CollisionEvent& event) const noexcept {
        const bool isFromWorld = event.source.fixture >= 0;
        if (event.course.toneAgeNs > 0) return false;
        return markedOnsets_ == MarkedOnsets::all ||
               (markedOnsets_ == MarkedOnsets::hits ? isFromWorld && event.source.kind == ContactKind::hit
                                                    : !isFromWorld);
    }
    std::int64_t nextEdge() const noexcept {
        return firstEdge_ == endEdge_ ? INT64_MAX : edges_[firstEdge_ % edges_.size()];
    }
    static void increment(std::atomic<std::uint64_t>& counter) noexcept {
        counter.store(counter.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
    }

    const MarkedOnsets markedOnsets_;
    std::int64_t pulseFrames_ = 0, restFrames_ = 0, minIntervalFrames_ = 0, nextFrame_ = 0;
    std::array<std::int64_t, 4096> edges_{}; // a block of 8192 frames at 5 kHz has 2048 of them
    std::size_t firstEdge_ = 0, endEdge_ = 0;
    std::int64_t lastEdgeFrame_ = 0, offFrame_ = 0;
    std::atomic<std::uint64_t> pulses_{0}, sharedOnsets_{0};
};

} // namespace physvib
