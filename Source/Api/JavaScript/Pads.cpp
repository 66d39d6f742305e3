// SPDX-License-Identifier: MIT
// JavaScript exports for the two motors of a game controller, computed as for a native one.
#include "Api/C/Calls.h"
#include "Api/C/HandleObjects.h"
#include "Api/JavaScript/Exports.h"
#include <array>
#include <limits>

namespace physvib::js {
namespace {

/// A controller, and the place where JavaScript reads its commands.
struct ExportedPad : api::Pad {
    using Pad::Pad;
    std::array<double, 3> command{}; // ns, low, high
};

} // namespace

extern "C" {

/// `law`: the numbers of a PadModel: low and high motor (threshold, half, full, rise, fall), then the others.
/// Returns 0 and sets physvib_error() if they are invalid.
ExportedPad* PHYSVIB_JS(pad_create)(const double* law, double widthMetres, double heightMetres) {
    if (!(widthMetres > 0.0 && widthMetres <= 1e9 && heightMetres > 0.0 && heightMetres <= 1e9))
        return api::argumentError("field: expected more than 0 m, to 10^9 m"), nullptr;
    const auto motorOf = [](const double* v) { return PadMotor{v[0], v[1], v[2], v[3], v[4]}; };
    const auto isValidMotor = [](const PadMotor& m) {
        return m.threshold >= 0.0 && m.threshold < m.half && m.half < m.full && m.full <= 1.0 &&
               m.riseSeconds > 0.0 && m.fallSeconds > 0.0;
    };
    const PadModel pad{motorOf(law), motorOf(law + 5), law[10], law[11], law[12], law[13], law[14], law[15]};
    if (!isValidMotor(pad.low) || !isValidMotor(pad.high))
        return api::argumentError("pad: expected 0 <= threshold < half < full <= 1, and times above 0 s"),
               nullptr;
    if (!(pad.commandsPerSecond >= 1.0 && pad.commandsPerSecond <= 1000.0 && pad.leadSeconds >= 0.0 &&
          pad.splitHz > 0.0 && pad.placeWeight >= 0.0 && pad.placeWeight <= 1.0 && pad.floor > 0.0 &&
          pad.exponent > 0.0))
        return api::argumentError(
                   "pad: expected 1 to 1000 commands a second, and numbers as in Docs/pads.md"),
               nullptr;
    return new ExportedPad{pad, widthMetres, heightMetres};
}

void PHYSVIB_JS(pad_free)(ExportedPad* pad) { delete pad; }

/// Queues an event, whose time is that of the perceived vibration. Returns 0, or an error.
int PHYSVIB_JS(pad_strike)(ExportedPad* pad, const physvib_event* event) {
    CollisionEvent converted;
    if (const auto error = api::readEvent(*event, converted); !error.empty())
        return api::fail(PHYSVIB_ERROR_ARGUMENT, error);
    pad->strike(converted);
    return PHYSVIB_OK;
}

/// Time of the next command, ns; infinity: the motors are at rest.
double PHYSVIB_JS(pad_due)(ExportedPad* pad) {
    const std::int64_t dueNs = pad->motors().dueNs();
    return dueNs == PadMotors::never ? std::numeric_limits<double>::infinity() : static_cast<double>(dueNs);
}

/// Removes and returns the next command: time in ns, low and high motor.
const double* PHYSVIB_JS(pad_next)(ExportedPad* pad, double level) {
    const PadCommand next = pad->motors().next(level);
    pad->command = {static_cast<double>(next.timeNs), next.low, next.high};
    return pad->command.data();
}

void PHYSVIB_JS(pad_stop)(ExportedPad* pad, double atNs) {
    pad->motors().stop(static_cast<std::int64_t>(atNs));
}
double PHYSVIB_JS(pad_lost)(ExportedPad* pad) { return static_cast<double>(pad->motors().lost()); }
double PHYSVIB_JS(pad_commands_per_second)(ExportedPad* pad) { return pad->law().commandsPerSecond; }
}

} // namespace physvib::js
