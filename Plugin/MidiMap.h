// SPDX-License-Identifier: GPL-3.0-or-later
// Mapping of MIDI: which note strikes what and where, and which controller moves which parameter.
#pragma once
#include "Core/CollisionEvent.h"
#include "Live/Documents/PluginState.h"
#include "Parameters.h"
#include <array>

namespace physvib {

/// What notes and the material parameter do to the world, in the order of MidiTable's numbers: the scene's
/// own materials, each material for all that is felt, then each note rule.
std::vector<std::vector<Action>> actionGroups(const PluginState& state);

/// What the parameters make of notes, at one frame. As it is here, they sound as in the preset, to the bit.
struct NoteKnobs {
    double decay = 1.0, release = 1.0, velocityCurve = 1.0; ///< factors of times, and of an exponent
    int hold = 0, placement = 0, bend = 0, material = 0;    ///< places in lists; 0: the preset's
    bool operator==(const NoteKnobs&) const = default;
};

/// `valueOf(Parameter)` in the parameter's unit.
template <class ValueOf>
NoteKnobs knobsBy(ValueOf valueOf) noexcept {
    const auto choice = [&](Parameter which) { return static_cast<int>(valueOf(which) + 0.5); };
    return {valueOf(Parameter::decay),      valueOf(Parameter::release),  valueOf(Parameter::velocityCurve),
            choice(Parameter::hold),        choice(Parameter::placement), choice(Parameter::bendRange),
            choice(Parameter::noteMaterial)};
}

/// A voice as the knobs have it, for people: what they do not move is as it was. Any thread.
NoteVoice voiceBy(NoteVoice voice, const NoteKnobs& knobs) noexcept;

/// The rules of a state made ready for the render role: a table, no search. Built on M, read by R.
class MidiTable {
public:
    MidiTable() = default;
    /// What never vibrates strikes nothing. Pitches move by octaves to where they are felt, 20 to 500 Hz.
    explicit MidiTable(const PluginState& state);

    /// The strike of a note, its amplitude 1; frequency 0 if it strikes nothing.
    const CollisionEvent& strikeOf(int note) const noexcept {
        return strikes_[static_cast<std::size_t>(note & 127)];
    }
    /// The same as the knobs have it, on actuators in that layout.
    CollisionEvent strikeOf(int note, const NoteKnobs& knobs, const EnchanterLayout& layout) const noexcept;
    /// True if it sounds until its key is let go.
    bool isHeld(int note) const noexcept { return held_[static_cast<std::size_t>(note & 127)]; }
    bool isHeld(int note, const NoteKnobs& knobs) const noexcept {
        return knobs.hold == 0 ? isHeld(note)
                               : knobs.hold == 2 && !ruled_[static_cast<std::size_t>(note & 127)];
    }
    double releasePerSecond(const NoteKnobs& knobs) const noexcept;
    /// Of a full bend; 0: it moves the place.
    double bendSemitones(const NoteKnobs& knobs) const noexcept {
        return knobs.bend == 0 ? voice_.bendSemitones
                               : parameterTable::bendSemitones[static_cast<std::size_t>(knobs.bend)];
    }
    /// From a velocity of 1 to 127 to 0 to 1.
    double loudnessOf(int velocity, const NoteKnobs& knobs) const noexcept;
    const NoteVoice& voice() const noexcept { return voice_; }
    /// The group of actions that a note performs; -1: none, it strikes.
    int groupOf(int note) const noexcept { return groups_[static_cast<std::size_t>(note & 127)]; }
    /// The group that gives what is felt that material of the parameter (0: the scene's own); -1: none.
    int groupOfMaterial(int choice) const noexcept { return choice <= materials_ ? choice : -1; }
    /// -1: none.
    int parameterOf(int controller) const noexcept {
        return parameters_[static_cast<std::size_t>(controller & 127)];
    }
    double fieldWidthMetres() const noexcept { return width_; }
    double fieldHeightMetres() const noexcept { return height_; }

private:
    std::array<CollisionEvent, 128> strikes_{};
    std::array<bool, 128> held_{}, ruled_{};
    struct Sound {
        double frequencyHz = 0.0, decayPerSecond = 0.0; // 0: it never vibrates
    };
    std::array<Sound, parameterTable::noteMaterialNames.size()> sounds_{}; // from 1, as the parameter counts
    NoteVoice voice_{};
    std::array<int, 128> parameters_{}, groups_{};
    int materials_ = 0;
    double width_ = 1.0, height_ = 1.0;
};

} // namespace physvib
