// SPDX-License-Identifier: MIT
// Power spectrum of a long vibration, accumulated while its samples are rendered.
#pragma once
#include <memory>
#include <vector>

namespace physvib {

/// Welch's method with Hann windows that overlap by half, summed over all channels. Frequencies above
/// keptRateHz / 2, which cannot be felt, are not resolved: several samples are averaged to one. Message
/// thread (M) only (allocates).
class PowerSpectrum {
public:
    static constexpr int keptRateHz = 8000; ///< minimum rate after averaging, if the sample rate is as high

    /// One channel or more; sample rates that limits:: allows.
    PowerSpectrum(int sampleRateHz, int channels);
    ~PowerSpectrum();
    PowerSpectrum(PowerSpectrum&&) noexcept;

    /// The next frames of every channel.
    void add(const float* const* channels, int frames);

    /// Ends the input. Power of bins 0 to n/2 as shares of the total; all 0 for silence. Call once.
    std::vector<double> finish();

    /// Bin k is at k binHz: 8 to 16 Hz apart.
    double binHz() const noexcept;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace physvib
