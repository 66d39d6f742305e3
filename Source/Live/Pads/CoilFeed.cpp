// SPDX-License-Identifier: MIT
// Makes reports of a session's samples. The device's clock determines their number, a steady clock the time
// of each, because blocks come in bursts and a controller needs reports at an even pace.
#include "Live/Pads/CoilFeed.h"
#include "Core/PortableMath.h"
#include <cmath>
#include <numbers>
#include <numeric>

namespace physvib {

namespace {

constexpr double rampSeconds = 0.005;         // of the master level, as on a device; within a report
constexpr double paceSeconds = 2.0;           // interval for which the reserve is observed
constexpr double reserveSeconds = 0.0015;     // frames that should wait, for blocks that come late
constexpr std::int64_t maxStarvedPeriods = 4; // periods without samples until silence is sent
constexpr int defaultRateHz = 48000;

constexpr double zeroCrossings = 6.0, cutOff = 0.4833; // zeros on each side; share of the lower rate

/// Weights for a centre that lies `delayFrames` input frames before the newest one.
std::vector<float> makeKernel(double delayFrames, std::size_t taps, double cyclesPerFrame) {
    std::vector<double> weights(taps);
    const double half = zeroCrossings / (2.0 * cyclesPerFrame);
    for (std::size_t k = 0; k < taps; ++k) {
        const double frame = static_cast<double>(taps - 1 - k) - delayFrames,
                     x = 2.0 * std::numbers::pi * cyclesPerFrame * frame;
        const double window =
            std::abs(frame) < half ? 0.5 + 0.5 * portable::cos(std::numbers::pi * frame / half) : 0.0;
        weights[k] = window * (x == 0.0 ? 1.0 : portable::sin(x) / x);
    }
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    std::vector<float> kernel;
    for (const double weight : weights) kernel.push_back(static_cast<float>(weight / sum));
    return kernel;
}

} // namespace

CoilFeed::CoilFeed(const HidFeedKind& kind, const CoilFormat& format, const PhantomPanner& panner)
    : kind_{kind}
    , format_{format}
    , reducer_{defaultRateHz, format.rateHz}
    , reducedHz_{defaultRateHz} {
    coilGains_.write(computeCoilGains(panner.layout()));
    begin();
}

CoilFeed::CoilGains CoilFeed::computeCoilGains(const ActuatorLayout& layout) noexcept {
    CoilGains sides{static_cast<std::size_t>(layout.count), {}};
    const auto places = std::span{layout.places}.first(static_cast<std::size_t>(layout.count));
    const auto [left, right] = std::ranges::minmax(places, {}, &ActuatorPlace::xMetres);
    const double width = right.xMetres - left.xMetres;
    for (std::size_t j = 0; j < places.size(); ++j) {
        const double share = width > 0.0 ? (places[j].xMetres - left.xMetres) / width : 0.5,
                     angle = 0.5 * std::numbers::pi * share;
        sides.gains[j] = {share < 1.0 ? static_cast<float>(portable::cos(angle)) : 0.0f,
                          static_cast<float>(portable::sin(angle))};
    }
    return sides;
}

void CoilFeed::onControl(const RenderControl& control) noexcept {
    if (control.panner != nullptr) coilGains_.write(computeCoilGains(control.panner->layout()));
}

void CoilFeed::onBlock(const RenderedBlock& block) noexcept PHYSVIB_NONBLOCKING {
    const CoilGains& sides = coilGains_.read();
    const std::size_t count = std::min(sides.count, static_cast<std::size_t>(block.count));
    rateHz_.store(block.sampleRateHz, std::memory_order_relaxed);
    for (int n = 0; n < block.frames; ++n)
        samples_.pushInPlace([&](CoilFrame& frame) noexcept {
            frame = {};
            for (std::size_t j = 0; j < count; ++j)
                for (std::size_t side = 0; side < 2; ++side)
                    frame[side] += sides.gains[j][side] * block.channels[j][n];
        });
}

void CoilFeed::begin() {
    for (CoilFrame frame; samples_.pop(frame);) {
    }
    reducer_ = RateReducer{reducedHz_, format_.rateHz};
    levelRamp_.prepare(format_.rateHz, rampSeconds, 0.0f);
    guard_.begin(std::string{kind_.name}, {0, 1}, format_.rateHz);
    for (const int side : {0, 1}) guard_.setChannel(side, side);
    dueNs_ = 0;
    minFramesLeft_ = SIZE_MAX, reportCount_ = 0;
    isPaceRaised_ = isStarved_ = false;
}

void CoilFeed::drainQueue() {
    if (const int newRateHz = rateHz_.load(std::memory_order_relaxed);
        newRateHz != reducedHz_ && newRateHz > format_.rateHz) {
        reducedHz_ = newRateHz;
        reducer_ = RateReducer{newRateHz, format_.rateHz};
    }
    for (CoilFrame frame; samples_.pop(frame);) reducer_.push(frame);
}

std::optional<PadReport> CoilFeed::next(std::int64_t nowNs, std::int64_t, float level) {
    drainQueue();
    if (nowNs < dueNs_) return {};
    if (reducer_.size() < static_cast<std::size_t>(format_.frames)) {
        if (!isStarved_) dueNs_ = std::max(dueNs_, nowNs - periodNs());
        isStarved_ = true;
        if (isSilent_ || nowNs - dueNs_ < maxStarvedPeriods * periodNs()) return {};
        return silentReport(); // the device has stopped
    }
    // late samples delay all later reports; a late thread does not
    dueNs_ = isStarved_ || dueNs_ == 0 ? nowNs : std::max(dueNs_, nowNs - periodNs());
    dueNs_ += isPaceRaised_ ? periodNs() * 999 / 1000 : periodNs();
    isStarved_ = false;
    const PadReport report = compose(level);
    adjustPace();
    return report;
}

void CoilFeed::adjustPace() {
    const double rate = format_.rateHz, frames = format_.frames;
    minFramesLeft_ = std::min(minFramesLeft_, reducer_.size());
    if (frames * static_cast<double>(++reportCount_) < paceSeconds * rate) return;
    isPaceRaised_ = static_cast<double>(minFramesLeft_) > reserveSeconds * rate;
    for (; static_cast<double>(minFramesLeft_) > 2.0 * frames; --minFramesLeft_, ++skipped_)
        reducer_.pull(); // drops samples that gathered while this thread paused
    minFramesLeft_ = SIZE_MAX, reportCount_ = 0;
}

PadReport CoilFeed::compose(float level) {
    std::array<std::vector<float>, 2> sides;
    for (int n = 0; n < format_.frames; ++n) {
        const CoilFrame frame = reducer_.pull();
        for (std::size_t side = 0; side < 2; ++side) sides[side].push_back(frame[side]);
    }
    std::array<float*, limits::maxActuators> io{sides[0].data(), sides[1].data()};
    level > 0.0f ? levelRamp_.moveTo(level) : levelRamp_.moveTo(0.0f, format_.frames / 2);
    levelRamp_.apply(io.data(), 2, format_.frames);
    guard_.process(io.data(), format_.frames);
    std::vector<CoilFrame> frames;
    for (std::size_t n = 0; n < sides[0].size(); ++n) frames.push_back({sides[0][n], sides[1][n]});
    isSilent_ = std::ranges::all_of(
        frames, [](const CoilFrame& frame) { return frame[0] == 0.0f && frame[1] == 0.0f; });
    return format_.encode(frames, reportNumber_++);
}

PadReport CoilFeed::silentReport() {
    isSilent_ = true;
    const std::vector<CoilFrame> silence(static_cast<std::size_t>(format_.frames));
    return format_.encode(silence, reportNumber_++);
}

double CoilFeed::maxDelaySeconds() const noexcept { return (1.5 * format_.frames + 6.2) / format_.rateHz; }

// One kernel for each position that an output frame can have between two input frames.

RateReducer::RateReducer(int inHz, int outHz)
    : inRate_{inHz / std::gcd(inHz, outHz)}
    , outRate_{outHz / std::gcd(inHz, outHz)} {
    const double cyclesPerFrame = cutOff * outHz / inHz, half = zeroCrossings / (2.0 * cyclesPerFrame);
    const auto taps = static_cast<std::size_t>(2.0 * std::ceil(half)) + 2;
    for (int phase = 0; phase < outRate_; ++phase)
        kernels_.push_back(makeKernel(half + static_cast<double>(phase) / outRate_, taps, cyclesPerFrame));
    ring_.resize(taps);
}

// An output frame is due at a position up to one frame before the newest input frame.
void RateReducer::push(const CoilFrame& frame) {
    ring_[oldest_] = frame;
    oldest_ = (oldest_ + 1) % ring_.size();
    if (untilDue_ <= 0) {
        outputFrames_.push_back(filtered(static_cast<std::size_t>(-untilDue_)));
        untilDue_ += inRate_;
    }
    untilDue_ -= outRate_;
}

CoilFrame RateReducer::filtered(std::size_t phase) const {
    const std::vector<float>& kernel = kernels_[phase];
    CoilFrame sum{};
    for (std::size_t k = 0, i = oldest_; k < kernel.size(); ++k, i = i + 1 == ring_.size() ? 0 : i + 1)
        for (std::size_t side = 0; side < 2; ++side) sum[side] += kernel[k] * ring_[i][side];
    return sum;
}

CoilFrame RateReducer::pull() {
    if (outputFrames_.empty()) return {};
    const CoilFrame frame = outputFrames_.front();
    outputFrames_.pop_front();
    return frame;
}

} // namespace physvib
