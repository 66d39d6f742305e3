// SPDX-License-Identifier: GPL-3.0-or-later
// Between a format's entry and the instance that its wrapper makes meanwhile, on the same thread.
#pragma once

namespace physvib {

class PluginProcessor;

struct Making {
    int usualBlockFrames = 0;            ///< if the entry was told, for the instance; 0: not told
    PluginProcessor* instance = nullptr; ///< the newest, for the entry
};
Making& making() noexcept; ///< of this thread

} // namespace physvib
