// SPDX-License-Identifier: GPL-3.0-or-later
// The total output: level, limiter, ceiling; as a strip, or in a row beside the world. Levels in g.
#pragma once
#include "Host/Views/StripParts.h"
#include "Mixer/Model/MixerModel.h"

namespace physvib {

/// Felt level in g of a strip's peak after the master level. M.
double gOf(const MixerModel& model, std::size_t strip, float peak);
/// The most that can be felt of a strip, by its ceiling, in g. M.
double maxG(const MixerModel& model, std::size_t strip);

/// Strip of the total output: level, limiter, ceiling.
class MasterStrip final : public juce::Component {
public:
    static constexpr int width = 90, flatWords = 112;
    static constexpr int metersTop = 48; ///< of a strip, too

    /// `isFlat`: in one row without a meter, for where there are no strips.
    explicit MasterStrip(MixerModel& model, bool isFlat = false);
    /// A warning in place of the most that can come, in a row; empty: none. Before mixChanged().
    void setRemark(const juce::String& remark) { remark_ = remark; }
    const juce::String& remark() const noexcept { return remark_; }
    void mixChanged();
    void refresh(const MixerMoment& moment);
    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    void paintFlat(juce::Graphics& g) const;
    juce::String limiterWords() const {
        return (limiter_.isGuard() ? "guard " : "limiter ") + limiter_.decibels();
    }
    double mostG() const;

    MixerModel& model_;
    const bool isFlat_;
    juce::String remark_;
    PeakMeter meter_{"Master level"};
    LimiterBar limiter_;
    Fader fader_;
    juce::Rectangle<int> limiterText_, ceilingName_, ceiling_;
};

} // namespace physvib
