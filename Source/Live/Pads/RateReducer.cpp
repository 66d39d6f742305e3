// SPDX-License-Identifier: MIT
// One kernel for each position that an output frame can have between two input frames.
#include "Live/Pads/RateReducer.h"
#include "Core/PortableMath.h"
#include <cmath>
#include <numbers>
#include <numeric>

namespace physvib {
namespace {

constexpr double zeros = 6.0, cutOff = 0.4833; // zeros on each side; share of the lower rate

/// Weights for a centre that lies `before` input frames before the newest one.
std::vector<float> kernelFor(double before, std::size_t taps, double cyclesPerFrame) {
    std::vector<double> weights(taps);
    const double half = zeros / (2.0 * cyclesPerFrame);
    for (std::size_t k = 0; k < taps; ++k) {
        const double t = static_cast<double>(taps - 1 - k) - before,
                     x = 2.0 * std::numbers::pi * cyclesPerFrame * t;
        const double window =
            std::abs(t) < half ? 0.5 + 0.5 * portable::cos(std::numbers::pi * t / half) : 0.0;
        weights[k] = window * (x == 0.0 ? 1.0 : portable::sin(x) / x);
    }
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    std::vector<float> kernel;
    for (const double weight : weights) kernel.push_back(static_cast<float>(weight / sum));
    return kernel;
}

} // namespace

RateReducer::RateReducer(int inHz, int outHz)
    : in_{inHz / std::gcd(inHz, outHz)}
    , out_{outHz / std::gcd(inHz, outHz)} {
    const double cyclesPerFrame = cutOff * outHz / inHz, half = zeros / (2.0 * cyclesPerFrame);
    const auto taps = static_cast<std::size_t>(2.0 * std::ceil(half)) + 2;
    for (int phase = 0; phase < out_; ++phase)
        kernels_.push_back(kernelFor(half + static_cast<double>(phase) / out_, taps, cyclesPerFrame));
    ring_.resize(taps);
}

// An output frame is due at a position up to one frame before the newest input frame.
void RateReducer::push(const CoilFrame& frame) {
    ring_[oldest_] = frame;
    oldest_ = (oldest_ + 1) % ring_.size();
    if (due_ <= 0) {
        ready_.push_back(filtered(static_cast<std::size_t>(-due_)));
        due_ += in_;
    }
    due_ -= out_;
}

CoilFrame RateReducer::filtered(std::size_t phase) const {
    const std::vector<float>& kernel = kernels_[phase];
    CoilFrame sum{};
    for (std::size_t k = 0, at = oldest_; k < kernel.size(); ++k, at = at + 1 == ring_.size() ? 0 : at + 1)
        for (std::size_t side = 0; side < 2; ++side) sum[side] += kernel[k] * ring_[at][side];
    return sum;
}

CoilFrame RateReducer::pull() {
    if (ready_.empty()) return {};
    const CoilFrame frame = ready_.front();
    ready_.pop_front();
    return frame;
}

} // namespace physvib
