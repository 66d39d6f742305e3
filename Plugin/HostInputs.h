// SPDX-License-Identifier: GPL-3.0-or-later
// What the host sends beside audio, as R reads it: held notes, its transport, and controls at a limited pace.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>

namespace physvib {

/// What a plug-in format adds to a MIDI note. The defaults add nothing.
struct NoteTouch {
    int id = -1;                        ///< the host's; -1: none
    double semitones = 0.0, gain = 1.0; ///< tuning; 0 to 4
    double pan = 0.0, brightness = 0.0; ///< -1 to 1, of the field; -1/2 to 1/2, as CC 74 less 64
};

/// A MIDI message, or a change of notes that sound.
struct NoteEvent {
    enum class Kind { midi, off, tuning, volume, pan, brightness, pressure };
    Kind kind = Kind::midi;
    int frame = 0;
    std::array<std::uint8_t, 3> midi{};     ///< padded with zeros; of that kind alone
    int id = -1, channel = -1, number = -1; ///< the notes that are meant, from 1 and 0; -1: any
    double value = 0.0;                     ///< as NoteTouch has it; of a note-on, its tuning

    void tell(NoteTouch& touch) const noexcept {
        if (!std::isfinite(value)) return;
        if (kind == Kind::tuning) touch.semitones = std::clamp(value, -120.0, 120.0);
        if (kind == Kind::volume) touch.gain = std::clamp(value, 0.0, 4.0);
        if (kind == Kind::pan) touch.pan = std::clamp(value, -1.0, 1.0);
        if (kind == Kind::brightness) touch.brightness = std::clamp(value, -0.5, 0.5);
    }
    bool isOn() const noexcept { return kind == Kind::midi && (midi[0] & 0xf0) == 0x90 && midi[2] > 0; }
};

/// A block's events as a format hands them over, by frame. R, wait-free; valid until that block is rendered.
class NoteSource {
public:
    virtual bool next(NoteEvent& event) noexcept = 0; ///< false: there are no more

protected:
    ~NoteSource() = default;
};

/// What a held note sounds like at one moment.
struct NoteSound {
    double frequencyHz = 0.0;
    double amplitude = 0.0;
    double x = 0.0, y = 0.0; ///< metres of the field
};

/// A held note is a row of strikes without decay, each a whole number of periods long: where one ends the
/// next begins, both at the zero of a sine. So pitch, level and place follow bend, pressure and slide a few
/// times a hundredth of a second, without a click, and all of it is strikes: in the log, on the board, in the
/// picture. When the key is let go, the last one decays. R only.
class HeldNotes {
public:
    static constexpr std::size_t most = 32;           ///< voices; a further note replaces the oldest
    static constexpr double minStrikeSeconds = 0.004; ///< of whole periods, one at least

    struct Note {
        int channel = 0, number = 0; ///< 1 to 16; 0 to 127
        double velocity = 0.0;       ///< 0 to 1
        std::int64_t onsetFrame = 0; ///< of the session
        NoteTouch touch{};
        double pressure = 0.0, masterPressure = 0.0; ///< 0 to 1, of the finger; what MPE's master adds

        /// True for this note: by its id, if the host gives one, its channel and number; -1: any.
        bool is(int byId, int byChannel, int byNumber) const noexcept {
            return (byId < 0 || touch.id < 0 || byId == touch.id) &&
                   (byChannel < 0 || byChannel == channel) && (byNumber < 0 || byNumber == number);
        }
    };

    void forget() noexcept {
        for (Voice& voice : voices_) voice.isOn = false;
        pedal_.fill(false);
    }

    void start(const Note& note) noexcept {
        const auto rank = [&note](const Voice& voice) { // the same key's, a free one, the oldest
            const bool isSame = voice.note.is(note.touch.id, note.channel, note.number);
            return !voice.isOn ? std::int64_t{-1} : isSame ? std::int64_t{-2} : voice.note.onsetFrame;
        };
        *std::ranges::min_element(voices_, {}, rank) = {note, 0, true, true};
    }

