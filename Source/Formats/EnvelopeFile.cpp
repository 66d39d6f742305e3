// SPDX-License-Identifier: MIT
// Computes a channel's envelope, and fits it with the lines of Android effects: each line is as long as all
// samples, one per millisecond, stay within the tolerance.
#include "Formats/EnvelopeFile.h"
#include "Io/Json/JsonText.h"
#include <algorithm>

namespace physvib {

namespace {

/// Closer times are equal: a wave that begins where another ends follows it. Files have whole microseconds.
constexpr double mergeSeconds = 5e-7;

/// The sounding wave of a band, for increasing times.
class BandCursor {
public:
    explicit BandCursor(const ClipBand& band)
        : band_{band} {}

    /// The wave just before `seconds`, or from then on; null if none.
    const ClipWave* waveAt(double seconds, bool isBefore) {
        const double after = seconds + mergeSeconds;
        while (next_ < band_.waves.size() && band_.waves[next_].endSeconds() < seconds) ++next_;
        for (std::size_t i = next_; i < band_.waves.size() && band_.waves[i].startSeconds <= after; ++i) {
            const ClipWave& wave = band_.waves[i];
            if (isBefore ? wave.startSeconds < seconds && seconds <= wave.endSeconds()
                         : after < wave.endSeconds())
                return &wave;
        }
        return nullptr;
    }

private:
    const ClipBand& band_;
    std::size_t next_ = 0;
};

std::vector<double> momentsOf(const ClipChannel& channel) {
    std::vector<double> moments;
    for (const ClipBand& band : channel.bands)
        for (const ClipWave& wave : band.waves) {
            moments.push_back(wave.startSeconds);
            for (const auto* curve : {&wave.amplitude, &wave.frequencyHz})
                for (const ClipPoint& p : *curve)
                    if (p.seconds <= wave.seconds()) moments.push_back(wave.startSeconds + p.seconds);
        }
    std::ranges::sort(moments);
    moments.erase(
        std::unique(moments.begin(), moments.end(), [](double a, double b) { return b - a < mergeSeconds; }),
        moments.end());
    return moments;
}

/// The value of the curve; where it jumps, the value before or after the jump.
double valueAtStep(std::span<const ClipPoint> curve, double seconds, bool isBefore) {
    const auto first = std::ranges::lower_bound(curve, seconds - sameMomentSeconds, {}, &ClipPoint::seconds);
    const auto end = std::ranges::upper_bound(curve, seconds + sameMomentSeconds, {}, &ClipPoint::seconds);
    return first == end ? valueAt(curve, seconds) : isBefore ? first->value : (end - 1)->value;
}

EnvelopePoint sumAt(std::vector<BandCursor>& bands, double seconds, bool isBefore, double heldHz) {
    double squares = 0.0, weighted = 0.0;
    for (BandCursor& band : bands)
        if (const ClipWave* wave = band.waveAt(seconds, isBefore)) {
            const double a = valueAtStep(wave->amplitude, seconds - wave->startSeconds, isBefore);
            squares += a * a;
            weighted += a * a * valueAtStep(wave->frequencyHz, seconds - wave->startSeconds, isBefore);
        }
    return {seconds, std::sqrt(squares), squares > 0.0 ? weighted / squares : heldHz};
}

bool isJump(const EnvelopePoint& a, const EnvelopePoint& b) {
    return std::abs(a.amplitude - b.amplitude) > 1e-6 || std::abs(a.frequencyHz - b.frequencyHz) > 1e-3;
}

} // namespace

std::vector<EnvelopePoint> makeEnvelope(const ClipChannel& channel, double riseSeconds) {
    std::vector<BandCursor> bands(channel.bands.begin(), channel.bands.end());
    std::vector<EnvelopePoint> points;
    for (const double moment : momentsOf(channel)) {
        const double heldHz = points.empty() ? 0.0 : points.back().frequencyHz;
        EnvelopePoint before = sumAt(bands, moment, true, heldHz);
        EnvelopePoint after = sumAt(bands, moment, false, before.frequencyHz);
        if (before.amplitude == 0.0)
            before.frequencyHz = after.frequencyHz; // so that the frequency does not glide during silence
        const double last = points.empty() ? 0.0 : points.back().seconds;
        after.seconds = std::max(moment, last); // a point within the rise of a wave that begins at 0 s
        if (!isJump(before, after)) {
            points.push_back(after);
            continue;
        }
        before.seconds = std::max(moment - riseSeconds, 0.5 * (last + moment));
        if (after.seconds < riseSeconds && points.empty())
            after.seconds = riseSeconds, before.seconds = 0.0; // a wave that begins at 0 s rises from there
        if (before.seconds > last || points.empty()) points.push_back(before);
        points.push_back(after);
    }
    return points;
}

EnvelopePoint envelopeAt(std::span<const EnvelopePoint> envelope, double seconds) {
    const auto next = std::ranges::upper_bound(envelope, seconds, {}, &EnvelopePoint::seconds);
    if (envelope.empty()) return {seconds, 0.0, 0.0};
    if (next == envelope.begin()) return {seconds, 0.0, next->frequencyHz};
    const EnvelopePoint& last = *(next - 1);
    if (next == envelope.end())
        return {seconds, seconds > last.seconds ? 0.0 : last.amplitude, last.frequencyHz};
    EnvelopePoint point =
        interpolated(last, *next, (seconds - last.seconds) / (next->seconds - last.seconds));
    point.seconds = seconds;
    return point;
}

std::vector<EnvelopePoint> envelopeSlice(std::span<const EnvelopePoint> envelope, double fromSeconds,
                                         double toSeconds) {
    const auto first = std::ranges::upper_bound(envelope, fromSeconds, {}, &EnvelopePoint::seconds);
    const auto end = std::ranges::lower_bound(envelope, toSeconds, {}, &EnvelopePoint::seconds);
    std::vector<EnvelopePoint> part{envelopeAt(envelope, fromSeconds)};
    if (first < end) part.insert(part.end(), first, end);
    part.push_back(envelopeAt(envelope, toSeconds));
    return part;
}

std::vector<ClipPoint> simplifiedCurve(const std::vector<ClipPoint>& curve, double tolerance) {
    constexpr std::size_t maxStretchPoints = 1024; // bounds the cost, quadratic in its length
    if (curve.size() < 3) return curve;
    std::vector<bool> isKept(curve.size());
    std::vector<std::pair<std::size_t, std::size_t>> stretches;
    for (std::size_t from = 0, to; from + 1 < curve.size(); from = to) {
        to = std::min(from + maxStretchPoints, curve.size() - 1);
        stretches.push_back({from, to});
        isKept[from] = isKept[to] = true;
    }
    while (!stretches.empty()) {
        const auto [from, to] = stretches.back();
        stretches.pop_back();
        const ClipPoint ends[] = {curve[from], curve[to]};
        std::size_t farthest = from;
        double largest = tolerance;
        for (std::size_t i = from + 1; i < to; ++i) {
            const double distance = std::abs(curve[i].value - valueAt(ends, curve[i].seconds));
            if (distance > largest) largest = distance, farthest = i;
        }
        if (farthest == from) continue;
        isKept[farthest] = true;
        stretches.push_back({from, farthest});
        stretches.push_back({farthest, to});
    }
    std::vector<ClipPoint> simplified;
    for (std::size_t i = 0; i < curve.size(); ++i)
        if (isKept[i]) simplified.push_back(curve[i]);
    return simplified;
}

namespace {

constexpr std::size_t maxPoints = 16; // that every phone accepts
constexpr int maxPointMs = 1000;      // likewise, of a point
constexpr double relativeTolerance = 0.01, minTolerance = 2e-4, toleranceHz = 1.0;
constexpr double minAmplitude = 5e-3; // below it an effect ends

/// The envelope at a whole millisecond.
struct Sample {
    double amplitude, frequencyHz;
    bool isSilent() const { return amplitude < minAmplitude; }
};

std::vector<Sample> sampleEnvelope(const ClipChannel& channel, const FrequencyScale& scale) {
    ClipChannel combined = channel;
    for (const ClipTransient& transient : channel.transients) combined.bands.push_back({{transient.wave()}});
    const std::vector<EnvelopePoint> envelope = makeEnvelope(combined);
    std::vector<Sample> samples;
    if (envelope.empty()) return samples;
    const int last = static_cast<int>(std::ceil(1e3 * envelope.back().seconds)) + 1;
    for (int ms = 0; ms <= last; ++ms) {
        const EnvelopePoint p = envelopeAt(envelope, 1e-3 * ms);
        samples.push_back({std::min(1.0, p.amplitude), std::clamp(p.frequencyHz, scale.lowHz, scale.highHz)});
    }
    return samples;
}

/// Slopes that stay within the tolerance of all values so far.
struct SlopeRange {
    double minSlope = -INFINITY, maxSlope = INFINITY;
    bool narrow(double rise, double run, double error) {
        const double low = std::max(minSlope, (rise - error) / run),
                     high = std::min(maxSlope, (rise + error) / run);
        if (low > high) return false;
        minSlope = low, maxSlope = high;
        return true;
    }
    double nearest(double slope) const { return std::clamp(slope, minSlope, maxSlope); }
};

/// The farthest end of a line from `a` at `from` that is within the tolerances of all samples.
std::size_t findLineEnd(std::span<const Sample> samples, std::size_t from, const Sample& a, Sample& end) {
    SlopeRange amplitudes, frequencies;
    std::size_t last = from + 1;
    end = samples[last];
    for (std::size_t i = last; i < samples.size() && i - from <= maxPointMs; ++i) {
        const Sample& b = samples[i];
        const double run = static_cast<double>(i - from), rise = b.amplitude - a.amplitude,
                     change = b.frequencyHz - a.frequencyHz;
        if (!amplitudes.narrow(rise, run, std::max(minTolerance, relativeTolerance * b.amplitude)) ||
            !frequencies.narrow(change, run, b.isSilent() ? INFINITY : toleranceHz))
            break;
        last = i;
        end = {a.amplitude + run * amplitudes.nearest(rise / run),
               a.frequencyHz + run * frequencies.nearest(change / run)};
        if (b.isSilent()) break;
    }
    return last;
}

} // namespace

std::vector<AndroidEffect> androidEffects(const ClipChannel& channel, const FrequencyScale& scale) {
    const std::vector<Sample> samples = sampleEnvelope(channel, scale);
    std::vector<AndroidEffect> effects;
    bool isEffectOpen = false; // the last effect goes on
    const auto begin = [&](std::size_t at) {
        effects.push_back({static_cast<int>(at), samples[at].frequencyHz, {}});
        isEffectOpen = true;
    };
    Sample lineEnd{}; // where the last line has ended
    for (std::size_t at = 0, end = 0; at + 1 < samples.size(); at = end) {
        end = at + 1;
        if (samples[at].isSilent() && samples[end].isSilent()) {
            isEffectOpen = false;
            continue;
        }
        if (!isEffectOpen || effects.back().points.size() == maxPoints) {
            begin(at);
            lineEnd = samples[end]; // from 0 within the first millisecond
        } else {
            end = findLineEnd(samples, at, Sample{lineEnd}, lineEnd);
        }
        if (samples[end].isSilent()) lineEnd.amplitude = 0.0;
        effects.back().points.push_back(
            {std::clamp(lineEnd.amplitude, 0.0, 1.0), lineEnd.frequencyHz, static_cast<int>(end - at)});
    }
    return effects;
}

std::string envelopeText(const ClipChannel& channel, std::string_view title, const FrequencyScale& scale) {
    OrderedJson effects = OrderedJson::array();
    const auto rounded = [](double value, double steps) { return std::round(value * steps) / steps; };
    for (const AndroidEffect& effect : androidEffects(channel, scale)) {
        OrderedJson points = OrderedJson::array();
        for (const AndroidPoint& p : effect.points)
            points.push_back({rounded(p.amplitude, 1e5), rounded(p.frequencyHz, 10.0), p.durationMs});
        effects.push_back({{"start_ms", effect.startMs},
                           {"initial_hz", rounded(effect.initialHz, 10.0)},
                           {"points", std::move(points)}});
    }
    return prettyJson({{"android_waveform_envelope", 1},
                       {"title", title},
                       {"point", {"amplitude", "hz", "ms"}},
                       {"effects", std::move(effects)}});
}

} // namespace physvib
