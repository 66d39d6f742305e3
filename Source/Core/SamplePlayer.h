// SPDX-License-Identifier: MIT
// Recorded contacts instead of modes: the thesis' SV rendering (5.2), in which the event's amplitude scales the recording.
#pragma once
#include "Core/Limits.h"
#include "Core/RecordedContact.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

namespace physvib {

/// Adds recordings to what the modes made, from their exact frames on. R only, but for prepare and setContacts: M.
template <class Profile>
class SamplePlayer {
public:
    /// No contacts, silence. M, not while rendering.
    void prepare(int sampleRateHz, int channels) noexcept {
        channels_ = channels;
        fadeFrames_ = std::max(1, static_cast<int>(limits::channelRampSeconds * sampleRateHz));
        contacts_ = {};
        voiceCount_ = 0;
    }

    /// Of later strikes; what sounds, sounds on. M, not while rendering, or R.
    void setContacts(std::span<const RecordedContact> contacts) noexcept { contacts_ = contacts; }

    bool isOn() const noexcept { return !contacts_.empty(); }
    bool has(double frequencyHz) const noexcept { return std::ranges::find(contacts_, frequencyHz, &RecordedContact::frequencyHz) != contacts_.end(); }

    /// From frame `onset` on, cut at `closeFrame`. False if there is no such recording, or too many sound at once.
    bool strike(double frequencyHz, double amplitude, std::int64_t onset, std::int64_t closeFrame, const double* gains) noexcept {
        const auto found = std::ranges::find(contacts_, frequencyHz, &RecordedContact::frequencyHz);
        if (found == contacts_.end() || found->samples.empty() || voiceCount_ == voices_.size() || soundingAt(onset) >= mostSounding) return false;
        Voice& voice = voices_[voiceCount_++];
        voice = {found->samples, onset, std::min(closeFrame, onset + static_cast<std::int64_t>(found->samples.size())), never, {}};
        for (std::size_t j = 0; j < static_cast<std::size_t>(channels_); ++j) voice.gains[j] = static_cast<float>(amplitude * gains[j]);
        return true;
    }

    /// Whatever sounds fades out from `frame` on, in limits::channelRampSeconds.
    void fadeAll(std::int64_t frame) noexcept {
        for (std::size_t v = 0; v < voiceCount_; ++v) {
            voices_[v].fadeFrame = std::min(voices_[v].fadeFrame, frame);
            voices_[v].end = std::min(voices_[v].end, voices_[v].fadeFrame + fadeFrames_);
        }
    }

    /// Adds to io[j][0..frames) for absolute frames [first, first + frames). False if there was nothing to add.
    bool render(float* const* io, std::int64_t first, int frames) noexcept {
        bool sounds = false;
        for (std::size_t v = 0; v < voiceCount_; ++v) {
            Voice& voice = voices_[v];
            const std::int64_t from = std::max(first, voice.onset), to = std::min(first + frames, voice.end);
            for (std::int64_t frame = from; frame < to; ++frame) {
                const float sample = voice.samples[static_cast<std::size_t>(frame - voice.onset)] * fadeAt(voice, frame);
                for (std::size_t j = 0; j < static_cast<std::size_t>(channels_); ++j) io[j][frame - first] += voice.gains[j] * sample;
            }
            sounds = sounds || from < to;
        }
        forget(first + frames);
        return sounds;
    }

    int voices() const noexcept { return static_cast<int>(voiceCount_); }

private:
    static constexpr std::int64_t never = INT64_MAX / 2;
    static constexpr int mostSounding = Profile::maxSampleVoices;
    static constexpr auto width = static_cast<std::size_t>(Profile::maxChannels);
    struct Voice {
        std::span<const float> samples;
        std::int64_t onset = 0, end = 0, fadeFrame = never;
        std::array<float, width> gains{};
    };
    float fadeAt(const Voice& voice, std::int64_t frame) const noexcept {
        return frame < voice.fadeFrame ? 1.0f : 1.0f - static_cast<float>(frame - voice.fadeFrame) / static_cast<float>(fadeFrames_);
    }

    // Whether there is room depends on the onset alone, not on when what has ended was forgotten: blocks do not matter.
    int soundingAt(std::int64_t frame) const noexcept {
        return static_cast<int>(std::count_if(voices_.begin(), voices_.begin() + static_cast<std::ptrdiff_t>(voiceCount_), [=](const Voice& v) { return v.end > frame; }));
    }
    // The others keep their order, in which their samples are added.
    void forget(std::int64_t frame) noexcept {
        const auto end = std::remove_if(voices_.begin(), voices_.begin() + static_cast<std::ptrdiff_t>(voiceCount_), [=](const Voice& v) { return v.end <= frame; });
        voiceCount_ = static_cast<std::size_t>(end - voices_.begin());
    }

    int channels_ = 0, fadeFrames_ = 1;
    std::span<const RecordedContact> contacts_;
    std::array<Voice, static_cast<std::size_t>(2 * mostSounding)> voices_{}; // those that end in this tile wait in it
    std::size_t voiceCount_ = 0;
};

} // namespace physvib
