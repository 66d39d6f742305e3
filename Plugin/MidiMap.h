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

/// The rules of a state made ready for the render role: a table, no search. Built on M, read by R.
class MidiTable {
public:
    MidiTable() = default;
    /// Materials that never vibrate strike nothing. A note's own frequency is its pitch, moved by octaves to
    /// where it is felt, 20 to 500 Hz.
    explicit MidiTable(const PluginState& state);

    /// The strike of a note, its amplitude 1; frequency 0 if it strikes nothing.
    const CollisionEvent& strikeOf(int note) const noexcept {
        return strikes_[static_cast<std::size_t>(note & 127)];
    }
    /// True if it sounds until its key is let go.
    bool isHeld(int note) const noexcept { return held_[static_cast<std::size_t>(note & 127)]; }
    const NoteVoice& voice() const noexcept { return voice_; }
    /// The group of actions that a note performs; -1: none, it strikes.
    int groupOf(int note) const noexcept { return groups_[static_cast<std::size_t>(note & 127)]; }
    /// The group that gives what is felt the material of that number of the parameter (0: the scene's own);
    /// -1: none.
    int groupOfMaterial(int choice) const noexcept { return choice <= materials_ ? choice : -1; }
    /// -1: none.
    int parameterOf(int controller) const noexcept {
        return parameters_[static_cast<std::size_t>(controller & 127)];
    }
    double fieldWidthMetres() const noexcept { return width_; }
    double fieldHeightMetres() const noexcept { return height_; }

private:
    std::array<CollisionEvent, 128> strikes_{};
    std::array<bool, 128> held_{};
    NoteVoice voice_{};
    std::array<int, 128> parameters_{}, groups_{};
    int materials_ = 0;
    double width_ = 1.0, height_ = 1.0;
};

} // namespace physvib
