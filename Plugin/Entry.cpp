// SPDX-License-Identifier: GPL-3.0-or-later
// Creates a plug-in instance for a format's wrapper.
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
    const auto& ours = moduleIdentity;
    creation.instance = new PluginProcessor{ours.name, {ours.buses, ours.channels, ours.musicPorts > 0}};
    creation.instance->setNominalBlockFrames(creation.nominalBlockFrames);
    return creation.instance;
}
