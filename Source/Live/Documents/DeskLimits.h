// SPDX-License-Identifier: MIT
// What a machine's own desk allows: a mix that comes from a file is taken only up to that.
#pragma once
#include "Live/Documents/Mix.h"
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// As the desk was left by the person at it.
struct DeskLimits {
    double levelDb = 0.0;
    std::vector<Strip> strips; ///< what leaves by each output that is in use

    static DeskLimits of(const Mix& mix);
};

void visitFields(auto& v, FieldsOf<DeskLimits>) {
    v.field("level_db", &DeskLimits::levelDb, masterRangeDb);
    v.field("strips", &DeskLimits::strips, kinds::Objects<Strip>{});
}

/// Lowers `mix` to `most`: its master level, and on each output the gain and the ceiling; what is silent
/// there stays so. An enchanter on an output that is not in use there gets none. What was lowered, in words
/// for people; empty: nothing. Any thread.
std::string lowerTo(const DeskLimits& most, Mix& mix);

/// As text for a program's settings, and back; nullopt if it is none. Any thread.
std::string deskLimitsText(const DeskLimits& limits);
std::optional<DeskLimits> readDeskLimits(std::string_view text);

} // namespace physvib
