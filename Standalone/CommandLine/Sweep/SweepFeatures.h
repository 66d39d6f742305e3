// SPDX-License-Identifier: GPL-3.0-or-later
// A render in numbers, for those who learn from thousands: what was struck, and what came of it in the
// samples.
#pragma once
#include "CommandLine/Render/RenderListener.h"
#include "Core/Actuators/ExposureMeter.h"
#include "Core/CollisionEvent.h"
#include "Measure/PowerSpectrum.h"
#include "Scene/LayoutFile.h"
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace physvib {

struct SweepFeature {
    std::string name;
    std::optional<double> value; ///< none: there is nothing to measure
};

/// M only.
class SweepFeatures : public RenderListener {
public:
    /// Of the features of a layout of so many channels, in their order.
    static std::vector<std::string> names(int channels);

    void begin(const LoadedRender& job) override;
    void take(const float* const* channels, int frames) override;

    /// When the render is over: all features, once.
    std::vector<SweepFeature> finish();

private:
    void prepare(const LayoutDescription& layout, int sampleRateHz, double seconds);
    void measureEvents(std::span<const CollisionEvent> events);
    void measureSpectrum();
    void measureLevels();
    void add(std::string name, std::optional<double> value) { features_.push_back({std::move(name), value}); }

    std::vector<SweepFeature> features_;
    LayoutDescription layout_;
    std::unique_ptr<ExposureMeter> meter_;
    std::optional<PowerSpectrum> spectrum_;
    double seconds_ = 1.0;
};

} // namespace physvib
