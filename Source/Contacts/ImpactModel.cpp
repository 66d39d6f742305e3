// SPDX-License-Identifier: MIT
// The default normalisation of the impact model.
#include "Contacts/ImpactModel.h"

namespace physvib {

double defaultNormalisation(double fieldWidthMetres) noexcept {
    return 1.0 / (2.0 * largestSpeed(fieldWidthMetres));
}

} // namespace physvib
