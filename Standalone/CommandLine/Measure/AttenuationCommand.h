// SPDX-License-Identifier: GPL-3.0-or-later
// `physvib attenuation`: Eq. 3.1 and 3.2 of the thesis from two recordings, or from a folder of conditions.
#pragma once
#include <string>

namespace physvib {

class OptionTable;

/// As given on the command line: one channel per axis of the accelerometer.
struct AttenuationOptions {
    std::string isolatedPath, referencePath; ///< no reference: the former is a folder
    std::string exportPath, picturePath;     ///< of a folder; empty: not wanted
};

void declareAttenuation(OptionTable& command, AttenuationOptions& options);

/// A line of CSV per axis and one for all, or one per condition, on stdout; the code to leave with.
int runAttenuation(const AttenuationOptions& options);

} // namespace physvib
