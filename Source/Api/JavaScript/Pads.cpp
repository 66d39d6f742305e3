// SPDX-License-Identifier: MIT
// JavaScript exports for the two motors of a game controller, with the computation of the native sink.
#include "Api/C/Calls.h"
#include "Api/C/Objects.h"
#include "Api/JavaScript/Exports.h"
#include <array>
#include <limits>

namespace physvib::js {
namespace {

/// A controller, and the place where JavaScript reads its commands.
struct ScriptPad : api::Pad {
    using Pad::Pad;
    std::array<double, 3> command{}; // ns, low, high
};

} // namespace

extern "C" {

/// `law`: the numbers of a PadLaw: low and high motor (threshold, half, full, rise, fall), then the others.
/// Returns 0 and sets physvib_error() if they are invalid.
ScriptPad* PHYSVIB_JS(pad_create)(const double* law, double widthMetres, double heightMetres) {
    if (!(widthMetres > 0.0 && widthMetres <= 1e9 && heightMetres > 0.0 && heightMetres <= 1e9))
        return api::nothingThere("field: expected more than 0 m, to 10^9 m"), nullptr;
    const auto motorAt = [](const double* at) { return PadMotor{at[0], at[1], at[2], at[3], at[4]}; };
    const auto isFit = [](const PadMotor& m) {
        return m.threshold >= 0.0 && m.threshold < m.half && m.half < m.full && m.full <= 1.0 &&
               m.riseSeconds > 0.0 && m.fallSeconds > 0.0;
    };
    const PadLaw wanted{motorAt(law), motorAt(law + 5), law[10], law[11], law[12], law[13], law[14], law[15]};
    if (!isFit(wanted.low) || !isFit(wanted.high))
        return api::nothingThere("pad: expected 0 <= threshold < half < full <= 1, and times above 0 s"),
               nullptr;
    if (!(wanted.commandsPerSecond >= 1.0 && wanted.commandsPerSecond <= 1000.0 &&
          wanted.leadSeconds >= 0.0 && wanted.splitHz > 0.0 && wanted.side >= 0.0 && wanted.side <= 1.0 &&
          wanted.floor > 0.0 && wanted.exponent > 0.0))
        return api::nothingThere("pad: expected 1 to 1000 commands a second, and numbers as in Docs/pads.md"),
               nullptr;
    return new ScriptPad{wanted, widthMetres, heightMetres};
}

void PHYSVIB_JS(pad_free)(ScriptPad* pad) { delete pad; }

/// Queues an event; its time is that at which the motor shall be felt. Returns 0, or an error.
int PHYSVIB_JS(pad_strike)(ScriptPad* pad, const physvib_event* event) {
    CollisionEvent own;
    if (const auto fault = api::readEvent(*event, own); !fault.empty())
        return api::fail(PHYSVIB_ERROR_ARGUMENT, fault);
    pad->strike(own);
    return PHYSVIB_OK;
}

/// Time of the next command, ns; infinity: the motors are at rest.
double PHYSVIB_JS(pad_due)(ScriptPad* pad) {
    const std::int64_t dueNs = pad->motors().dueNs();
    return dueNs == PadMotors::never ? std::numeric_limits<double>::infinity() : static_cast<double>(dueNs);
}

/// Removes and returns the next command: time in ns, low and high motor.
const double* PHYSVIB_JS(pad_next)(ScriptPad* pad, double level) {
    const PadCommand next = pad->motors().next(level);
    pad->command = {static_cast<double>(next.timeNs), next.low, next.high};
    return pad->command.data();
}

void PHYSVIB_JS(pad_stop)(ScriptPad* pad, double atNs) {
    pad->motors().stop(static_cast<std::int64_t>(atNs));
}
double PHYSVIB_JS(pad_lost)(ScriptPad* pad) { return static_cast<double>(pad->motors().lost()); }
double PHYSVIB_JS(pad_commands_per_second)(ScriptPad* pad) { return pad->law().commandsPerSecond; }
}

} // namespace physvib::js
