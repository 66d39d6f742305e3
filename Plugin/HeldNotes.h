// SPDX-License-Identifier: GPL-3.0-or-later
// Notes that sound until their key is released.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace physvib {

/// What a held note sounds like at one moment.
struct NoteSound {
    double frequencyHz = 0.0;
    double amplitude = 0.0;
    double x = 0.0, y = 0.0; ///< metres of the field
};

/// A held note is a row of strikes without decay, each a whole number of periods long: where one ends the
/// next begins, both at the zero of a sine. So pitch, level and place follow bend, pressure and slide a few
/// times a hundredth of a second, without a click, and all of it is strikes: in the log, on the board, in the
/// picture. When the key is let go, the last one decays. R only; nothing here allocates.
class HeldNotes {
public:
    static constexpr std::size_t most = 32;             ///< a further one takes the place of the oldest
    static constexpr double leastStrikeSeconds = 0.004; ///< of whole periods, one at least

    struct Note {
        int channel = 0, number = 0; ///< 1 to 16; 0 to 127
        double velocity = 0.0;       ///< 0 to 1
        std::int64_t onsetFrame = 0; ///< of the session
    };

    void forget() noexcept {
        for (Voice& voice : voices_) voice.isOn = false;
        pedal_.fill(false);
    }

    void start(const Note& note) noexcept {
        Voice* place = &voices_.front();
        for (Voice& voice : voices_) {
            const bool isSame =
                voice.isOn && voice.note.channel == note.channel && voice.note.number == note.number;
            if (isSame || !voice.isOn) {
                place = &voice;
                break;
            }
            if (voice.note.onsetFrame < place->note.onsetFrame) place = &voice;
        }
        *place = {note, 0, true, true};
    }

    void stop(int channel, int number) noexcept {
        for (Voice& voice : voices_)
            if (voice.note.channel == channel && voice.note.number == number) voice.isDown = false;
    }
    void stopAll() noexcept {
        for (Voice& voice : voices_) voice.isDown = false;
        pedal_.fill(false);
    }

    /// While it is down, notes of that channel sound on. MPE's master, channel 1, holds all.
    void pedal(int channel, bool isDown) noexcept { pedal_[static_cast<std::size_t>(channel)] = isDown; }

    /// What begins before that frame of the session. `soundOf(const Note&)` gives a NoteSound; `strike(const
    /// Note&, const NoteSound&, afterNs, durationNs)` is called for each part, so long after the note's
    /// onset; the duration of the last part is 0: it decays.
    template <class SoundOf, class Strike>
    void advance(std::int64_t endFrame, int sampleRateHz, SoundOf soundOf, Strike strike) noexcept {
        for (Voice& voice : voices_)
            while (voice.isOn &&
                   voice.note.onsetFrame + voice.playedNs * sampleRateHz / 1'000'000'000 < endFrame) {
                const NoteSound sound = soundOf(voice.note);
                voice.isOn = isHeld(voice) && sound.frequencyHz > 0.0;
                const std::int64_t lengthNs = voice.isOn ? lengthOf(sound.frequencyHz) : 0;
                if (sound.frequencyHz > 0.0) strike(voice.note, sound, voice.playedNs, lengthNs);
                voice.playedNs += lengthNs;
            }
    }

private:
    struct Voice {
        Note note{};
        std::int64_t playedNs = 0;
        bool isDown = false, isOn = false;
    };
    bool isHeld(const Voice& voice) const noexcept {
        return voice.isDown || pedal_[static_cast<std::size_t>(voice.note.channel)] || pedal_[1];
    }
    static std::int64_t lengthOf(double frequencyHz) noexcept {
        return std::llround(std::max(1.0, std::ceil(leastStrikeSeconds * frequencyHz)) * 1e9 / frequencyHz);
    }

    std::array<Voice, most> voices_{};
    std::array<bool, 17> pedal_{}; // per MIDI channel, from 1
};

} // namespace physvib
