// SPDX-License-Identifier: MIT
// Formats numbers for display on a screen or picture, the same in every locale.
#pragma once
#include <string>

namespace physvib::readable {

/// Fixed notation with thousands separators and a true minus sign (UTF-8). Any thread.
std::string number(double value, int decimals);
/// At most three significant digits, no trailing zeros. Any thread.
std::string shortNumber(double value);
/// 20 log10 |amplitude|; minus infinity for 0. Any thread.
double decibels(double amplitude);
/// "-6.0 dBFS", or "silent" below the level at which voices end. Any thread.
std::string decibelText(double amplitude);

} // namespace physvib::readable
