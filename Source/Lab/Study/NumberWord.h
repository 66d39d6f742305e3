// SPDX-License-Identifier: MIT
// Locale-independent text of numbers in calls and trial files.
#pragma once
#include <charconv>
#include <string>

namespace physvib {

/// The shortest text that parses to exactly the same value, in every locale. Any thread (allocates).
inline std::string numberWord(double number) {
    char digits[32]; // the shortest form of a double has at most 24 characters
    return {digits, std::to_chars(digits, digits + sizeof digits, number).ptr};
}

} // namespace physvib
