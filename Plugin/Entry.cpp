// SPDX-License-Identifier: GPL-3.0-or-later
// How a format's wrapper creates a plug-in instance; each build defines its name and its buses.
#include "PluginProcessor.h"

namespace physvib {

Making& making() noexcept {
    static thread_local Making now;
    return now;
}

} // namespace physvib

juce::AudioProcessor* JUCE_CALLTYPE createPluginFilter();
juce::AudioProcessor* JUCE_CALLTYPE createPluginFilter() {
    using namespace physvib;
    auto& now = making();
    now.instance = new PluginProcessor{
        JucePlugin_Name, {BusPlan::Kind::PHYSVIB_BUSES, PHYSVIB_CHANNELS, PHYSVIB_MUSIC_PORTS > 0}};
    now.instance->expectBlocksOf(now.usualBlockFrames);
    return now.instance;
}
