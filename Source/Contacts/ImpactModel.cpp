// SPDX-License-Identifier: MIT
// The default normalisation of the impact model.
#include "Contacts/ImpactModel.h"

namespace physvib {

double defaultNormalisation(double fieldWidthMetres) noexcept {
    const double maxSpeed = fieldWidthMetres / 1.0; // across the field in one second
    return 1.0 / (2.0 * maxSpeed);
}

} // namespace physvib
