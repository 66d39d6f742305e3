// SPDX-License-Identifier: GPL-3.0-or-later
// Measures steady vibrations in accelerometer recordings with one channel per axis or actuator.
#pragma once
#include "Io/Result.h"
#include <complex>
#include <string>
#include <vector>

namespace physvib {

/// Root mean square of each channel without its mean; or one error line with the file's name. Message thread.
Result<std::vector<double>> axisLevels(const std::string& path);

/// Complex amplitude of each channel at that frequency; or one error line. Message thread.
Result<std::vector<std::complex<double>>> channelTones(const std::string& path, double frequencyHz);

} // namespace physvib
