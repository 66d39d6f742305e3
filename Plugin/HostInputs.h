// SPDX-License-Identifier: GPL-3.0-or-later
// What the host sends beside audio, for its audio thread (R): note events and their expression, held notes,
// MPE channels, the transport, tempo and beats, and a limit to the pace of controls.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>

namespace physvib {

/// Expression of one note, which plug-in formats have beside MIDI. The defaults change nothing.
struct NoteExpression {
    int id = -1;                        ///< the host's id of the note; -1: none
    double semitones = 0.0, gain = 1.0; ///< tuning, -120 to 120; 0 to 4
    double pan = 0.0, brightness = 0.0; ///< -1 to 1; -1/2 to 1/2, as (CC 74 - 64) / 128
};

/// A MIDI message, or a change of sounding notes.
struct NoteEvent {
    enum class Kind { midi, off, tuning, volume, pan, brightness, pressure };
    Kind kind = Kind::midi;
    int frame = 0;
    std::array<std::uint8_t, 3> midi{};     ///< the message, padded with zeros, if `kind` is midi
    int id = -1, channel = -1, number = -1; ///< the notes to change; channels from 1; -1: any
    double value = 0.0;                     ///< in the unit of NoteExpression; of a note-on, its tuning

    void applyTo(NoteExpression& expression) const noexcept {
        if (!std::isfinite(value)) return;
        if (kind == Kind::tuning) expression.semitones = std::clamp(value, -120.0, 120.0);
        if (kind == Kind::volume) expression.gain = std::clamp(value, 0.0, 4.0);
        if (kind == Kind::pan) expression.pan = std::clamp(value, -1.0, 1.0);
        if (kind == Kind::brightness) expression.brightness = std::clamp(value, -0.5, 0.5);
    }
    bool isOn() const noexcept { return kind == Kind::midi && (midi[0] & 0xf0) == 0x90 && midi[2] > 0; }
};

/// A block's note events in the order of frames, valid until it is rendered. R, wait-free.
class NoteSource {
public:
    virtual bool next(NoteEvent& event) noexcept = 0; ///< reads the next event; false if there is none

protected:
    ~NoteSource() = default;
};

/// Notes that sound until their keys are released. Each is a sequence of strikes without decay, each a whole
/// number of periods long, so that one ends where the next begins, both at the zero of a sine. So pitch,
/// level and place can follow bend, pressure and slide every few milliseconds without a click, and log, board
/// and picture need to know nothing but strikes. When the key is released, a last strike decays. R only.
class HeldNotes {
public:
    static constexpr std::size_t maxNotes = 32;       ///< a further note replaces the oldest
    static constexpr double minStrikeSeconds = 0.004; ///< rounded up to whole periods

    struct Note {
        int channel = 0, master = 0, number = 0; ///< 1 to 16; 1 or 16, in no zone 1; 0 to 127
        double velocity = 0.0;                   ///< 0 to 1
        std::int64_t onsetFrame = 0;             ///< in session time
        NoteExpression expression{};
        double pressure = 0.0, masterPressure = 0.0; ///< 0 to 1; of the note, and of MPE's master channel
        bool isDown = true;                          ///< its key
        bool isEnded = false;                        ///< whatever key and pedal do
        bool isOn = false;                           ///< it sounds
        std::int64_t playedNs = 0;                   ///< length of its strikes so far

        /// True if id (where both have one), channel and number are those of this note; -1: any.
        bool matches(int noteId, int noteChannel, int noteNumber) const noexcept {
            return (noteId < 0 || expression.id < 0 || noteId == expression.id) &&
                   (noteChannel < 0 || noteChannel == channel) && (noteNumber < 0 || noteNumber == number);
        }
    };

    /// Silences all notes, and lifts the pedals: a song that stops while one is down would hold what is
    /// played next without an end.
    void clear() noexcept {
        for (Note& note : notes_) note.isOn = false;
        pedal_.fill(false);
    }

    void start(const Note& note) noexcept {
        const auto rank = [&note](const Note& held) { // first the same key's, then a free one, the oldest
            const bool isSame = held.matches(note.expression.id, note.channel, note.number);
            return !held.isOn ? std::int64_t{-1} : isSame ? std::int64_t{-2} : held.onsetFrame;
        };
        Note& place = *std::ranges::min_element(notes_, {}, rank);
        place = note;
        place.isOn = true;
    }

