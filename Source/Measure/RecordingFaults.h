// SPDX-License-Identifier: MIT
// Checks whether a recording can be measured: too short, not finite, clipped. Message thread (M) only.
#pragma once
#include "Io/Text/NumberText.h"
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace physvib {

inline std::string placeOf(std::size_t sample, double rateHz) {
    return " at " + fixedNumber(static_cast<double>(sample) / rateHz, 4) + " s";
}

/// Empty, or the error that the recording is clipped: three equal samples at the peak between steep flanks.
/// Rounding flattens peaks too, but then the next sample is only a few steps lower; `step` is the smallest
/// difference in the recording.
inline std::string clippingFault(const std::vector<float>& x, double rateHz) {
    float peak = 0.0f, step = HUGE_VALF;
    for (std::size_t i = 0; i < x.size(); ++i) {
        peak = std::max(peak, std::abs(x[i]));
        if (i > 0 && x[i] != x[i - 1]) step = std::min(step, std::abs(x[i] - x[i - 1]));
    }
    for (std::size_t i = 0; i + 2 < x.size(); ++i) {
        if (std::abs(x[i]) < peak || x[i + 1] != x[i] || x[i + 2] != x[i]) continue;
        std::size_t after = i + 3;
        while (after < x.size() && x[after] == x[i]) ++after;
        const float before = i > 0 ? std::abs(x[i] - x[i - 1]) : 0.0f,
                    behind = after < x.size() ? std::abs(x[i] - x[after]) : 0.0f;
        if (std::max(before, behind) > 8.0f * step)
            return "expected a recording that is not clipped, found " + std::to_string(after - i) +
                   " equal samples at its peak" + placeOf(i, rateHz);
        i = after;
    }
    return {};
}

inline bool isSilent(const std::vector<float>& x) {
    return std::ranges::all_of(x, [&](float s) { return s == x.front(); });
}

inline std::string notFinite(float x, std::size_t sample, double rateHz) {
    return "expected finite samples, found " + std::string(std::isnan(x) ? "NaN" : "infinity") +
           placeOf(sample, rateHz);
}

/// Empty, or the error that it is too short or has NaN, infinite or huge samples.
inline std::string recordingFault(const std::vector<float>& x, double rateHz, double shortestSeconds) {
    if (static_cast<double>(x.size()) < shortestSeconds * rateHz)
        return "expected at least " + numberText(shortestSeconds) + " s, found " + std::to_string(x.size()) +
               (x.size() == 1 ? " sample" : " samples");
    const auto bad = std::ranges::find_if(x, [](float s) { return !std::isfinite(s) || std::abs(s) > 1e6f; });
    return bad == x.end() ? "" : notFinite(*bad, static_cast<std::size_t>(bad - x.begin()), rateHz);
}

} // namespace physvib
