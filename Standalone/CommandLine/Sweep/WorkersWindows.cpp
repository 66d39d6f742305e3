// SPDX-License-Identifier: GPL-3.0-or-later
// Windows, where a process cannot become two: one piece after the other, here. Several programs share a sweep
// by --part.
#if defined(_WIN32)
#include "CommandLine/Sweep/Workers.h"

namespace physvib {

void shareWork(int, std::uint64_t count, const Work& work, const std::function<void(const WorkEnd&)>& hear) {
    for (std::uint64_t index = 0; index < count; ++index) hear(WorkEnd::of(work, index));
}

} // namespace physvib
#endif