    /// Calls `visit(Note&)` for each sounding note; it may release it, and change its expression and
    /// pressure.
    template <class Visit>
    void forEachNote(Visit visit) noexcept {
        for (Note& note : notes_)
            if (note.isOn) visit(note);
    }

    /// While the pedal is down, it sustains the notes of its channel, and those whose master it is of.
    void setPedal(int channel, bool isDown) noexcept { pedal_[static_cast<std::size_t>(channel)] = isDown; }

    /// Makes the strikes that begin before `endFrame` of the session. `soundOf(const Note&)` returns a
    /// CollisionEvent. `strike(const Note&, sound, afterNs, durationNs)` is called for each strike; `afterNs`
    /// counts from the note's onset; a duration of 0 is the last strike, which decays.
    template <class SoundOf, class Strike>
    void advance(std::int64_t endFrame, int sampleRateHz, SoundOf soundOf, Strike strike) noexcept {
        for (Note& note : notes_)
            while (note.isOn && note.onsetFrame + note.playedNs * sampleRateHz / 1'000'000'000 < endFrame) {
                const auto sound = soundOf(note);
                note.isOn = isHeld(note) && sound.frequencyHz > 0.0;
                const std::int64_t lengthNs = note.isOn ? strikeNs(sound.frequencyHz) : 0;
                if (sound.frequencyHz > 0.0) strike(note, sound, note.playedNs, lengthNs);
                note.playedNs += lengthNs;
            }
    }

private:
    bool isHeld(const Note& note) const noexcept {
        const auto isPressed = [this](int channel) { return pedal_[static_cast<std::size_t>(channel)]; };
        return !note.isEnded && (note.isDown || isPressed(note.channel) || isPressed(note.master));
    }
    static std::int64_t strikeNs(double frequencyHz) noexcept {
        return std::llround(std::max(1.0, std::ceil(minStrikeSeconds * frequencyHz)) * 1e9 / frequencyHz);
    }

    std::array<Note, maxNotes> notes_{};
    std::array<bool, 17> pedal_{}; // per MIDI channel, from 1
};

/// Expression of MIDI channels (from 1): bend and slide, each -1/2 to 1/2, and the zones of MPE 1.1, whose
/// master channel changes the notes of its members as well. R only.
class ChannelExpression {
public:
    static constexpr double masterSemitones = 2.0; ///< of a full bend of a master channel

    ChannelExpression() noexcept { selectedParameter_.fill(noParameter); }

    void setBend(int channel, float bend) noexcept { bend_[index(channel)] = bend; }
    void setSlide(int channel, float slide) noexcept { slide_[index(channel)] = slide; }
    /// As a reset of all controllers does; zones stay.
    void reset(int channel) noexcept {
        bend_[index(channel)] = slide_[index(channel)] = 0.0f;
        selectedParameter_[index(channel)] = noParameter;
    }
    double bend(int channel) const noexcept { return withMaster(bend_, channel); }
    double slide(int channel) const noexcept { return withMaster(slide_, channel); }
    /// Semitones by which bends move a note of the channel; `full`: by a full bend, if none was told.
    double bendSemitones(int channel, double full) const noexcept {
        const auto bent = [this](int of, double untold) {
            return 2.0 * double{bend_[index(of)]} * bendRange_[rangeIndex(of)].value_or(untold);
        };
        return bent(channel, full) + bent(findMaster(channel), masterSemitones);
    }
    /// The master channel (1 or 16) of the zone to which the channel belongs; 0: it belongs to none.
    int findMaster(int channel) const noexcept {
        if (channel > 1 && channel <= 1 + lowerMembers_) return 1;
        return channel < 16 && channel >= 16 - upperMembers_ ? 16 : 0;
    }

