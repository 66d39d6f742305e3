// SPDX-License-Identifier: GPL-3.0-or-later
// How many onsets were marked, in words.
#pragma once
#include "Io/Text/NumberText.h"
#include "Live/Session/OnsetMarks.h"
#include <string>

namespace physvib {

/// "12 pulses", or "12 pulses for 14 onsets: 2 came within 0.5 ms of another".
inline std::string markWords(const OnsetMarks& marks) {
    const std::string words = counted(marks.made(), "pulse");
    if (marks.shared() == 0) return words;
    return words + " for " + std::to_string(marks.made() + marks.shared()) +
           " onsets: " + std::to_string(marks.shared()) + " came within 0.5 ms of another";
}

} // namespace physvib
