// SPDX-License-Identifier: MIT
// What the board has to play, in double precision from the closed form, and random lists of events for it.
#pragma once
#include "Core/Actuators/GuardLaw.h"
#include "Core/BoardRenderer.h"
#include "Support/ClosedForm.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

namespace physvib::test {

using BoardFrame = std::array<std::uint8_t, 4>;

/// Which guard the reference has.
struct ReferenceGuard {
    bool isThere = true;
    /// It decides from these codes instead of the reference's own: where it acts for long, one code that is
    /// rounded otherwise moves those after it.
    const std::vector<BoardFrame>* left = nullptr;
    std::uint32_t episodes = 0; ///< comes back: how often it began to act
};

using ReferenceSums = std::vector<std::array<double, 4>>;

/// Limited sums become codes behind the law of the guard, which decides every four frames from what has left.
inline std::vector<BoardFrame> guardedCodes(const ReferenceSums& limited, ReferenceGuard& guard) {
    constexpr std::size_t tile = 4;
    GuardLaw<4> law;
    law.prepare(4, GuardPlace::last);
    law.setTile(static_cast<float>(tile) / limits::board::sampleRateHz);
    std::vector<BoardFrame> codes(limited.size());
    bool acts = false;
    GuardLaw<4>::Row areas{};
    for (std::size_t n = 0; n < limited.size(); ++n) {
        for (std::size_t j = 0; j < 4; ++j) {
            const double way = static_cast<double>(n % tile + 1) / tile;
            const double gain = acts ? law.startGain(j) + (law.endGain(j) - law.startGain(j)) * way : 1.0;
            const double code = std::floor(limited[n][j] * gain * 127.0 + 128.5);
            codes[n][j] = static_cast<std::uint8_t>(std::clamp(code, 1.0, 255.0));
            const double left = guard.left != nullptr ? (*guard.left)[n][j] : codes[n][j];
            areas[j] += static_cast<float>((left - 128.0) / (127.0 * limits::board::sampleRateHz));
        }
        if (n % tile != tile - 1) continue;
        acts = guard.isThere && law.update(areas);
        areas.fill(0.0f);
    }
    guard.episodes = law.episodes();
    return codes;
}

/// The sum of Eq. 5.1 over the events, the linked gain, the guard and the converters' rounding, all in double
/// but for the guard's law.
inline std::vector<BoardFrame> boardClosedForm(const std::vector<BoardEvent>& events, std::size_t frames,
                                               ReferenceGuard& guard) {
    constexpr double rate = limits::board::sampleRateHz, grid = limits::board::gridPerHz;
    ReferenceSums sums(frames);
    for (const BoardEvent& e : events) {
        const std::size_t end =
            e.durationMs > 0 ? std::min<std::size_t>(frames, e.frame + e.durationMs * 8u) : frames;
        for (std::size_t n = e.frame; n < end; ++n) {
            const double t = static_cast<double>(n - e.frame) / rate;
            const double fall = std::exp(-e.decay16 / grid * t);
            if (fall < 1e-7) break;
            const double y = std::sin(2.0 * std::numbers::pi * e.frequency16 / grid * t) * fall /
                             limits::board::amplitudeUnit;
            for (std::size_t j = 0; j < 4; ++j) sums[n][j] += e.amplitudes[j] * y;
        }
    }
    double gain = 1.0;
    for (auto& sum : sums) {
        double peak = 0.0;
        for (const double y : sum) peak = std::max(peak, std::abs(y));
        gain = std::min(1.0, gain + 1.0 / (limits::limiterReleaseSeconds * rate));
        if (peak * gain > 1.0) gain = 1.0 / peak;
        for (double& y : sum) y *= gain;
    }
    return guardedCodes(sums, guard);
}
inline std::vector<BoardFrame> boardClosedForm(const std::vector<BoardEvent>& events, std::size_t frames) {
    ReferenceGuard guard;
    return boardClosedForm(events, frames, guard);
}

/// What a random list is made of.
struct BoardListSettings {
    int events = 100;
    std::uint32_t firstFrame = 400, spanFrames = 16000;
    int materials = 20;      ///< distinct (f, tau)
    double loudest = 0.2;    ///< of full scale
    double gatedShare = 0.0; ///< events with a duration
};

/// Sorted by onset; equal seeds, equal lists.
inline std::vector<BoardEvent> randomBoardEvents(const BoardListSettings& s, std::uint32_t seed) {
    Random random{seed};
    std::vector<BoardEvent> kinds(static_cast<std::size_t>(s.materials));
    for (auto& kind : kinds) {
        kind.frequency16 = static_cast<std::uint16_t>(16 * 30 + random.below(16 * 470));
        kind.decay16 = static_cast<std::uint16_t>(16 * 2 + random.below(16 * 60));
    }
    std::vector<BoardEvent> events(static_cast<std::size_t>(s.events));
    for (auto& e : events) {
        e = kinds[static_cast<std::size_t>(random.below(s.materials))];
        e.frame = s.firstFrame + static_cast<std::uint32_t>(random.below(s.spanFrames));
        if (random.uniform(0, 1) < s.gatedShare)
            e.durationMs = static_cast<std::uint16_t>(1 + random.below(200));
        for (auto& a : e.amplitudes)
            a = static_cast<std::int16_t>(random.uniform(-s.loudest, s.loudest) *
                                          limits::board::amplitudeUnit);
    }
    std::ranges::stable_sort(events, {}, &BoardEvent::frame);
    return events;
}

/// What so many tones that move are made of from `firstFrame` to `endFrame`, each segment joined to the one
/// before; sorted by onset.
inline std::vector<BoardSegment> randomBoardSegments(int tones, std::uint32_t firstFrame,
                                                     std::uint32_t endFrame, int mostFrames,
                                                     std::uint32_t seed) {
    Random random{seed};
    std::vector<BoardSegment> segments;
    for (int tone = 0; tone < tones; ++tone) {
        BoardSegment segment;
        segment.turn = static_cast<std::uint32_t>(random.uniform(40.0, 400.0) / limits::board::sampleRateHz *
                                                  4294967296.0);
        std::uint32_t phase = 0;
        for (segment.frame = firstFrame + static_cast<std::uint32_t>(random.below(200));
             segment.frame < endFrame; segment.frame += segment.frames) {
            segment.frames = static_cast<std::uint16_t>(mostFrames - random.below(mostFrames / 4));
            segment.phase16 = static_cast<std::uint16_t>(phase >> 16);
            segment.decay16 = static_cast<std::uint16_t>(random.below(3) * 50);
            segment.start = segment.end;
            for (auto& a : segment.end)
                a = static_cast<std::int16_t>(random.uniform(-0.2, 0.2) * limits::board::amplitudeUnit);
            segments.push_back(segment);
            phase += segment.turn * segment.frames;
        }
    }
    std::ranges::stable_sort(segments, {}, &BoardSegment::frame);
    return segments;
}

inline std::unique_ptr<BoardRenderer> preparedBoard() {
    auto renderer = std::make_unique<BoardRenderer>();
    renderer->prepare();
    return renderer;
}

/// The board's renderer on this computer: each event is scheduled `lead` frames ahead.
inline std::vector<BoardFrame> renderBoardEvents(BoardRenderer& renderer,
                                                 const std::vector<BoardEvent>& events, std::size_t frames,
                                                 std::uint32_t lead = 64,
                                                 const std::vector<BoardSegment>& segments = {}) {
    std::vector<BoardFrame> codes;
    BoardRenderer::Codes block;
    for (std::size_t next = 0, nextSegment = 0; codes.size() < frames;
         codes.insert(codes.end(), block.begin(), block.end())) {
        while (next < events.size() && events[next].frame < codes.size() + lead)
            renderer.schedule(events[next++]);
        while (nextSegment < segments.size() && segments[nextSegment].frame < codes.size() + lead)
            renderer.schedule(segments[nextSegment++]);
        renderer.render(block);
    }
    codes.resize(frames);
    return codes;
}

/// The largest difference of codes.
inline int worstDifference(const std::vector<BoardFrame>& a, const std::vector<BoardFrame>& b) {
    int worst = a.size() == b.size() ? 0 : 256;
    for (std::size_t n = 0; n < std::min(a.size(), b.size()); ++n)
        for (std::size_t j = 0; j < 4; ++j) worst = std::max(worst, std::abs(a[n][j] - b[n][j]));
    return worst;
}

} // namespace physvib::test