    /// Registered parameter 6 of channel 1 or 16 sets the members of its zone, and shrinks the other zone;
    /// parameter 0 sets semitones and cents of a full bend, of a channel or of all members of a zone, unless
    /// the channel is only said to be the first (`isKnown`: false).
    void handleController(int channel, int number, int value, bool isKnown = true) noexcept {
        constexpr int dataEntry = 6, dataEntryLow = 38, otherLow = 98, otherHigh = 99, parameterLow = 100,
                      parameterHigh = 101, bendRange = 0, zoneConfiguration = 6;
        int& parameter = selectedParameter_[index(channel)];
        if (number == parameterHigh) parameter = value * 128 + parameter % 128; // either may come first
        if (number == parameterLow) parameter = parameter / 128 * 128 + value;
        if (number == otherLow || number == otherHigh) parameter = noParameter;
        if (auto& semitones = bendRange_[rangeIndex(channel)]; isKnown && parameter == bendRange) {
            if (number == dataEntry) semitones = value;
            if (number == dataEntryLow && semitones) semitones = std::floor(*semitones) + 0.01 * value;
        }
        if (number != dataEntry || parameter != zoneConfiguration || (channel != 1 && channel != 16)) return;
        int &zone = channel == 1 ? lowerMembers_ : upperMembers_,
            &otherZone = channel == 1 ? upperMembers_ : lowerMembers_;
        bendRange_[index(channel)].reset(), bendRange_[16 + index(channel)].reset(); // as MPE has it
        zone = std::min(value, 15);
        otherZone = std::min(otherZone, std::max(0, 14 - zone));
    }

private:
    static constexpr int noParameter = 16383; // of the registered ones
    using Values = std::array<float, 17>;     // by channel; entry 0 stays 0
    static std::size_t index(int channel) noexcept { return static_cast<std::size_t>(channel); }
    std::size_t rangeIndex(int channel) const noexcept {
        const int master = findMaster(channel);
        return index(master > 0 ? 16 + master : channel);
    }
    double withMaster(const Values& of, int channel) const noexcept {
        return double{of[index(channel)]} + double{of[index(findMaster(channel))]};
    }
    Values bend_{}, slide_{};
    std::array<std::optional<double>, 33> bendRange_{}; // semitones of a full bend, if they were told
    std::array<int, 17> selectedParameter_{};           // the selected registered parameter
    int lowerMembers_ = 0, upperMembers_ = 0;
};

/// Detects starts, stops and jumps (as a stop and a start) of the host's transport between blocks. R only.
class Transport {
public:
    enum class Change { none, started, stopped };

    /// Called before each block of `frames` frames; `frame` is the host's position. A host that never says
    /// whether it plays, plays from its first block on; if it says nothing for a block, nothing has changed
    /// (LV2 hosts report only changes). A position within two blocks of the expected one is no jump: hosts
    /// play at half or twice the speed, their clocks jitter by a block, and the tempo may change within one.
    /// If every block jumps, the user scrubs: that is one start, and another when it ends.
    Change follow(std::optional<bool> isPlaying, std::optional<std::int64_t> frame, int frames) noexcept {
        constexpr std::int64_t maxFrame = std::int64_t{1} << 61; // sums fit
        if (frame) frame = std::clamp(*frame, -maxFrame, maxFrame);
        const bool plays = isPlaying.value_or(!hasTransport_ || wasPlaying_);
        // until a host reports a transport, it is assumed to play
        const bool wasPlaying = wasPlaying_ && (hasTransport_ || !isPlaying);
        hasTransport_ = hasTransport_ || isPlaying;
        const bool jumped = plays && wasPlaying && frame && expectedFrame_ &&
                            std::abs(*frame - *expectedFrame_) >= 2 * std::max(frames, lastFrames_);
        const auto change = plays        ? detectStart(!wasPlaying, jumped)
                            : wasPlaying ? Change::stopped
                                         : Change::none;
        if (frame) expectedFrame_ = frame;
        if (expectedFrame_) *expectedFrame_ += plays ? frames : 0;
        lastFrames_ = frames;
        wasPlaying_ = plays;
        return change;
    }

    bool isPlaying() const noexcept { return wasPlaying_; }

private:
    Change detectStart(bool begins, bool jumped) noexcept {
        const bool starts = begins || (jumped && !hasJustJumped_) || (!jumped && isStartPending_);
        isStartPending_ = !begins && jumped && hasJustJumped_;
        hasJustJumped_ = begins || jumped;
        return starts ? Change::started : Change::none;
    }

