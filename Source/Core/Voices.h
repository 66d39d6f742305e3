// SPDX-License-Identifier: MIT
// Voices beside the mode bank, which fade out together (FadingVoices): recordings of contacts (SamplePlayer)
// and moving tones (MovingTones).
#pragma once
#include "Core/ClockLaw.h"
#include "Core/CollisionEvent.h"
#include "Core/Limits.h"
#include "Core/RenderControl.h"
#include "Core/Storage.h"
#include "Core/Trigonometry.h"
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>

namespace physvib {
/// When a voice sounds, in absolute frames.
struct VoiceTime {
    static constexpr std::int64_t never = INT64_MAX / 2;
    std::int64_t onset = 0, end = 0, fadeFrame = never;
};

/// At most `maxSounding` voices at once, of a type derived from VoiceTime whose `gains` point to up to
/// `maxGains` values. Render thread (R) only; prepare: message thread (M).
template <class Voice, int maxSounding, int maxGains>
class FadingVoices {
public:
    /// Ends all voices, and gives each one `width` gains. False: no memory. M, not while rendering.
    bool prepare(int sampleRateHz, std::size_t width) noexcept {
        fadeFrames_ = std::max(1, static_cast<int>(limits::channelRampSeconds * sampleRateHz));
        count_ = 0;
        if (!gains_.resize(size * width)) return false;
        for (std::size_t i = 0; i < size; ++i) voices_[i].gains = gains_.data() + i * width;
        return true;
    }

    /// A new voice that begins at `onset`; null if `maxSounding` already sound then.
    Voice* add(std::int64_t onset) noexcept {
        if (count_ == voices_.size() || soundingAt(onset) >= maxSounding) return nullptr;
        Voice& voice = voices_[count_++];
        const auto gains = voice.gains;
        voice = {};
        voice.onset = onset;
        voice.gains = gains;
        return &voice;
    }

    /// Fades out all voices from `frame` on, within limits::channelRampSeconds.
    void fadeAll(std::int64_t frame) noexcept {
        for (Voice& voice : *this) {
            voice.fadeFrame = std::min(voice.fadeFrame, frame);
            voice.end = std::min(voice.end, voice.fadeFrame + fadeFrames_);
        }
    }

    float fadeAt(const Voice& voice, std::int64_t frame) const noexcept {
        return frame < voice.fadeFrame
                   ? 1.0f
                   : 1.0f - static_cast<float>(frame - voice.fadeFrame) / static_cast<float>(fadeFrames_);
    }

    /// Removes the voices that have ended by `frame`. The others keep the order of their sums.
    void removeEnded(std::int64_t frame) noexcept {
        Voice* target = begin();
        for (Voice& voice : *this)
            if (voice.end > frame) std::swap(*target++, voice);
        count_ = static_cast<std::size_t>(target - begin());
    }

    int count() const noexcept { return static_cast<int>(count_); }
    Voice* begin() noexcept { return voices_.data(); }
    Voice* end() noexcept { return voices_.data() + count_; }

private:
    // Counts by time, not by when ended voices were removed, so that block sizes do not matter.
    int soundingAt(std::int64_t frame) const noexcept {
        return static_cast<int>(std::count_if(voices_.data(), voices_.data() + count_,
                                              [=](const Voice& v) { return v.end > frame; }));
    }

    // twice as many, because voices that end within a tile are removed only after it
    static constexpr auto size = static_cast<std::size_t>(2 * maxSounding);
    int fadeFrames_ = 1;
    std::array<Voice, size> voices_{};
    Storage<std::remove_pointer_t<decltype(Voice::gains)>, size * maxGains, true> gains_;
    std::size_t count_ = 0;
};

/// Adds recordings of contacts (the thesis' SV, 5.2), each as strong as its event, to the output of the
/// modes, from their exact frames on. Render thread (R) only; prepare and setContacts: message thread (M).
class SamplePlayer {
public:
    /// Forgets all recordings; silence. False: no memory. M, not while rendering.
    bool prepare(int sampleRateHz, int channels) noexcept {
        channels_ = channels;
        contacts_ = {};
        return voices_.prepare(sampleRateHz, static_cast<std::size_t>(channels));
    }

    /// Recordings of later events; those that sound continue. M, not while rendering, or R.
    void setContacts(std::span<const RecordedContact> contacts) noexcept { contacts_ = contacts; }

    bool isOn() const noexcept { return !contacts_.empty(); }

    /// The recording of that sound or, unless it is a clip, the one of that frequency; null: there is none.
    const RecordedContact* find(SoundNumber sound, double frequencyHz) const noexcept {
        const RecordedContact* byFrequency = nullptr;
        for (const RecordedContact& contact : contacts_) {
            if (sound != 0 && contact.sound == sound) return &contact;
            if (byFrequency == nullptr && contact.sound == 0 && contact.frequencyHz == frequencyHz)
                byFrequency = &contact;
        }
        return isClip(sound) ? nullptr : byFrequency;
    }

