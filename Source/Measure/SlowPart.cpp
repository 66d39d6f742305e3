// SPDX-License-Identifier: MIT
// Removes the slow part of samples: subtracts the mean, then a triangular running mean, computed as two
// running means in a row.
#include "Measure/SlowPart.h"
#include "Core/Limits.h"
#include "Io/Text/NumberText.h"
#include <cmath>
#include <span>

namespace physvib {
namespace {

/// View of samples in which values that are not finite count as 0, as in the limiter, and large values are
/// clamped to keep running sums exact.
class Heard {
public:
    Heard(std::span<const float> samples, double fullScale)
        : samples_{samples}
        , most_{limits::maxAmplitude * fullScale} {}

    std::ptrdiff_t count() const { return std::ssize(samples_); }
    /// 0 before the first and after the last sample.
    double at(std::ptrdiff_t i) const {
        if (i < 0 || i >= count()) return 0.0;
        const double sample = samples_[static_cast<std::size_t>(i)];
        return std::isfinite(sample) ? std::clamp(sample, -most_, most_) : 0.0;
    }
    double mean() const {
        double sum = 0.0;
        for (std::ptrdiff_t i = 0; i < count(); ++i) sum += at(i);
        return sum / static_cast<double>(count());
    }

private:
    std::span<const float> samples_;
    double most_;
};

/// The triangular running mean, sample by sample.
class RunningMean {
public:
    RunningMean(const Heard& samples, double sampleRateHz)
        : samples_{samples}
        , reach_{std::lround(0.25 * SlowPart::leastSeconds * sampleRateHz)}
        , next_{-2 * reach_} {
        while (next_ < 0) next();
    }

    /// At the next sample, from the first on.
    double next() {
        ahead_ += samples_.at(next_ + 2 * reach_) - samples_.at(next_ - 1);
        behind_ += samples_.at(next_ - 1) - samples_.at(next_ - 2 * reach_ - 2);
        sum_ += ahead_ - behind_;
        ++next_;
        const auto width = static_cast<double>(2 * reach_ + 1);
        return sum_ / (width * width);
    }

private:
    Heard samples_;
    std::ptrdiff_t reach_, next_;
    double ahead_ = 0.0, behind_ = 0.0; // sums of the 2 reach_ + 1 samples around next_ + reach_ and next_ -
                                        // reach_ - 1
    double sum_ = 0.0;                  // of the 2 reach_ + 1 such sums around next_
};

} // namespace

SlowPart takeSlowPart(std::vector<float>& samples, double sampleRateHz, double fullScale) {
    SlowPart taken;
    if (!(fullScale > 0.0) || static_cast<double>(samples.size()) < SlowPart::leastSeconds * sampleRateHz)
        return taken;
    const Heard heard{samples, fullScale};
    if (const double mean = heard.mean(); std::abs(mean) >= SlowPart::leastMean * fullScale) {
        taken.mean = std::abs(mean) / fullScale;
        for (float& x : samples) x = static_cast<float>(x - mean);
    }
    double most = 0.0;
    RunningMean course{heard, sampleRateHz};
    for (std::size_t i = 0; i < samples.size(); ++i) most = std::max(most, std::abs(course.next()));
    if (most < SlowPart::leastRest * fullScale) return taken;
    taken.rest = most / fullScale;
    std::vector<float> rest(samples.size());
    RunningMean again{heard, sampleRateHz};
    for (std::size_t i = 0; i < samples.size(); ++i) rest[i] = static_cast<float>(samples[i] - again.next());
    samples = std::move(rest);
    return taken;
}

std::string SlowPart::text() const {
    if (!isAny()) return {};
    const std::string ofMean = mean != 0.0 ? "a mean of " + fixedNumber(mean, 2) : "",
                      ofRest = rest != 0.0
                                   ? "up to " + fixedNumber(rest, 2) + (mean != 0.0 ? " beside it" : "")
                                   : "";
    return "what lies below " + numberText(limits::slowestToneHz) + " Hz is not played: " + ofMean +
           (mean != 0.0 && rest != 0.0 ? ", and " : "") + ofRest + ", of full scale";
}

} // namespace physvib
