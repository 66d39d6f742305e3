// SPDX-License-Identifier: GPL-3.0-or-later
// What every enchanter has played in the last second, a lane each.
#pragma once
#include "Mixer/Desk.h"
#include "Mixer/Parts.h"

namespace physvib {

class ScopeView final : public juce::Component {
public:
    explicit ScopeView(Desk& desk);

    void refresh();
    void paint(juce::Graphics& g) override;

private:
    bool isQuiet() const;
    void drawLane(juce::Graphics& g, juce::Rectangle<int> lane, int channel) const;

    Desk& desk_;
    std::int64_t shown_ = -1;
    bool wasQuiet_ = false;
};

} // namespace physvib
