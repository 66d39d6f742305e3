// SPDX-License-Identifier: MIT
// What a board may be asked to play that would only warm coils, and what of it leaves.
#pragma once
#include "Support/BoardReference.h"
#include "Support/SlowFigures.h"
#include <algorithm>
#include <string>

namespace physvib::test {

struct BoardHazard {
    std::string name;
    std::vector<BoardEvent> events;     ///< sorted by onset
    std::vector<BoardSegment> segments; ///< the same
};

/// Of all four channels.
inline SlowFigures worstSlowFigures(const std::vector<BoardFrame>& codes, std::size_t first = 0) {
    SlowFigures worst;
    std::vector<float> samples;
    for (std::size_t j = 0; j < 4; ++j) {
        samples.clear();
        for (std::size_t n = first; n < codes.size(); ++n)
            samples.push_back(static_cast<float>(codes[n][j] - 128) / 127.0f);
        worst.join(slowFigures(samples, limits::board::sampleRateHz));
    }
    return worst;
}

/// From frame `first` on, for so many seconds.
inline std::vector<BoardHazard> boardHazards(std::uint32_t first, int seconds) {
    using Amplitudes = std::array<std::int16_t, limits::board::channels>;
    constexpr Amplitudes loud{4096, -4096, 2048, 800};
    constexpr auto rate = static_cast<std::uint32_t>(limits::board::sampleRateHz);
    const auto frames = static_cast<std::uint32_t>(seconds) * rate;
    std::vector<BoardHazard> all;
    const auto strikes = [&](std::string name, double hz, double tau, std::uint32_t every, int durationMs,
                             const Amplitudes& amplitudes) {
        BoardHazard h{std::move(name), {}, {}};
        for (std::uint32_t n = 0; n < frames; n += every)
            h.events.push_back({first + n, static_cast<std::uint16_t>(16 * hz),
                                static_cast<std::uint16_t>(16 * tau), static_cast<std::uint16_t>(durationMs),
                                amplitudes});
        all.push_back(std::move(h));
    };
    strikes("1 Hz, decay 1, every 0.25 s", 1, 1, rate / 4, 0, loud);
    strikes("1 Hz, decay 1, every 0.25 s, at a tenth", 1, 1, rate / 4, 0, {410, -410, 0, 205});
    strikes("10 Hz, decay 40, every 25 ms", 10, 40, rate / 40, 0, loud);
    strikes("the first half of 1 Hz, over and over", 1, 0, rate / 2, 500, loud);
    strikes("the first quarter of 0.0625 Hz", 0.0625, 0, 4 * rate, 4000, {32767, 32767, 2048, 800});
    for (const double hz : {0.5, 2.0, 4.9, 8.0, 14.0, 20.0})
        strikes("steady " + std::to_string(hz) + " Hz", hz, 0.0625, 20 * rate, 0, loud);
    BoardHazard constant{"a constant", {}, {}};
    for (std::uint32_t n = 0; n < frames; n += 4000) {
        BoardSegment segment;
        segment.frame = first + n;
        segment.frames = 4000;
        segment.phase16 = 0x4000;
        segment.start = segment.end = loud;
        constant.segments.push_back(segment);
    }
    all.push_back(std::move(constant));
    return all;
}

/// Slow notes and segments of any phase, some too loud.
inline BoardHazard slowBoardList(std::uint32_t seed, int seconds) {
    Random random{seed};
    const int frames = seconds * limits::board::sampleRateHz;
    BoardHazard h{"random", {}, {}};
    const int count = 1 + random.below(60);
    const double loudest = random.uniform(0.1, 2.0);
    for (int i = 0; i < count; ++i) {
        BoardEvent e;
        e.frame = static_cast<std::uint32_t>(random.below(frames));
        e.frequency16 = static_cast<std::uint16_t>(1 + random.logUniform(1, 16 * 40));
        e.decay16 = static_cast<std::uint16_t>(1 + random.below(16 * 20));
        if (random.below(2) == 0) e.durationMs = static_cast<std::uint16_t>(1 + random.below(900));
        for (auto& a : e.amplitudes)
            a = static_cast<std::int16_t>(random.uniform(-loudest, loudest) * limits::board::amplitudeUnit);
        h.events.push_back(e);
    }
    std::ranges::stable_sort(h.events, {}, &BoardEvent::frame);
    BoardSegment segment;
    for (segment.frame = 100; segment.frame < static_cast<std::uint32_t>(frames);
         segment.frame += segment.frames) {
        segment.frames = static_cast<std::uint16_t>(200 + random.below(4000));
        segment.turn = static_cast<std::uint32_t>(random.uniform(0.0, 20.0) / limits::board::sampleRateHz *
                                                  4294967296.0);
        segment.phase16 = static_cast<std::uint16_t>(random.below(65536));
        for (auto* row : {&segment.start, &segment.end})
            for (auto& a : *row)
                a = static_cast<std::int16_t>(random.uniform(-1.0, 1.0) * limits::board::amplitudeUnit);
        h.segments.push_back(segment);
    }
    return h;
}

} // namespace physvib::test
