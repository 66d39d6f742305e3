// SPDX-License-Identifier: GPL-3.0-or-later
// The renders of a design: which of them, and where what is made of them lies.
#pragma once
#include <cstdint>
#include <string>

namespace physvib {

/// Every so many-th task from the `number`-th on, from 1: what one of several calls does.
struct SweepPart {
    std::uint64_t number = 1, parts = 1;
    bool operator==(const SweepPart&) const = default;
};

struct SweepJob {
    std::string design, folder; ///< its path; all that is written lies in the folder
    bool keepsWavs = false, keepsEvents = false;
    SweepPart part;
    bool operator==(const SweepJob&) const = default;
};

} // namespace physvib