    /// Each note that sounds: its pressure may change.
    template <class Act>
    void each(Act act) noexcept {
        for (Voice& voice : voices_)
            if (voice.isOn) act(voice.note);
    }

    void stop(int id, int channel, int number) noexcept {
        for (Voice& voice : voices_)
            if (voice.note.is(id, channel, number)) voice.isDown = false;
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
        return std::llround(std::max(1.0, std::ceil(minStrikeSeconds * frequencyHz)) * 1e9 / frequencyHz);
    }

    std::array<Voice, most> voices_{};
    std::array<bool, 17> pedal_{}; // per MIDI channel, from 1
};

/// MIDI expression of each channel, from 1: bend (from -1/2 to 1/2), slide, and the zones of
/// MPE 1.1, whose master moves the notes of its members as well. R only.
class ChannelExpression {
public:
    static constexpr double masterSemitones = 2.0; ///< of a whole bend of the master

    void bend(int channel, float by) noexcept { bend_[at(channel)] = by; }
    void slide(int channel, float by) noexcept { slide_[at(channel)] = by; }
    double bendOf(int channel) const noexcept { return double{bend_[at(channel)]}; }
    double masterBendOf(int channel) const noexcept { return double{bend_[at(masterOf(channel))]}; }
    double slideOf(int channel) const noexcept {
        return double{slide_[at(channel)]} + double{slide_[at(masterOf(channel))]};
    }
    /// Of the zone that the channel is a member of; 0: of none.
    int masterOf(int channel) const noexcept {
        if (channel > 1 && channel <= 1 + lower_) return 1;
        return channel < 16 && channel >= 16 - upper_ ? 16 : 0;
    }

    /// Registered parameter 6 of channel 1 or 16: members of its zone; the later one shrinks the other's.
    void controller(int channel, int number, int value) noexcept {
        constexpr int dataEntry = 6, parameterLow = 100, parameterHigh = 101, configuration = 6;
        int& parameter = parameter_[at(channel)];
        if (number == parameterHigh) parameter = value * 128;
        if (number == parameterLow) parameter = parameter / 128 * 128 + value;
        if (number != dataEntry || parameter != configuration || (channel != 1 && channel != 16)) return;
        int &own = channel == 1 ? lower_ : upper_, &other = channel == 1 ? upper_ : lower_;
        own = std::min(value, 15);
        other = std::min(other, std::max(0, 14 - own));
    }

private:
    static std::size_t at(int channel) noexcept { return static_cast<std::size_t>(channel); }
    std::array<float, 17> bend_{}, slide_{}; // places 0 stay 0
    std::array<int, 17> parameter_{};        // the registered one that was chosen
    int lower_ = 0, upper_ = 0;
};

/// Starts, stops and jumps (a stop and a start) of the host's transport since the last block. R only.
class Transport {
public:
    enum class Change { none, started, stopped };

    void reset() noexcept { *this = {}; }

    /// Before each block. A host without a transport (`isPlaying` always empty) plays from its first block
    /// on; one that says nothing for a block goes on as before (LV2 hosts tell changes only); one that does
    /// not tell where it is makes no jumps. A place up to two blocks beside the one expected is no jump, and
    /// what follows is expected from there: tapes run at half and at twice the speed, clocks jitter by a
    /// block, LV2 hosts tell a change of tempo within one. Where every block jumps, a hand is on the
    /// transport: that is one start, and another when it has let go.
    Change follow(std::optional<bool> isPlaying, std::optional<std::int64_t> frame, int frames) noexcept {
        constexpr std::int64_t far = std::int64_t{1} << 61; // sums fit
        if (frame) frame = std::clamp(*frame, -far, far);
        const bool plays = isPlaying.value_or(!isThere_ || wasPlaying_);
        // what was assumed counts until the host tells
        const bool wasPlaying = wasPlaying_ && (isThere_ || !isPlaying);
        isThere_ = isThere_ || isPlaying;
        const bool jumped = plays && wasPlaying && frame && expected_ &&
                            std::abs(*frame - *expected_) >= 2 * std::max(frames, lastFrames_);
        const auto change = plays ? follow(!wasPlaying, jumped) : wasPlaying ? Change::stopped : Change::none;
        if (frame) expected_ = frame;
        if (expected_) *expected_ += plays ? frames : 0;
        lastFrames_ = frames;
        wasPlaying_ = plays;
        return change;
    }

