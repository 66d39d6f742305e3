// SPDX-License-Identifier: MIT
// What PhysVib must know of a fixture: the thesis' user data (Fig. 5.1), kept beside Box2D's own.
#pragma once
#include "Contacts/Voice.h"

namespace physvib {

/// Contact sound and camera flag of one fixture. Box2D's user data stay the user's.
struct HapticFixture {
    double frequencyHz = 0.0;
    double decayPerSecond = 0.0;
    bool isCamera = false;
    double staticMassKg = 0.0; ///< mass for Eq. 5.4 if the body is not dynamic; a dynamic body has its own
    Voice voice = Voice::own;  ///< of a camera (SPEC erratum 16); without a partner that sounds: own
};

} // namespace physvib
