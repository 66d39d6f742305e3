// SPDX-License-Identifier: GPL-3.0-or-later
// How well the session keeps up: what came late or was lost, and what rendering costs.
#pragma once
#include "Mixer/Output/FactList.h"
#include "Mixer/Window/TabPanel.h"
#include <deque>

namespace physvib {

class TelemetryTab final : public Tab {
public:
    explicit TelemetryTab(Desk& desk);
    void refresh(const DeskMoment& moment) override;
    void resized() override { facts_.setBounds(getLocalBounds()); }

private:
    float medianLoad() const;

    Desk& desk_;
    FactList facts_{"Telemetry", 2};
    std::deque<float> loads_; // of the blocks that were looked at
    double shownAtMs_ = 0.0;
};

/// What a session, its device and its board say, in words; `medianLoad` is a share of a block.
std::vector<Fact> telemetryFacts(const Desk& desk, const DeskMoment& moment, float medianLoad);

} // namespace physvib
