// SPDX-License-Identifier: MIT
// Interface for converting rendered samples to another actuator's format (the thesis' vibration converter,
// 5.1.3), and an example: on-off steps for simple motors.
#pragma once
#include <cmath>

namespace physvib {

/// Receives a render block by block, from frame 0 on without gaps. The caller decides on which thread; in an
/// audio callback it must not block or allocate.
class VibrationConverter {
public:
    virtual ~VibrationConverter() = default;

    /// channels[channel][0..frames), 1 = an actuator's full scale. False stops the render.
    virtual bool convert(const float* const* channels, int frames) = 0;

    /// Makes a converter a consumer for renderFromStart (Core/HapticRenderer.h).
    bool operator()(const float* const* channels, int frames) { return convert(channels, frames); }
};

/// For a motor that is only on or off (a phone's own, an ERM): on for each step in which a sample exceeds the
/// threshold. Steps instead of samples, because a sine crosses any threshold hundreds of times a second,
/// while a motor reacts in tens of milliseconds.
class OnOffSteps {
public:
    static constexpr long long stepsPerSecond = 100; ///< the thesis' rendering loop
    static constexpr double thesisThreshold = 0.1;   ///< of full scale

    /// Any thread.
    OnOffSteps(int sampleRateHz, double threshold) noexcept
        : rate_{sampleRateHz}
        , threshold_{static_cast<float>(threshold)} {}

    /// One frame of one channel. `change(stepIndex, isOn)` is called for a step unlike the one before.
    template <class Change>
    void add(float sample, Change change) {
        isLoud_ = isLoud_ || std::abs(sample) > threshold_;
        if (++frame_ < endOf(step_)) return;
        if (isLoud_ != isOn_) change(step_, isLoud_);
        isOn_ = isLoud_;
        isLoud_ = false;
        ++step_;
    }
    bool isOn() const noexcept { return isOn_; }       ///< Render thread (R).
    long long steps() const noexcept { return step_; } ///< number of complete steps

private:
    long long endOf(long long step) const noexcept { return (step + 1) * rate_ / stepsPerSecond; }
    long long rate_, frame_ = 0, step_ = 0;
    float threshold_;
    bool isLoud_ = false, isOn_ = false;
};

} // namespace physvib
