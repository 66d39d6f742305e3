// SPDX-License-Identifier: MIT
// Writes an envelope as .ahap: a continuous event per piece, and two curves for intensity and sharpness.
// Events have full intensity and no sharpness, except where a transient sounds: there the event has the
// level, and the curves begin at 1 and 0: on a phone a curve affects every event of its pattern, and one at
// 0.1 would reduce a transient beside it to a tenth. Pieces end at silences between transients; after a
// transient wherever the envelope rises or halves.
#include "Formats/ClipFile.h"
#include "Formats/EnvelopeFile.h"
#include "Io/Json/JsonText.h"
#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

namespace physvib {
namespace {

/// A stretch of a channel's envelope: one continuous event.
struct AhapPiece {
    std::vector<EnvelopePoint> points;    ///< two or more
    std::optional<EnvelopePoint> level{}; ///< of its event beside a transient; else full intensity, not sharp
};

constexpr double silenceSeconds = 0.05; // a longer silence ends an event
constexpr double rounding = 1e-9;       // of a line's values
constexpr double minPieceSeconds = 0.001;
constexpr double leadSeconds = 0.0004; // curves are neutral this long before a transient
constexpr double maxChange = 2.0; // of the amplitude within a piece: curves reduce a transient's end by 3 dB

/// Divides lines that are longer than an event may be.
std::vector<EnvelopePoint> cutToLength(std::span<const EnvelopePoint> envelope) {
    std::vector<EnvelopePoint> cut;
    for (const EnvelopePoint& p : envelope) {
        const EnvelopePoint from = cut.empty() ? p : cut.back();
        const int pieces =
            static_cast<int>(std::ceil((p.seconds - from.seconds) / (0.5 * limits::maxAhapEventSeconds)));
        for (int k = 1; k < pieces; ++k)
            cut.push_back(interpolated(from, p, static_cast<double>(k) / pieces));
        cut.push_back(p);
    }
    return cut;
}

/// Index of the end of the stretch that begins at `from`: before a silence, or while it is short enough.
std::size_t stretchEnd(const std::vector<EnvelopePoint>& envelope, std::size_t from) {
    std::size_t to = from;
    while (to + 1 < envelope.size()) {
        const EnvelopePoint &a = envelope[to], &b = envelope[to + 1];
        if (a.amplitude == 0.0 && b.amplitude == 0.0 && b.seconds - a.seconds > silenceSeconds) break;
        if (to > from && b.seconds - envelope[from].seconds > limits::maxAhapEventSeconds) break;
        ++to;
    }
    return to;
}

bool isSilent(std::span<const EnvelopePoint> points) {
    return std::ranges::all_of(points, [](const EnvelopePoint& p) { return p.amplitude == 0.0; });
}

/// Pieces in time order; silences are omitted, except where a transient sounds.
class EnvelopeCutter {
public:
    explicit EnvelopeCutter(const ClipChannel& channel)
        : envelope_{makeEnvelope(channel)}
        , hasTransients_{!channel.transients.empty()} {
        const std::vector<ClipTransient>& transients = channel.transients;
        double from = 0.0;
        for (std::size_t i = 0; i < transients.size(); ++i) {
            const double start = pieceStartBefore(transients, i),
                         end = transients[i].seconds + ClipTransient::durationSeconds;
            cutStretches(from, start);
            from = i + 1 < transients.size() ? endOrWhole(end, pieceStartBefore(transients, i + 1)) : end;
            cutAtTransient(start, transients[i].seconds, from);
        }
        cutStretches(from, limits::maxClipSeconds);
    }
    std::vector<AhapPiece> releasePieces() { return std::move(pieces_); }

private:
    void add(std::vector<EnvelopePoint> points, const std::optional<EnvelopePoint>& level) {
        if (points.back().seconds > points.front().seconds) pieces_.push_back({std::move(points), level});
    }

    void cutStretches(double start, double end) {
        if (envelope_.empty()) return;
        start = std::max(start, envelope_.front().seconds);
        end = std::min(end, envelope_.back().seconds);
        if (!(end > start)) return;
        const auto points = cutToLength(envelopeSlice(envelope_, start, end));
        for (std::size_t from = 0; from + 1 < points.size();) {
            const std::size_t to = stretchEnd(points, from);
            const std::span stretch = std::span{points}.subspan(from, to - from + 1);
            if (to > from && !(hasTransients_ && isSilent(stretch)))
                add({stretch.begin(), stretch.end()}, {});
            const bool endsInSilence =
                to + 1 < points.size() && points[to].amplitude == 0.0 && points[to + 1].amplitude == 0.0;
            from = to > from && !endsInSilence ? to : to + 1;
        }
    }

