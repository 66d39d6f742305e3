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
    RendererSettings renderer;
    if (const auto error = api::convert(*settings, renderer); !error.empty())
        return api::fail(PHYSVIB_ERROR_ARGUMENT, error);
    if (!std::isfinite(x) || !std::isfinite(y)) return api::argumentError("place: expected numbers");
    PhantomPanner::Gains channelGains{};
    renderer.panner.gainsAt(x, y, channelGains);
    std::copy_n(channelGains.data(), renderer.panner.channels(), gains);
    return renderer.panner.channels();
}
}

} // namespace physvib::js
