// SPDX-License-Identifier: MIT
// How the energy of a long vibration is spread over frequencies, while its samples go by.
#pragma once
#include <memory>
#include <vector>

namespace physvib {

/// Welch's mean of short spectra, by Hann windows that overlap by half; of all channels together. What no
/// hand feels (above keptRateHz / 2) is not told apart: faster samples are means of a few. M only
/// (allocates).
class PowerSpectrum {
public:
    static constexpr int keptRateHz = 8000; ///< at least, where there are as many

    /// Channels 1 or more; rates of limits::.
    PowerSpectrum(int sampleRateHz, int channels);
    ~PowerSpectrum();
    PowerSpectrum(PowerSpectrum&&) noexcept;

    /// The next frames of every channel.
    void add(const float* const* channels, int frames);

    /// Nothing comes any more. Power of bins 0 to n/2, in shares of the whole; all 0 of silence. Once.
    std::vector<double> finish();

    /// Bin k is k binHz: 8 to 16 Hz.
    double binHz() const noexcept;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace physvib