    /// `seconds`, or `end` if less than a piece would remain.
    static double endOrWhole(double seconds, double end) {
        return seconds + minPieceSeconds < end ? seconds : end;
    }

    /// A moment before that transient, and not before the preceding one.
    static double pieceStartBefore(const std::vector<ClipTransient>& transients, std::size_t i) {
        const double at = transients[i].seconds, last = i > 0 ? transients[i - 1].seconds : 0.0;
        return std::max(at - leadSeconds, std::midpoint(last, at));
    }

    /// The first piece nowhere exceeds the envelope at the transient, so that the curve there is 1.
    void cutAtTransient(double start, double transient, double end) {
        EnvelopePoint level = envelopeAt(envelope_, transient);
        const double changeTime = changeSeconds(level, end, 1.0),
                     held = std::min(end, transient + envelopeRiseSeconds); // an impact may rise until then
        const bool isHeld = changeTime < held;
        double from = isHeld ? held : changeTime;
        std::vector<EnvelopePoint> points = envelopeSlice(envelope_, start, from);
        if (isHeld)
            std::erase_if(points,
                          [&](const EnvelopePoint& p) { return p.seconds > transient && p.seconds < held; });
        for (EnvelopePoint& p : points)
            p.amplitude =
                isHeld && p.seconds >= transient ? level.amplitude : std::min(p.amplitude, level.amplitude);
        const auto at = std::ranges::lower_bound(points, transient, {}, &EnvelopePoint::seconds);
        if (at == points.end() || at->seconds > transient) points.insert(at, level);
        add(std::move(points), level);
        for (double to; from < end; from = to) {
            const EnvelopePoint begin = envelopeAt(envelope_, from);
            to = endOrWhole(std::max(from + minPieceSeconds, changeSeconds(begin, end, maxChange)), end);
            std::vector<EnvelopePoint> part = envelopeSlice(envelope_, from, to);
            level = {from, std::ranges::max(part, {}, &EnvelopePoint::amplitude).amplitude,
                     begin.frequencyHz};
            add(std::move(part), level);
        }
    }

    /// When the amplitude has risen by that factor, or fallen by maxChange, since `from`; else `end`.
    double changeSeconds(const EnvelopePoint& from, double end, double maxRise) const {
        const double low = from.amplitude / maxChange, high = from.amplitude * maxRise * (1.0 + rounding);
        EnvelopePoint last = from;
        for (const EnvelopePoint& p : envelopeSlice(envelope_, from.seconds, end)) {
            if (p.amplitude > high)
                return std::lerp(last.seconds, p.seconds,
                                 (high - last.amplitude) / (p.amplitude - last.amplitude));
            if (p.amplitude < low)
                return std::lerp(last.seconds, p.seconds,
                                 (low - last.amplitude) / (p.amplitude - last.amplitude));
            last = p;
        }
        return end;
    }

