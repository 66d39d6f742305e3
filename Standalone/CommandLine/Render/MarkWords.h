// SPDX-License-Identifier: GPL-3.0-or-later
// How many onsets were marked, in words.
#pragma once
#include "Live/Session/OnsetMarks.h"
#include <string>

namespace physvib {

/// "12 pulses", or "12 pulses for 14 onsets: 2 came within 0.5 ms of another".
inline std::string markWords(const OnsetMarks& marks) {
    const std::string words = std::to_string(marks.made()) + (marks.made() == 1 ? " pulse" : " pulses");
    if (marks.shared() == 0) return words;
    return words + " for " + std::to_string(marks.made() + marks.shared()) +
           " onsets: " + std::to_string(marks.shared()) + " came within 0.5 ms of another";
}

} // namespace physvib
