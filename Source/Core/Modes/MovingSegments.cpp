// SPDX-License-Identifier: MIT
// Kernel of the board's moving-tone segments. Most of their cost is in `add`; a block takes a hundred
// instructions per segment and frame.
#include "Core/BoardRenderer.h"
#include <algorithm>

namespace physvib {
namespace {

constexpr int blockFrames = PhasorBank::blockFrames;

constexpr std::size_t at(std::int32_t i) noexcept { return static_cast<std::size_t>(i); }

// Frames since a segment's first frame; negative while it is pending.
constexpr std::int32_t ageOf(std::uint32_t first, std::uint32_t now) noexcept {
    return static_cast<std::int32_t>(now - first);
}

// Octaves of decay after `frames` frames, 1 or more; bounded so that the factor stays a normal float.
std::int64_t octavesAfter(std::uint16_t decay16, std::uint32_t frames) noexcept {
    constexpr std::int64_t maxOctaves = 120 * static_cast<std::int64_t>(octaveUnit);
    const std::int64_t perFrame = boardOctaves(decay16);
    return perFrame > maxOctaves / frames ? maxOctaves : perFrame * frames;
}

Complex<float> phasorAfter(const BoardSegment& segment, std::uint32_t frames) noexcept {
    const std::uint64_t phase = (static_cast<std::uint64_t>(segment.phase16) << 48) +
                                (static_cast<std::uint64_t>(segment.turn) << 32) * frames;
    return unitPhasor<float>(phase) *
           (frames > 0 ? decayFactor<float>(octavesAfter(segment.decay16, frames)) : 1.0f);
}

} // namespace

bool MovingSegments::add(const BoardSegment& segment, std::uint32_t now) noexcept {
    const auto missedFrames = std::max<std::int32_t>(0, ageOf(segment.frame, now));
    if (count_ == capacity || missedFrames >= segment.frames) return false;
    const auto turn = unitPhasor<float>(static_cast<std::uint64_t>(segment.turn) << 32) *
                      decayFactor<float>(boardOctaves(segment.decay16));
    slots_[at(count_++)] = {
        segment.frame, segment.frames, phasorAfter(segment, static_cast<std::uint32_t>(missedFrames)),
        turn,          segment.start,  segment.end};
    return true;
}

void MovingSegments::render(std::uint32_t frame, PhasorBank::Block& io) noexcept {
    int count = 0;
    for (int i = 0; i < count_; ++i) {
        const std::int32_t age = ageOf(slots_[at(i)].frame, frame);
        if (age + blockFrames > 0) renderSlot(slots_[at(i)], age, io);
        if (age + blockFrames >= slots_[at(i)].frames) continue;
        if (count != i) slots_[at(count)] = slots_[at(i)];
        ++count;
    }
    count_ = count;
}

void MovingSegments::renderSlot(Slot& slot, std::int32_t age, PhasorBank::Block& io) noexcept {
    constexpr float amplitudeStep = 1.0f / limits::board::amplitudeUnit;
    const float perFrame = slot.frames > 1 ? 1.0f / static_cast<float>(slot.frames - 1) : 0.0f;
    std::array<float, at(limits::board::channels)> start, slope;
    for (std::size_t j = 0; j < start.size(); ++j) {
        start[j] = static_cast<float>(slot.start[j]) * amplitudeStep;
        slope[j] = static_cast<float>(slot.end[j] - slot.start[j]) * amplitudeStep * perFrame;
    }
    const auto end = std::min<std::int32_t>(blockFrames, slot.frames - age);
    for (auto k = std::max<std::int32_t>(0, -age); k < end; ++k, slot.phasor = slot.phasor * slot.turn) {
        const auto ageFrames = static_cast<float>(age + k);
        for (std::size_t j = 0; j < start.size(); ++j)
            io[j][at(k)] += (start[j] + slope[j] * ageFrames) * slot.phasor.im;
    }
}

} // namespace physvib
