// SPDX-License-Identifier: MIT
// Intermediate form of an .ahap file between its JSON and the clip: events, and the curves that control all
// of them.
#pragma once
#include "Formats/Clip.h"
#include "Formats/FrequencyScale.h"
#include "Formats/TimeOrder.h"
#include <vector>

namespace physvib {

/// The values of a dynamic parameter over time: consecutive curves and steps.
class AhapControl {
public:
    AhapControl(double before, double least)
        : before_{before}
        , least_{least} {}

    double before() const noexcept { return before_; } ///< value without curves

    /// Values out of range are clamped.
    void add(std::vector<ClipPoint> points) {
        for (ClipPoint& p : points) p.value = std::clamp(p.value, least_, 1.0);
        if (!points.empty()) pieces_.push_back(std::move(points));
    }
    /// All pieces as one curve: each holds until the next begins.
    std::vector<ClipPoint> curve() {
        sortByTime(pieces_, [](const auto& piece) { return piece.front().seconds; });
        std::vector<ClipPoint> all{{0.0, before_}};
        for (const auto& piece : pieces_) {
            const double start = piece.front().seconds, held = valueAt(all, start);
            while (!all.empty() && all.back().seconds > start) all.pop_back();
            all.push_back({start, held});
            all.insert(all.end(), piece.begin(), piece.end());
        }
        return all;
    }

private:
    double before_, least_;
    std::vector<std::vector<ClipPoint>> pieces_;
};

struct AhapEvent {
    double start, seconds; ///< 0: a transient
    double intensity, sharpness;
};

struct AhapPattern {
    std::vector<AhapEvent> events{};
    AhapControl intensity{1.0, 0.0}, sharpness{0.0, -1.0};
};

/// Converts events to waves and transients, with the curves that apply while they last. Throws JsonError if
/// the result is too large. Any thread.
Clip clipOf(AhapPattern pattern, const FrequencyScale& scale);

} // namespace physvib
