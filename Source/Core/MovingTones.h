// SPDX-License-Identifier: MIT
// Player of moving tones: one decaying sinusoid per event, whose channel gains change with its place.
//
// The place is exact in every frame. Gains are computed at both ends of each tile of the absolute frame grid
// and interpolated linearly between them. A sample depends on its own frame alone, so block sizes do not
// matter. Why linear, and the cost: Docs/decisions/0069-what-moves-is-a-row-of-strikes.md.
#pragma once
#include "Core/CollisionEvent.h"
#include "Core/FadingVoices.h"
#include "Core/FrameClock.h"
#include "Core/Trigonometry.h"
#include <algorithm>
#include <array>
#include <cstdint>

namespace physvib {

/// Adds moving tones to the output of the modes. All memory is inside the object. Render thread (R) only;
/// prepare: message thread (M).
class MovingTones {
public:
    /// Gain per output of the part in phase with the tone and of the part a quarter turn ahead.
    struct Drive {
        std::array<double, static_cast<std::size_t>(limits::maxEnchanters)> inPhase{}, ahead{};
    };

    /// Ends all tones. M, not while rendering.
    void prepare(int sampleRateHz, int channels) noexcept {
        rate_ = sampleRateHz;
        channels_ = static_cast<std::size_t>(channels);
        voices_.prepare(sampleRateHz);
    }

    /// From `onset` on, until `closeFrame`. False if too many sound at once.
    bool strike(const CollisionEvent& event, FramePosition onset, std::int64_t closeFrame) noexcept;

    void fadeAll(std::int64_t frame) noexcept { voices_.fadeAll(frame); }
    int count() const noexcept { return voices_.count(); }

    /// Adds to io[j][0..frames) for absolute frames [first, first + frames), which lie within one tile.
    /// `driveAt(event, x, y)` returns the Drive of an event at that place. False if there was nothing to add.
    template <class DriveAt>
    bool render(float* const* io, std::int64_t first, int frames, DriveAt driveAt) noexcept {
        bool sounds = false;
        for (Voice& voice : voices_) {
            const std::int64_t from = std::max(first, voice.onset), to = std::min(first + frames, voice.end);
            if (from >= to) continue;
            enterTile(voice, first - first % limits::tileFrames, driveAt);
            for (std::int64_t frame = from; frame < to; ++frame) add(voice, frame, io, frame - first);
            sounds = true;
        }
        voices_.forget(first + frames);
        return sounds;
    }

private:
    struct Voice : VoiceTime {
        CollisionEvent event;
        double leadFrames = 0.0; // time from the onset to its first frame, in frames
        std::uint64_t phase = 0, phaseIncrement = 0;
        std::int64_t decayIncrement = 0, closeFrame = 0; // end without a fade-out
        double level = 0;
        std::int64_t first = 0, last = 0; // the gains are interpolated between these frames
        Drive from, to;
    };

    template <class DriveAt>
    void enterTile(Voice& voice, std::int64_t tile, DriveAt driveAt) noexcept {
        if (voice.last > tile) return;
        voice.first = std::max(tile, voice.onset);
        voice.last = std::min(tile + limits::tileFrames, voice.closeFrame);
        // the gains of the tile before, because the panning law may have changed since
        voice.from = voice.first == voice.onset ? at(voice, voice.first, driveAt) : voice.to;
        voice.to = at(voice, voice.last, driveAt);
    }

    double ageFrames(const Voice& voice, std::int64_t frame) const noexcept {
        return static_cast<double>(frame - voice.onset) + voice.leadFrames;
    }

    template <class DriveAt>
    Drive at(const Voice& voice, std::int64_t frame, DriveAt driveAt) const noexcept {
        const CollisionEvent& e = voice.event;
        const double share =
            std::min(1.0, ageFrames(voice, frame) * 1e9 / (static_cast<double>(e.course.travelNs) * rate_));
        return driveAt(movedAlong(e, share));
    }

    void add(const Voice& voice, std::int64_t frame, float* const* io, std::int64_t n) const noexcept {
        const auto lead = [&](auto increment) {
            return static_cast<decltype(increment)>(static_cast<double>(increment) * voice.leadFrames);
        };
        const std::int64_t k = frame - voice.onset;
        const auto tone = unitPhasor<double>(voice.phase + lead(voice.phaseIncrement) +
                                             voice.phaseIncrement * static_cast<std::uint64_t>(k)) *
                          (decayFactor<double>(voice.decayIncrement * k + lead(voice.decayIncrement)) *
                           voice.level * static_cast<double>(voices_.fadeAt(voice, frame)));
        const auto share =
            static_cast<double>(frame - voice.first) / static_cast<double>(voice.last - voice.first);
        const auto between = [share](double from, double to) {
            return static_cast<double>(from) + share * static_cast<double>(to - from);
        };
        for (std::size_t j = 0; j < channels_; ++j)
            io[j][n] += static_cast<float>(between(voice.from.inPhase[j], voice.to.inPhase[j]) * tone.im +
                                           between(voice.from.ahead[j], voice.to.ahead[j]) * tone.re);
    }

    double rate_ = 48000.0;
    std::size_t channels_ = 1;
    FadingVoices<Voice, limits::maxMovingTones> voices_;
};

} // namespace physvib
