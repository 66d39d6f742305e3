// SPDX-License-Identifier: GPL-3.0-or-later
// The function by which a format's wrapper makes an instance; each build defines its name and its buses.
#include "PluginProcessor.h"

juce::AudioProcessor* JUCE_CALLTYPE createPluginFilter();
juce::AudioProcessor* JUCE_CALLTYPE createPluginFilter() {
    return new physvib::PluginProcessor{JucePlugin_Name, {physvib::BusPlan::Kind::PHYSVIB_BUSES, PHYSVIB_CHANNELS}};
}
