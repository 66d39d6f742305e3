// SPDX-License-Identifier: GPL-3.0-or-later
// What a port of OSC has done, in lines.
#pragma once
#include "Host/Osc/OscPort.h"

namespace physvib {

/// Where it listens, on stderr; that the wanted port is another's, if it is. Any thread.
void tellPort(const OscSettings& wanted, const std::string& address);

/// At the end, on stdout. Any thread.
void summariseOsc(const OscStatus& osc);

/// One thread.
class OscReport {
public:
    /// On stderr, if something has gone wrong since the last call.
    void tellWrong(const OscCounts& counts);

private:
    std::uint64_t told_ = 0;
};

} // namespace physvib
