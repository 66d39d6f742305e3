// SPDX-License-Identifier: MIT
// What each actuator gets of a hit at a place.
#include "Api/C/Convert.h"
#include "Api/JavaScript/Exports.h"
#include <algorithm>

namespace physvib::js {

extern "C" {

/// Gains of a place in the field, m, to `gains` (room for PHYSVIB_MAX_ENCHANTERS): how many, or an error.
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
