// SPDX-License-Identifier: MIT
// Numbers in calls and in rows.
#pragma once
#include <charconv>
#include <string>

namespace physvib {

/// The shortest text that reads back as the same bits, in every locale. Any thread (allocates).
inline std::string numberWord(double number) {
    char digits[32]; // the longest shortest double has 24 characters
    return {digits, std::to_chars(digits, digits + sizeof digits, number).ptr};
}

} // namespace physvib
