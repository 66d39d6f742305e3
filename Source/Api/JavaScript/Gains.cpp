// SPDX-License-Identifier: MIT
// JavaScript export of the panner: gain of each actuator for an impact at a place.
#include "Api/C/Calls.h"
#include "Api/JavaScript/Exports.h"
#include <algorithm>

namespace physvib::js {

extern "C" {

/// Writes the gains for a place in the field, in m, to `gains` (PHYSVIB_MAX_ENCHANTERS entries); returns
/// their number, or an error.
int PHYSVIB_JS(gains)(const physvib_renderer_settings* settings, double x, double y, double* gains) {
    RendererSettings wanted;
    if (const auto fault = api::convert(*settings, wanted); !fault.empty())
        return api::fail(PHYSVIB_ERROR_ARGUMENT, fault);
    if (!std::isfinite(x) || !std::isfinite(y)) return api::nothingThere("place: expected numbers");
    PhantomPanner::Gains all{};
    wanted.panner.gainsAt(x, y, all);
    std::copy_n(all.data(), wanted.panner.channels(), gains);
    return wanted.panner.channels();
}
}

} // namespace physvib::js
