// SPDX-License-Identifier: MIT
// Isolation study (thesis 3.1.1): the vibration attenuation of damping layers, by condition.
#pragma once
#include <string>
#include <vector>

namespace physvib {

/// A layer and its drive signal. All but the frequency are labels that are compared, not computed with.
struct IsolationCondition {
    std::string material, softener, thickness; ///< of the layer; a reference has none
    std::string voltage, axis;                 ///< of the drive
    double frequencyHz = 0.0;
};

/// One recording: a level per axis of the accelerometer.
struct IsolationMeasurement {
    IsolationCondition condition;
    bool isReference = false; ///< without a layer
    std::vector<double> levels;
    std::string source; ///< the file, for messages
};

struct IsolationResult {
    IsolationCondition condition;
    std::vector<double> gammas;         ///< Eq. 3.2 of each repetition against the drive's mean reference
    double mean = 0.0, deviation = 0.0; ///< of `gammas`; sample standard deviation, 0 for one value
};

struct IsolationStudy {
    std::string fault;                    ///< error in one line; if set, the results are invalid
    std::vector<IsolationResult> results; ///< sorted: material, softener, thickness, axis, voltage, frequency
};

/// Any thread (allocates).
IsolationStudy summariseIsolation(const std::vector<IsolationMeasurement>& measurements);

} // namespace physvib
