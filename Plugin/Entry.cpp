// SPDX-License-Identifier: GPL-3.0-or-later
// Creates a plug-in instance for a format's wrapper; each build defines its name and its buses.
#include "PluginProcessor.h"

namespace physvib {

InstanceCreation& instanceCreation() noexcept {
    static thread_local InstanceCreation creation;
    return creation;
}

} // namespace physvib

juce::AudioProcessor* JUCE_CALLTYPE createPluginFilter();
juce::AudioProcessor* JUCE_CALLTYPE createPluginFilter() {
    using namespace physvib;
    auto& creation = instanceCreation();
    creation.instance = new PluginProcessor{
        JucePlugin_Name, {BusPlan::Kind::PHYSVIB_BUSES, PHYSVIB_CHANNELS, PHYSVIB_MUSIC_PORTS > 0}};
    creation.instance->setNominalBlockFrames(creation.nominalBlockFrames);
    return creation.instance;
}
