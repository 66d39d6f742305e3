// SPDX-License-Identifier: GPL-3.0-or-later
// What becomes of one piece of work.
#include "CommandLine/Sweep/Workers.h"
#include <algorithm>
#include <stdexcept>

namespace physvib {

WorkEnd WorkEnd::failedAt(std::uint64_t index, std::string_view reason) {
    WorkEnd end{index, Kind::failed, {}};
    reason = reason.substr(0, end.words.size() - 1);
    std::copy(reason.begin(), reason.end(), end.words.begin());
    return end;
}

WorkEnd WorkEnd::of(const Work& work, std::uint64_t index) {
    try {
        return work(index);
    } catch (const std::exception& fault) {
        return failedAt(index, fault.what());
    }
}

} // namespace physvib
