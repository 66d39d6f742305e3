// SPDX-License-Identifier: MIT
// Evaluates a piecewise linear curve and its integral at increasing times, without repeated searches.
#pragma once
#include "Formats/Clip.h"
#include <cstddef>
#include <span>

namespace physvib {

/// For a curve of at least one point; the requested times must increase. Any thread.
class CurveWalk {
public:
    explicit CurveWalk(std::span<const ClipPoint> curve)
        : curve_{curve} {}

    double value(double seconds) {
        goTo(seconds);
        if (next_ == 0) return curve_.front().value;
        const ClipPoint& from = curve_[next_ - 1];
        return next_ == curve_.size() ? from.value : from.value + slope() * (seconds - from.seconds);
    }
    /// From 0 to `seconds`.
    double integral(double seconds) {
        goTo(seconds);
        if (next_ == 0) return curve_.front().value * seconds;
        const ClipPoint& from = curve_[next_ - 1];
        const double t = seconds - from.seconds;
        return before_ + t * (from.value + (next_ == curve_.size() ? 0.0 : 0.5 * slope() * t));
    }

private:
    void goTo(double seconds) {
        for (; next_ < curve_.size() && curve_[next_].seconds <= seconds; ++next_) {
            const ClipPoint& to = curve_[next_];
            before_ += next_ == 0 ? to.value * to.seconds
                                  : 0.5 * (curve_[next_ - 1].value + to.value) *
                                        (to.seconds - curve_[next_ - 1].seconds);
        }
    }
    double slope() const {
        const ClipPoint& from = curve_[next_ - 1];
        return (curve_[next_].value - from.value) / (curve_[next_].seconds - from.seconds);
    }

    std::span<const ClipPoint> curve_;
    std::size_t next_ = 0; // first later point
    double before_ = 0.0;  // integral up to the point before it
};

} // namespace physvib
