// SPDX-License-Identifier: MIT
// Writes an envelope as .ahap: a continuous event per piece, and two curves for intensity and sharpness.
// Events have full intensity and no sharpness, except where a transient sounds: there the event has the
// level, and the curves begin at 1 and 0.
#include "Formats/AhapFile.h"
#include "Formats/AhapPieces.h"
#include "Io/Json/JsonLines.h"
#include <cmath>

namespace physvib {
namespace {

constexpr std::size_t mostCurvePoints = 16; // per curve on a phone
constexpr double intensityTolerance = 0.002, sharpnessTolerance = 0.001;
constexpr double steepSeconds = 0.001; // a faster change is felt as a step
constexpr int rootLines = 6;           // lines per line of amplitude, because its square root is curved

OrderedJson parametersJson(double intensity, double sharpness) {
    return OrderedJson::array(
        {{{"ParameterID", "HapticIntensity"}, {"ParameterValue", shortened(intensity)}},
         {{"ParameterID", "HapticSharpness"}, {"ParameterValue", shortened(sharpness)}}});
}

/// Intensities in shares of `full`. Points are closer where the amplitude is small, because its root is steep
/// there.
std::vector<ClipPoint> intensitiesOf(std::span<const EnvelopePoint> envelope, double full) {
    std::vector<ClipPoint> curve;
    for (std::size_t i = 0; i < envelope.size(); ++i) {
        const EnvelopePoint& p = envelope[i];
        const double intensity = std::sqrt(std::min(1.0, p.amplitude));
        const bool isLine = i > 0 && p.seconds - envelope[i - 1].seconds > steepSeconds;
        for (int k = 1; isLine && k < rootLines; ++k) { // even steps of intensity
            const EnvelopePoint& from = envelope[i - 1];
            const double root = std::sqrt(std::min(1.0, from.amplitude)),
                         value = root + (intensity - root) * k / rootLines;
            if (p.amplitude != from.amplitude)
                curve.push_back({from.seconds + (p.seconds - from.seconds) *
                                                    std::clamp((value * value - from.amplitude) /
                                                                   (p.amplitude - from.amplitude),
                                                               0.0, 1.0),
                                 value});
        }
        curve.push_back({p.seconds, intensity});
    }
    for (ClipPoint& p : curve) p.value = std::min(1.0, p.value / full);
    return thinned(curve, intensityTolerance);
}

/// The events in the order in which they are added, and the curves' values after the last one.
class Pattern {
public:
    explicit Pattern(const FrequencyScale& scale)
        : scale_{scale} {}

    void add(const AhapPiece& piece) {
        const double start = shortened(piece.points.front().seconds),
                     seconds = shortened(shortened(piece.points.back().seconds) - start);
        if (!(seconds > 0.0)) return;
        const double intensity =
            piece.level ? shortened(std::sqrt(std::min(1.0, piece.level->amplitude))) : 1.0;
        const double sharpness = piece.level ? shortened(scale_.share(piece.level->frequencyHz)) : 0.0;
        if (intensity > 0.0)
            json_.push_back({{"Event",
                              {{"Time", start},
                               {"EventType", "HapticContinuous"},
                               {"EventDuration", seconds},
                               {"EventParameters", parametersJson(intensity, sharpness)}}}});
        addCurves("HapticIntensityControl",
                  intensity > 0.0 ? intensitiesOf(piece.points, intensity) : constant(piece, 1.0),
                  intensity_);
        addCurves("HapticSharpnessControl",
                  intensity > 0.0 ? sharpnessesOf(piece.points, sharpness) : constant(piece, 0.0),
                  sharpness_);
    }

    void add(const ClipTransient& t) {
        json_.push_back({{"Event",
                          {{"Time", shortened(t.seconds)},
                           {"EventType", "HapticTransient"},
                           {"EventParameters", parametersJson(std::sqrt(std::clamp(t.amplitude, 0.0, 1.0)),
                                                              scale_.share(t.frequencyHz))}}}});
    }

    OrderedJson take() { return std::move(json_); }

private:
    static std::vector<ClipPoint> constant(const AhapPiece& piece, double value) {
        return {{piece.points.front().seconds, value}, {piece.points.back().seconds, value}};
    }

    std::vector<ClipPoint> sharpnessesOf(std::span<const EnvelopePoint> envelope, double before) const {
        std::vector<ClipPoint> curve;
        for (const EnvelopePoint& p : envelope)
            curve.push_back({p.seconds, scale_.share(p.frequencyHz) - before});
        return thinned(curve, sharpnessTolerance);
    }

    /// Writes as many curves as necessary; each begins with the last point of the one before. None if the
    /// curve only continues the value `isNow`.
    void addCurves(const char* parameter, std::vector<ClipPoint> curve, double& isNow) {
        for (ClipPoint& p : curve) p = {shortened(p.seconds), shortened(p.value)};
        if (std::ranges::all_of(curve, [&](const ClipPoint& p) { return p.value == isNow; })) return;
        isNow = curve.back().value;
        for (std::size_t from = 0; from + 1 < curve.size(); from += mostCurvePoints - 1) {
            const double start = curve[from].seconds;
            OrderedJson points = OrderedJson::array();
            for (std::size_t i = from; i < std::min(from + mostCurvePoints, curve.size()); ++i)
                points.push_back(
                    {{"Time", shortened(curve[i].seconds - start)}, {"ParameterValue", curve[i].value}});
            json_.push_back({{"ParameterCurve",
                              {{"ParameterID", parameter},
                               {"Time", start},
                               {"ParameterCurveControlPoints", std::move(points)}}}});
        }
    }

    FrequencyScale scale_;
    OrderedJson json_ = OrderedJson::array();
    double intensity_ = 1.0, sharpness_ = 0.0;
};

} // namespace

std::string ahapText(const ClipChannel& channel, std::string_view title, const FrequencyScale& scale) {
    Pattern pattern{scale};
    for (const AhapPiece& piece : ahapPieces(channel)) pattern.add(piece);
    for (const ClipTransient& t : channel.transients) pattern.add(t);
    return jsonLines({{"Version", 1},
                      {"Metadata", {{"Project", title}, {"Created", "PhysVib"}}},
                      {"Pattern", pattern.take()}});
}

} // namespace physvib
