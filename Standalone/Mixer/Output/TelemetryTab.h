// SPDX-License-Identifier: GPL-3.0-or-later
// Tab with real-time statistics of the session: late and lost events, and processor load of rendering.
#pragma once
#include "Host/Views/Look.h"
#include "Mixer/Widgets/Parts.h"
#include <deque>
#include <vector>

namespace physvib {

/// List of names and values in columns, fewer where they are narrow; redraws only on changes.
struct Fact {
    juce::String name, value;
    Shade shade = Shade::text;
    bool operator==(const Fact&) const = default;
};

class FactList final : public ReadOut {
public:
    FactList(const juce::String& title, int maxColumns);

    void set(std::vector<Fact> facts);
    const std::vector<Fact>& facts() const noexcept { return facts_; }
    int heightFor(int width) const; ///< at which all of it is seen
    void paint(juce::Graphics& g) override;

private:
    struct Places {
        int columns = 1, nameWidth = 0, rows = 0, lines = 0; // lines: of the highest column
        std::vector<int> linesOf;                            // of each fact
    };
    Places placesIn(int width) const;

    const int maxColumns_;
    std::vector<Fact> facts_;
};

class TelemetryTab final : public Tab {
public:
    explicit TelemetryTab(MixerModel& model);
    void refresh(const MixerMoment& moment) override;
    int minHeight(int width) const override { return facts_.heightFor(width); }
    void resized() override { facts_.setBounds(getLocalBounds()); }

private:
    float medianLoad() const;

    MixerModel& model_;
    FactList facts_{"Telemetry", 2};
    std::deque<float> loads_; // load of recent blocks
    double shownAtMs_ = 0.0;
};

/// Status of session, device and board as text; `medianLoad` is a share of a block's duration.
std::vector<Fact> telemetryFacts(const MixerModel& model, const MixerMoment& moment, float medianLoad);

} // namespace physvib
