// SPDX-License-Identifier: GPL-3.0-or-later
// Tab with real-time statistics of the session: late and lost events, and processor load of rendering.
#pragma once
#include "Mixer/Output/FactList.h"
#include "Mixer/Window/TabPanel.h"
#include <deque>

namespace physvib {

class TelemetryTab final : public Tab {
public:
    explicit TelemetryTab(Desk& desk);
    void refresh(const DeskMoment& moment) override;
    int leastHeight(int width) const override { return facts_.heightFor(width); }
    void resized() override { facts_.setBounds(getLocalBounds()); }

private:
    float medianLoad() const;

    Desk& desk_;
    FactList facts_{"Telemetry", 2};
    std::deque<float> loads_; // load of recent blocks
    double shownAtMs_ = 0.0;
};

/// Status of session, device and board as text; `medianLoad` is a share of a block's duration.
std::vector<Fact> telemetryFacts(const Desk& desk, const DeskMoment& moment, float medianLoad);

} // namespace physvib
