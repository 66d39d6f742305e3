// SPDX-License-Identifier: MIT
// Player of recorded contacts instead of modes (the thesis' SV rendering, 5.2): the event's amplitude scales
// the recording.
#pragma once
#include "Core/FadingVoices.h"
#include "Core/RecordedContact.h"
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

namespace physvib {

/// Adds recordings to the output of the modes, from their exact frames on. Render thread (R) only; prepare
/// and setContacts: message thread (M).
class SamplePlayer {
public:
    /// Forgets all recordings; silence. M, not while rendering.
    void prepare(int sampleRateHz, int channels) noexcept {
        channels_ = channels;
        contacts_ = {};
        voices_.prepare(sampleRateHz);
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

    /// Adds to io[j][0..frames) for absolute frames [first, first + frames). False if there was nothing to
    /// add.
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
        voices_.forget(first + frames);
        return sounds;
    }

    int voices() const noexcept { return voices_.count(); }

private:
    struct Voice : VoiceTime {
        std::span<const float> samples;
        std::array<float, static_cast<std::size_t>(limits::maxEnchanters)> gains{};
    };

    int channels_ = 0;
    std::span<const RecordedContact> contacts_;
    FadingVoices<Voice, limits::maxSampleVoices> voices_;
};

} // namespace physvib
