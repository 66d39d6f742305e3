// SPDX-License-Identifier: GPL-3.0-or-later
// Two states of panning law, layout and mix, A and B, of which one plays; one key changes between them, at
// matched levels.
#pragma once
#include "Core/CollisionEvent.h"
#include "Live/Documents/Mix.h"
#include <optional>
#include <span>

namespace physvib {

class Desk;

/// The level, in g^2, that a mixer state gives these events: the sum over its actuators, behind strips and
/// master. Any thread.
double feltEnergy(const Mix& mix, std::span<const CollisionEvent> events);

/// Message thread only.
class DeskCompare {
public:
    explicit DeskCompare(Desk& desk)
        : desk_{desk} {}

    /// Plays the other state. The first call makes B, a copy of A, and plays it. The louder of both is turned
    /// down to the other by the master, at the contacts played last; nothing is turned up.
    void toggle();
    /// Keeps what plays, and forgets the other.
    void end();
    /// False again after a change between them was undone.
    bool isOn() const;
    char shown() const noexcept { return isB_ ? 'B' : 'A'; }
    double loweredDb() const noexcept { return loweredDb_; } ///< of what plays, so that the levels match

private:
    Mix own() const;

    Desk& desk_;
    std::optional<Mix> other_; // as set by the user
    bool isB_ = false;
    double loweredDb_ = 0.0, setDb_ = 0.0; // master level that was set with it
};

} // namespace physvib