    bool hasTransport_ = false, wasPlaying_ = false;
    bool hasJustJumped_ = false, isStartPending_ = false;
    int lastFrames_ = 0;
    std::optional<std::int64_t> expectedFrame_;
};

/// Makes a scene's script follow the host's quarter notes: it begins at the first one in its run, and its own
/// time has 120 a minute. What the host does not report goes on as before; a jump of its position within a
/// run moves the script by at most half a note. R only.
class HostBeats {
public:
    struct Script {
        double seconds = 0.0, rate = 1.0; ///< its position, and its seconds per second of session time
    };
    static constexpr double sceneBeatsPerMinute = 120.0;

    /// Called before each block with the host's tempo and position in quarter notes, if it reports them.
    void follow(std::optional<double> perMinute, std::optional<double> beat, double blockSeconds) noexcept {
        beat_ = beat && std::abs(*beat) < 1e9 ? *beat : nextBeat_;
        if (perMinute && *perMinute >= 1.0 && *perMinute <= 1000.0) beatsPerSecond_ = *perMinute / 60.0;
        nextBeat_ = beat_ + blockSeconds * beatsPerSecond_;
    }

    /// Called when a run begins, `seconds` after the block's start.
    void begin(double seconds) noexcept {
        firstBeat_ = std::ceil(beatAt(seconds) - toleranceBeats);
        lastSent_ = {};
        sentAtSeconds_ = -1.0;
    }

    /// Calls `send(const Script&)` if position or rate have changed, until it returns true. `seconds` are of
    /// the block, `runSeconds` of the run.
    template <class Send>
    void sendIfChanged(double seconds, double runSeconds, Send send) noexcept {
        if (beatsPerSecond_ <= 0.0) return;
        constexpr double scene = sceneBeatsPerMinute / 60.0;
        const double expected = lastSent_.seconds + (runSeconds - sentAtSeconds_) * lastSent_.rate;
        if (sentAtSeconds_ >= 0.0) firstBeat_ += std::round(beatAt(seconds) - firstBeat_ - expected * scene);
        const Script now{(beatAt(seconds) - firstBeat_) / scene, beatsPerSecond_ / scene};
        const bool isAsSent = std::abs(now.seconds - expected) * scene < toleranceBeats &&
                              std::abs(now.rate - lastSent_.rate) < 1e-6 * lastSent_.rate;
        if ((sentAtSeconds_ >= 0.0 && isAsSent) || !send(now)) return;
        lastSent_ = now;
        sentAtSeconds_ = runSeconds;
    }

private:
    static constexpr double toleranceBeats = 0.01; // hosts round positions
    double beatAt(double seconds) const noexcept { return beat_ + seconds * beatsPerSecond_; }

    double beatsPerSecond_ = 0.0; // 0: the host has reported no tempo yet
    double beat_ = 0.0, nextBeat_ = 0.0, firstBeat_ = 0.0, sentAtSeconds_ = -1.0;
    Script lastSent_;
};

/// Limits one kind of control change, so that automation cannot fill the session's control queue: one change
/// in intervalFrames() of session time at most, with the newest value, whatever block and L are. R only.
class ControlPace {
public:
    static constexpr int maxPerSecond = 1500; // every 32 frames at 48 kHz, within ramps of 10 ms

    /// The minimum number of frames between two changes. Any thread.
    static constexpr int intervalFrames(int sampleRateHz) noexcept {
        return std::max(1, sampleRateHz / maxPerSecond);
    }

    /// Lets the next change be sent at once. M, or R.
    void reset(int sampleRateHz) noexcept {
        intervalFrames_ = intervalFrames(sampleRateHz);
        nextFrame_ = 0;
    }

    /// The first frame from `from` on at which the next change may be sent.
    std::int64_t nextAllowedFrame(std::int64_t from) const noexcept { return std::max(from, nextFrame_); }
    void recordSent(std::int64_t frame) noexcept { nextFrame_ = frame + intervalFrames_; }

private:
    int intervalFrames_ = 1;
    std::int64_t nextFrame_ = 0;
};

} // namespace physvib
