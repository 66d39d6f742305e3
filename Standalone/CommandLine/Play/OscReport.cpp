// SPDX-License-Identifier: GPL-3.0-or-later
// Formats OSC counters and the last error.
#include "CommandLine/Play/OscReport.h"
#include "System/ExitCode.h"
#include <iostream>
#include <sstream>
#include <utility>

namespace physvib {
namespace {

std::string summary(const OscCounts& c) {
    std::ostringstream words;
    words << c.packets << " packets, " << c.bad << " bad, " << c.lost << " lost; " << c.messages
          << " messages, " << c.refused << " refused, " << c.late << " late, " << c.held
          << " replies held back";
    return words.str();
}

} // namespace

void tellPort(const OscSettings& wanted, const std::string& address) {
    const std::string port = std::to_string(*wanted.port);
    const bool isWanted = *wanted.port == 0 || address.substr(address.rfind(':') + 1) == port;
    tell(std::string("OSC: listening at ")
             .append(address)
             .append(isWanted ? "" : "; " + port + " is another program's"));
}

void summariseOsc(const OscStatus& osc) {
    if (!osc.address.empty()) std::cout << "OSC at " << osc.address << ": " << summary(osc.counts) << '\n';
    if (osc.sent + osc.unsent > 0)
        std::cout << "OSC out: " << osc.sent << " sent, " << osc.unsent << " not taken\n";
}

void OscReport::tellWrong(const OscCounts& counts) {
    const std::uint64_t wrong = counts.wrong() + counts.late + counts.lost + counts.held;
    if (std::exchange(told_, wrong) == wrong) return;
    tell(std::string("OSC: ")
             .append(summary(counts))
             .append(counts.fault.empty() ? "" : "; the last error: ")
             .append(counts.fault));
}

} // namespace physvib
