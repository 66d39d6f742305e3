// SPDX-License-Identifier: GPL-3.0-or-later
// Numeric features of a render for data analysis and machine learning, from its events and samples.
#pragma once
#include "CommandLine/Render/RenderListener.h"
#include "Core/Actuators/Exposure.h"
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
    std::optional<double> value; ///< nullopt if it cannot be measured
};

/// Message thread only.
class SweepFeatures : public RenderListener {
public:
    /// Names of the features of a layout with that number of channels, in order.
    static std::vector<std::string> names(int channels);

    void begin(const LoadedRender& job) override;
    void take(const float* const* channels, int frames) override;

    /// All features; to be called once, at the end of the render.
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
