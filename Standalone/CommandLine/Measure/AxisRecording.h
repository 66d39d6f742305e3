// SPDX-License-Identifier: GPL-3.0-or-later
// Steady vibrations as accelerometers record them: a channel per axis, or per enchanter.
#pragma once
#include "Io/Result.h"
#include <complex>
#include <string>
#include <vector>

namespace physvib {

/// Root mean square of each channel without what stands still; or one line that names the file and what is
/// wrong. M.
Result<std::vector<double>> axisLevels(const std::string& path);

/// Amplitude and phase of each channel at that frequency; or one line. M.
Result<std::vector<std::complex<double>>> channelTones(const std::string& path, double frequencyHz);

} // namespace physvib