    bool isPlaying() const noexcept { return wasPlaying_; }

private:
    Change follow(bool begins, bool jumped) noexcept {
        const bool starts = begins || (jumped && !justMoved_) || (!jumped && owesStart_);
        owesStart_ = !begins && jumped && justMoved_;
        justMoved_ = begins || jumped;
        return starts ? Change::started : Change::none;
    }

    bool isThere_ = false, wasPlaying_ = false;
    bool justMoved_ = false, owesStart_ = false;
    int lastFrames_ = 0;
    std::optional<std::int64_t> expected_;
};

/// The host's quarter notes, and where a script that follows them is: it begins with the first one of its
/// take, and has two of them a second where the scene's own time is the host's. What a host does not tell
/// goes on as it was; a place that jumps within a take moves the script by half a note at most. R only.
class HostBeats {
public:
    struct Script {
        double seconds = 0.0, rate = 1.0; ///< where it is, and how fast it goes on
    };
    static constexpr double scenePerMinute = 120.0;

    /// Before each block, of that length. A tempo that is none is as one that is not told.
    void follow(std::optional<double> perMinute, std::optional<double> place, double blockSeconds) noexcept {
        place_ = place && std::abs(*place) < 1e9 ? *place : next_;
        if (perMinute && *perMinute >= 1.0 && *perMinute <= 1000.0) perSecond_ = *perMinute / 60.0;
        next_ = place_ + blockSeconds * perSecond_;
    }

    /// A take begins, `seconds` after the block's start.
    void begin(double seconds) noexcept {
        first_ = std::ceil(at(seconds) - nearBeats);
        told_ = {};
        toldAt_ = -1.0;
    }

    /// Calls `tell(const Script&)` if place or rate changed; false: again. Seconds of the block and the take.
    template <class Tell>
    void news(double seconds, double takeSeconds, Tell tell) noexcept {
        if (perSecond_ <= 0.0) return;
        constexpr double scene = scenePerMinute / 60.0;
        const double expected = told_.seconds + (takeSeconds - toldAt_) * told_.rate;
        if (toldAt_ >= 0.0) first_ += std::round(at(seconds) - first_ - expected * scene);
        const Script now{(at(seconds) - first_) / scene, perSecond_ / scene};
        const bool isAsTold = std::abs(now.seconds - expected) * scene < nearBeats &&
                              std::abs(now.rate - told_.rate) < 1e-6 * told_.rate;
        if ((toldAt_ >= 0.0 && isAsTold) || !tell(now)) return;
        told_ = now;
        toldAt_ = takeSeconds;
    }

private:
    static constexpr double nearBeats = 0.01; // hosts round
    double at(double seconds) const noexcept { return place_ + seconds * perSecond_; }

    double perSecond_ = 0.0; // 0: never told
    double place_ = 0.0, next_ = 0.0, first_ = 0.0, toldAt_ = -1.0;
    Script told_;
};

/// Limits one kind of control change, so that automation cannot fill the session's control queue: at most one
/// in so many frames of session time, the value then present. The same whatever block and L are. R only.
class ControlPace {
public:
    static constexpr int perSecond = 1500; // every 32 frames at 48 kHz: gains move in ramps of 10 ms

    /// The minimum number of frames between two changes. Any thread.
    static constexpr int framesAt(int sampleRateHz) noexcept { return std::max(1, sampleRateHz / perSecond); }

    /// The next change may be sent at once. M, or R.
    void reset(int sampleRateHz) noexcept {
        frames_ = framesAt(sampleRateHz);
        next_ = 0;
    }

    /// The first frame from `from` on at which the next may go.
    std::int64_t nextFrom(std::int64_t from) const noexcept { return std::max(from, next_); }
    void wentAt(std::int64_t frame) noexcept { next_ = frame + frames_; }

private:
    int frames_ = 1;
    std::int64_t next_ = 0;
};

} // namespace physvib
