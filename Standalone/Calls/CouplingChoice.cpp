// SPDX-License-Identifier: GPL-3.0-or-later
// Loads a coupling, checks it against the layout, and describes its residual error.
#include "Calls/CouplingChoice.h"
#include "Core/Units.h"
#include "Io/Text/NumberText.h"
#include "Lab/Files/CouplingFile.h"

namespace physvib {
namespace {

std::string percent(double share) { return fixedNumber(100.0 * share, 1) + " %"; }

std::string noteOf(const MeasuredCoupling& measured) {
    const CouplingResidual r = residualOf(measured);
    return "coupling: what is felt differs from what is wanted by " + percent(r.compensated) +
           ", without compensation by " + percent(r.plain) + "; by " + percent(r.mismatchedCompensated) +
           " and " + percent(r.mismatchedPlain) +
           " where it is off by up to 2 dB and 20 degrees; strongest drive " +
           fixedNumber(toDecibels(r.strongestDrive), 1) + " dB";
}

} // namespace

Result<CouplingChoice> chooseCoupling(const std::string& path, const LayoutDescription& layout) {
    const auto measured = loadCoupling(path);
    if (!measured) return Failure{measured.error};
    if (const std::size_t found = measured.value.enchanters(), wanted = layout.enchanters.size();
        found != wanted)
        return Failure{path + ": expected as many actuators as the layout has, " + std::to_string(wanted) +
                       ", found " + std::to_string(found)};
    return CouplingChoice{CouplingDrives{measured.value}, noteOf(measured.value)};
}

} // namespace physvib