    /// Plays it from frame `onset` on, cut at `closeFrame`. False if it has no samples, or if
    /// limits::maxSampleVoices already sound.
    bool strike(const RecordedContact& contact, double amplitude, std::int64_t onset, std::int64_t closeFrame,
                const double* gains) noexcept {
        if (contact.samples.empty()) return false;
        Voice* const voice = voices_.add(onset);
        if (voice == nullptr) return false;
        voice->samples = contact.samples;
        voice->end = std::min(closeFrame, onset + static_cast<std::int64_t>(contact.samples.size()));
        for (std::size_t j = 0; j < static_cast<std::size_t>(channels_); ++j)
            voice->gains[j] = static_cast<float>(amplitude * gains[j]);
        return true;
    }

    void fadeAll(std::int64_t frame) noexcept { voices_.fadeAll(frame); }

    /// Adds to io[j][0..frames) for absolute frames [first, first + frames). False: nothing to add.
    bool render(float* const* io, std::int64_t first, int frames) noexcept {
        bool sounds = false;
        for (const Voice& voice : voices_) {
            const std::int64_t from = std::max(first, voice.onset), to = std::min(first + frames, voice.end);
            for (std::int64_t frame = from; frame < to; ++frame) {
                const float sample = voice.samples[static_cast<std::size_t>(frame - voice.onset)] *
                                     voices_.fadeAt(voice, frame);
                for (std::size_t j = 0; j < static_cast<std::size_t>(channels_); ++j)
                    io[j][frame - first] += voice.gains[j] * sample;
            }
            sounds = sounds || from < to;
        }
        voices_.removeEnded(first + frames);
        return sounds;
    }

    int voices() const noexcept { return voices_.count(); }

private:
    struct Voice : VoiceTime {
        std::span<const float> samples;
        float* gains = nullptr; // one per channel
    };

    int channels_ = 0;
    std::span<const RecordedContact> contacts_;
    FadingVoices<Voice, limits::maxSampleVoices, limits::maxActuators> voices_;
};

/// Player of moving tones: one decaying sinusoid per event, whose channel gains change with its place.
///
/// The place is exact in every frame. Gains are computed at both ends of each tile of the absolute frame grid
/// and interpolated linearly between them. A sample depends on its own frame alone, so block sizes do not
/// matter. Why linear, and the cost: Docs/decisions/0069-what-moves-is-a-row-of-strikes.md. Adds moving tones
/// to the output of the modes. Render thread (R) only; prepare: message thread (M).
class MovingTones {
public:
    /// Ends all tones. False: no memory. M, not while rendering.
    bool prepare(int sampleRateHz, int channels) noexcept {
        rate_ = sampleRateHz;
        channels_ = static_cast<std::size_t>(channels);
        return voices_.prepare(sampleRateHz, 4 * channels_);
    }

    /// Starts a tone at `onset`, which ends at `closeFrame`. False if too many sound at once.
    bool strike(const CollisionEvent& event, FramePosition onset, std::int64_t closeFrame) noexcept;

    void fadeAll(std::int64_t frame) noexcept { voices_.fadeAll(frame); }
    int count() const noexcept { return voices_.count(); }

    /// Adds to io[j][0..frames) for absolute frames [first, first + frames), which lie within one tile.
    /// `driveAt(event, inPhase, quadrature)` writes the gain per output of the part in phase with the tone
    /// and of that a quarter turn ahead; what it leaves is 0. False if there was nothing to add.
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
        voices_.removeEnded(first + frames);
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
        double* gains = nullptr; // per channel: at the first frame in phase, then ahead; likewise at the last
    };

    template <class DriveAt>
    void enterTile(Voice& voice, std::int64_t tile, DriveAt driveAt) noexcept {
        if (voice.last > tile) return;
        voice.first = std::max(tile, voice.onset);
        voice.last = std::min(tile + limits::tileFrames, voice.closeFrame);
        // the gains of the tile before, because the panning law may have changed since
        double *const startGains = voice.gains, *const endGains = startGains + 2 * channels_;
        const auto drive = [&](std::int64_t frame, double* gains) {
            std::fill_n(gains, 2 * channels_, 0.0);
            driveAt(eventAt(voice, frame), gains, gains + channels_);
        };
        if (voice.first == voice.onset)
            drive(voice.first, startGains);
        else
            std::copy_n(endGains, 2 * channels_, startGains);
        drive(voice.last, endGains);
    }

    double ageFrames(const Voice& voice, std::int64_t frame) const noexcept {
        return static_cast<double>(frame - voice.onset) + voice.leadFrames;
    }

    CollisionEvent eventAt(const Voice& voice, std::int64_t frame) const noexcept {
        const auto travelNs = static_cast<double>(voice.event.course.travelNs);
        return movedAlong(voice.event, std::min(1.0, ageFrames(voice, frame) * 1e9 / (travelNs * rate_)));
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
        const auto interpolated = [&](std::size_t i) {
            const double from = voice.gains[i];
            return from + share * (voice.gains[i + 2 * channels_] - from);
        };
        for (std::size_t j = 0; j < channels_; ++j)
            io[j][n] += static_cast<float>(interpolated(j) * tone.im + interpolated(j + channels_) * tone.re);
    }

    double rate_ = 48000.0;
    std::size_t channels_ = 1;
    FadingVoices<Voice, limits::maxMovingTones, 4 * limits::maxActuators> voices_;
};

} // namespace physvib
