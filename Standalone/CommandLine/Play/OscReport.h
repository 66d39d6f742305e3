// SPDX-License-Identifier: GPL-3.0-or-later
// Prints the activity of an OSC port.
#pragma once
#include "Host/Osc/OscPort.h"

namespace physvib {

/// Prints the listening address on stderr, and if the requested port is in use. Any thread.
void tellPort(const OscSettings& wanted, const std::string& address);

/// Prints a summary on stdout at the end. Any thread.
void summariseOsc(const OscStatus& osc);

/// One thread at a time.
class OscReport {
public:
    /// Prints new errors since the last call on stderr.
    void tellWrong(const OscCounts& counts);

private:
    std::uint64_t told_ = 0;
};

} // namespace physvib
