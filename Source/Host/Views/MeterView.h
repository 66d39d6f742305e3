// SPDX-License-Identifier: GPL-3.0-or-later
// A bar per enchanter, in its colour, with its level in dB; what is not connected is a hatched place.
#pragma once
#include "Files/LayoutFile.h"
#include "Host/ChannelMeters.h"
#include "Host/Views/Look.h"
#include <juce_audio_basics/juce_audio_basics.h>

namespace physvib {

constexpr float meterFloorDb = -60.0f; ///< nobody feels less: full scale is some g

/// Height of that peak in a meter, 0 to 1.
inline float meterHeight(float peak) { return juce::jlimit(0.0f, 1.0f, 1.0f - juce::Decibels::gainToDecibels(peak, meterFloorDb) / meterFloorDb); }

class MeterView final : public juce::Component {
public:
    MeterView() { setOpaque(true); }

    /// M.
    void update(const ChannelMeters& meters, const LayoutDescription& layout);
    void paint(juce::Graphics& g) override;

private:
    ChannelMeters meters_;
    std::vector<juce::String> labels_;
};

} // namespace physvib