    std::vector<EnvelopePoint> envelope_;
    bool hasTransients_; // false: even an envelope of silence is written, because there is nothing else
    std::vector<AhapPiece> pieces_;
};

constexpr std::size_t maxCurvePoints = 16; // per curve on a phone
constexpr double intensityTolerance = 0.002, sharpnessTolerance = 0.001;
constexpr double steepSeconds = 0.001; // a faster change is felt as a step
constexpr int linesPerRoot = 6;        // lines per line of amplitude, because its square root is curved

OrderedJson parametersJson(double intensity, double sharpness) {
    return OrderedJson::array(
        {{{"ParameterID", "HapticIntensity"}, {"ParameterValue", roundedForFile(intensity)}},
         {{"ParameterID", "HapticSharpness"}, {"ParameterValue", roundedForFile(sharpness)}}});
}

/// Intensities in shares of `full`. Points are closer where the amplitude is small: its root is steep.
std::vector<ClipPoint> intensityCurve(std::span<const EnvelopePoint> envelope, double full) {
    std::vector<ClipPoint> curve;
    for (std::size_t i = 0; i < envelope.size(); ++i) {
        const EnvelopePoint& p = envelope[i];
        const double intensity = std::sqrt(std::min(1.0, p.amplitude));
        const bool isLine = i > 0 && p.seconds - envelope[i - 1].seconds > steepSeconds;
        for (int k = 1; isLine && k < linesPerRoot; ++k) { // even steps of intensity
            const EnvelopePoint& from = envelope[i - 1];
            const double root = std::sqrt(std::min(1.0, from.amplitude)),
                         value = root + (intensity - root) * k / linesPerRoot;
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
    return simplifiedCurve(curve, intensityTolerance);
}

/// The events in the order in which they are added, and the curves' values after the last one.
class Pattern {
public:
    explicit Pattern(const FrequencyScale& scale)
        : scale_{scale} {}

    void add(const AhapPiece& piece) {
        const double start = roundedForFile(piece.points.front().seconds),
                     seconds = roundedForFile(roundedForFile(piece.points.back().seconds) - start);
        if (!(seconds > 0.0)) return;
        const double intensity =
            piece.level ? roundedForFile(std::sqrt(std::min(1.0, piece.level->amplitude))) : 1.0;
        const double sharpness = piece.level ? roundedForFile(scale_.toShare(piece.level->frequencyHz)) : 0.0;
        if (intensity > 0.0)
            json_.push_back({{"Event",
                              {{"Time", start},
                               {"EventType", "HapticContinuous"},
                               {"EventDuration", seconds},
                               {"EventParameters", parametersJson(intensity, sharpness)}}}});
        addCurves("HapticIntensityControl",
                  intensity > 0.0 ? intensityCurve(piece.points, intensity) : constant(piece, 1.0),
                  intensity_);
        addCurves("HapticSharpnessControl",
                  intensity > 0.0 ? sharpnessCurve(piece.points, sharpness) : constant(piece, 0.0),
                  sharpness_);
    }

    void add(const ClipTransient& t) {
        json_.push_back({{"Event",
                          {{"Time", roundedForFile(t.seconds)},
                           {"EventType", "HapticTransient"},
                           {"EventParameters", parametersJson(std::sqrt(std::clamp(t.amplitude, 0.0, 1.0)),
                                                              scale_.toShare(t.frequencyHz))}}}});
    }

    OrderedJson releaseJson() { return std::move(json_); }

private:
    static std::vector<ClipPoint> constant(const AhapPiece& piece, double value) {
        return {{piece.points.front().seconds, value}, {piece.points.back().seconds, value}};
    }

    std::vector<ClipPoint> sharpnessCurve(std::span<const EnvelopePoint> envelope, double before) const {
        std::vector<ClipPoint> curve;
        for (const EnvelopePoint& p : envelope)
            curve.push_back({p.seconds, scale_.toShare(p.frequencyHz) - before});
        return simplifiedCurve(curve, sharpnessTolerance);
    }

    /// Writes as many curves as necessary; each begins with the last point of the one before. None if the
    /// curve only continues the value `currentValue`.
    void addCurves(const char* parameter, std::vector<ClipPoint> curve, double& currentValue) {
        for (ClipPoint& p : curve) p = {roundedForFile(p.seconds), roundedForFile(p.value)};
        if (std::ranges::all_of(curve, [&](const ClipPoint& p) { return p.value == currentValue; })) return;
        currentValue = curve.back().value;
        for (std::size_t from = 0; from + 1 < curve.size(); from += maxCurvePoints - 1) {
            const double start = curve[from].seconds;
            OrderedJson points = OrderedJson::array();
            for (std::size_t i = from; i < std::min(from + maxCurvePoints, curve.size()); ++i)
                points.push_back(
                    {{"Time", roundedForFile(curve[i].seconds - start)}, {"ParameterValue", curve[i].value}});
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
    for (const AhapPiece& piece : EnvelopeCutter{channel}.releasePieces()) pattern.add(piece);
    for (const ClipTransient& t : channel.transients) pattern.add(t);
    return prettyJson({{"Version", 1},
                       {"Metadata", {{"Project", title}, {"Created", "PhysVib"}}},
                       {"Pattern", pattern.releaseJson()}});
}

} // namespace physvib
