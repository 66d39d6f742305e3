// SPDX-License-Identifier: GPL-3.0-or-later
// MidiTable: what MIDI notes strike and controllers move; NoteKnobs: the parameters that change notes.
#pragma once
#include "Core/CollisionEvent.h"
#include "Live/Documents/PluginState.h"
#include "Parameters.h"
#include <array>

namespace physvib {

/// Actions of notes and of the material parameter on the world, by the group numbers of MidiTable: first the
/// scene's own materials, then each material for all fixtures that are felt, then each note rule.
std::vector<std::vector<Action>> actionGroups(const PluginState& state);

/// The parameters that change notes, at one frame. With these defaults notes are those of the preset.
struct NoteKnobs {
    double decay = 1.0, release = 1.0, velocityCurve = 1.0; ///< factors of two times and of an exponent
    int hold = 0, placement = 0, bend = 0, material = 0;    ///< indices of choices; 0: the preset's
    bool operator==(const NoteKnobs&) const = default;
};

/// Reads the knobs by `valueOf(Parameter)`, which returns a value in the parameter's unit.
template <class ValueOf>
NoteKnobs noteKnobsFrom(ValueOf valueOf) noexcept {
    const auto choice = [&](Parameter which) { return static_cast<int>(valueOf(which) + 0.5); };
    return {valueOf(Parameter::decay),      valueOf(Parameter::release),  valueOf(Parameter::velocityCurve),
            choice(Parameter::hold),        choice(Parameter::placement), choice(Parameter::bendRange),
            choice(Parameter::noteMaterial)};
}

/// The voice with the changes of the knobs, for display. Any thread.
NoteVoice adjustedVoice(NoteVoice voice, const NoteKnobs& knobs) noexcept;

/// The rules of a state as a table by note and controller, so that the audio thread needs no search.
class MidiTable {
public:
    MidiTable() = default;
    /// Any thread. Pitches are moved by octaves into 20 to 500 Hz, where they can be felt.
    explicit MidiTable(const PluginState& state);

    /// The strike of a note, its amplitude 1; frequency 0 if it strikes nothing.
    const CollisionEvent& strikeOf(int note) const noexcept {
        return strikes_[static_cast<std::size_t>(note & 127)];
    }
    /// The strike of a note, adjusted by the knobs, on actuators in that layout.
    CollisionEvent strikeOf(int note, const NoteKnobs& knobs, const ActuatorLayout& layout) const noexcept;
    /// True if the note sounds until its key is released.
    bool isHeld(int note) const noexcept { return isHeld_[static_cast<std::size_t>(note & 127)]; }
    bool isHeld(int note, const NoteKnobs& knobs) const noexcept {
        return knobs.hold == 0 ? isHeld(note)
                               : knobs.hold == 2 && !hasRule_[static_cast<std::size_t>(note & 127)];
    }
    /// Decay rate after a held note's key is released.
    double releasePerSecond(const NoteKnobs& knobs) const noexcept;
    /// Semitones of a full bend; 0: a bend moves the place instead.
    double bendSemitones(const NoteKnobs& knobs) const noexcept {
        return knobs.bend == 0 ? voice_.bendSemitones
                               : parameterTable::bendSemitones[static_cast<std::size_t>(knobs.bend)];
    }
    /// Amplitude, 0 to 1, of a velocity of 1 to 127.
    double velocityAmplitude(int velocity, const NoteKnobs& knobs) const noexcept;
    const NoteVoice& voice() const noexcept { return voice_; }
    /// The action group that a note performs; -1: none, because it strikes.
    int noteGroup(int note) const noexcept { return actionGroups_[static_cast<std::size_t>(note & 127)]; }
    /// The action group of a choice of the material parameter (0: the scene's own); -1: none.
    int materialGroup(int choice) const noexcept { return choice <= materialCount_ ? choice : -1; }
    /// Index of the parameter that a controller moves; -1: none.
    int controllerParameter(int controller) const noexcept {
        return parameters_[static_cast<std::size_t>(controller & 127)];
    }
    double fieldWidthMetres() const noexcept { return fieldWidthMetres_; }
    double fieldHeightMetres() const noexcept { return fieldHeightMetres_; }

private:
    std::array<CollisionEvent, 128> strikes_{};
    std::array<bool, 128> isHeld_{}, hasRule_{};
    struct Sound {
        double frequencyHz = 0.0, decayPerSecond = 0.0; // frequency 0: it never vibrates
    };
    std::array<Sound, parameterTable::noteMaterialNames.size()> sounds_{}; // from 1
    NoteVoice voice_{};
    std::array<int, 128> parameters_{}, actionGroups_{};
    int materialCount_ = 0;
    double fieldWidthMetres_ = 1.0, fieldHeightMetres_ = 1.0;
};

} // namespace physvib
