// SPDX-License-Identifier: MIT
// An isolation study (thesis 3.1.1): how much a layer holds back, condition by condition.
#pragma once
#include <string>
#include <vector>

namespace physvib {

/// What a layer is and how it was shaken. Words but for the frequency: they are compared, not calculated
/// with.
struct IsolationCondition {
    std::string material, thickness; ///< of the layer; a reference has none
    std::string voltage, axis;       ///< of the drive
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
    std::vector<double> gammas; ///< Eq. 3.2 of each repetition against the mean of the references of its
                                ///< drive
    double mean = 0.0, deviation = 0.0; ///< of them; sample standard deviation, 0 of one
};

struct IsolationStudy {
    std::string fault;                    ///< one line; then nothing else holds
    std::vector<IsolationResult> results; ///< by material, thickness, axis, voltage and frequency
};

/// Any thread (allocates).
IsolationStudy summariseIsolation(const std::vector<IsolationMeasurement>& measurements);

} // namespace physvib
