// SPDX-License-Identifier: MIT
// Limits that a mixer state loaded from a file must not exceed: the levels that the user of this computer has
// set.
#pragma once
#include "Live/Documents/Mix.h"
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// The limits, taken from the mixer state as the user left it.
struct DeskLimits {
    double levelDb = 0.0;
    std::vector<Strip> strips; ///< one per output in use, with the gain that reaches it

    static DeskLimits of(const Mix& mix);
    /// Level of the loudest output by gain, ceiling and master; the master's alone if no output is in use.
    double loudestOutputDb() const;
};

void visitFields(auto& v, FieldsOf<DeskLimits>) {
    v.field("level_db", &DeskLimits::levelDb, masterRangeDb);
    v.field("strips", &DeskLimits::strips, kinds::Objects<Strip>{});
}

/// Lowers `mix` to `most`: its master level, and gain and ceiling of each output. An output that is muted in
/// `most` is muted. An actuator on an output that `most` does not use gets no output. Returns a text for the
/// user that lists the changes; empty: none. Any thread.
std::string lowerTo(const DeskLimits& most, Mix& mix);

/// Conversion to text for a program's settings, and back; nullopt if the text is invalid. Any thread.
std::string deskLimitsText(const DeskLimits& limits);
std::optional<DeskLimits> readDeskLimits(std::string_view text);

} // namespace physvib
