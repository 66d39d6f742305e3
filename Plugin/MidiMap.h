// SPDX-License-Identifier: GPL-3.0-or-later
// Which note strikes what and where; which controller moves which parameter.
#pragma once
#include "Core/CollisionEvent.h"
#include "Host/Parameters.h"
#include "Physics/Scene.h"
#include <array>
#include <optional>
#include <vector>

namespace physvib {

/// A note that does not do what the default map says.
struct NoteRule {
    int note = 0;     ///< 0 to 127
    int material = 0; ///< index of the scene's
    double x = 0.5;   ///< place in parts of the field, from the lower left corner
    double y = 0.5;
    bool operator==(const NoteRule&) const = default;
};

/// A controller that moves a parameter over its whole range.
struct ControllerRule {
    int controller = 0; ///< 0 to 119
    Parameter parameter = Parameter::level;
    bool operator==(const ControllerRule&) const = default;
};

/// What differs from the default: every octave is a material of the scene, every note a place from left (C) to right (B).
struct MidiMap {
    std::vector<NoteRule> notes;
    std::vector<ControllerRule> controllers{defaultControllers()};
    bool operator==(const MidiMap&) const = default;

    static std::vector<ControllerRule> defaultControllers() {
        return {{1, Parameter::tilt}, {7, Parameter::level}, {16, Parameter::gravity}, {17, Parameter::exponent}};
    }
};

/// A map made ready for the render role: a table, no search. Built on M, read by R.
class MidiTable {
public:
    MidiTable() = default;
    /// `scene` valid; materials that never vibrate strike nothing.
    MidiTable(const MidiMap& map, const Scene& scene);

    /// The strike of a note, its amplitude 1; frequency 0 if it strikes nothing.
    const CollisionEvent& strikeOf(int note) const noexcept { return strikes_[static_cast<std::size_t>(note & 127)]; }
    /// -1: none.
    int parameterOf(int controller) const noexcept { return parameters_[static_cast<std::size_t>(controller & 127)]; }
    double fieldWidthMetres() const noexcept { return width_; }
    double fieldHeightMetres() const noexcept { return height_; }

private:
    std::array<CollisionEvent, 128> strikes_{};
    std::array<int, 128> parameters_{};
    double width_ = 1.0, height_ = 1.0;
};

} // namespace physvib
