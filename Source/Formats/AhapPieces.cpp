// SPDX-License-Identifier: MIT
// Splits an envelope into .ahap events: between transients at silences; after a transient wherever it rises
// or halves.
#include "Formats/AhapPieces.h"
#include "Formats/ClipLimits.h"
#include <numeric>
#include <span>

namespace physvib {
namespace {

constexpr double silenceSeconds = 0.05; // a longer silence ends an event
constexpr double rounding = 1e-9;       // of a line's values
constexpr double leastPieceSeconds = 0.001;
constexpr double leadSeconds = 0.0004; // curves are neutral this long before a transient
constexpr double mostChange = 2.0; // of the amplitude within a piece: the curves then reduce a transient's
                                   // end by at most 3 dB

/// Divides lines that are longer than an event may be.
std::vector<EnvelopePoint> cutToLength(std::span<const EnvelopePoint> envelope) {
    std::vector<EnvelopePoint> cut;
    for (const EnvelopePoint& p : envelope) {
        const EnvelopePoint from = cut.empty() ? p : cut.back();
        const int pieces =
            static_cast<int>(std::ceil((p.seconds - from.seconds) / (0.5 * limits::maxAhapEventSeconds)));
        for (int k = 1; k < pieces; ++k) cut.push_back(between(from, p, static_cast<double>(k) / pieces));
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

class Cutter {
public:
    explicit Cutter(const ClipChannel& channel)
        : envelope_{envelopeOf(channel)}
        , hasTransients_{!channel.transients.empty()} {
        const std::vector<ClipTransient>& transients = channel.transients;
        double from = 0.0;
        for (std::size_t i = 0; i < transients.size(); ++i) {
            const double start = startBeside(transients, i),
                         end = transients[i].seconds + ClipTransient::lastsSeconds;
            cutStretches(from, start);
            from = i + 1 < transients.size() ? endOrAll(end, startBeside(transients, i + 1)) : end;
            cutBeside(start, transients[i].seconds, from);
        }
        cutStretches(from, limits::maxClipSeconds);
    }
    std::vector<AhapPiece> take() { return std::move(pieces_); }

private:
    void add(std::vector<EnvelopePoint> points, const std::optional<EnvelopePoint>& level) {
        if (points.back().seconds > points.front().seconds) pieces_.push_back({std::move(points), level});
    }

    void cutStretches(double start, double end) {
        if (envelope_.empty()) return;
        start = std::max(start, envelope_.front().seconds);
        end = std::min(end, envelope_.back().seconds);
        if (!(end > start)) return;
        const auto points = cutToLength(partOf(envelope_, start, end));
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
    static double endOrAll(double seconds, double end) {
        return seconds + leastPieceSeconds < end ? seconds : end;
    }

    /// A moment before that transient, and not before the preceding one.
    static double startBeside(const std::vector<ClipTransient>& transients, std::size_t i) {
        const double at = transients[i].seconds, last = i > 0 ? transients[i - 1].seconds : 0.0;
        return std::max(at - leadSeconds, std::midpoint(last, at));
    }

    /// The first piece nowhere exceeds the envelope at the transient, so that the curve there is 1.
    void cutBeside(double start, double transient, double end) {
        EnvelopePoint level = pointAt(envelope_, transient);
        const double changes = changesAt(level, end, 1.0),
                     held = std::min(end, transient + envelopeRiseSeconds); // an impact's rise may take so
                                                                            // long
        const bool isHeld = changes < held;
        double from = isHeld ? held : changes;
        std::vector<EnvelopePoint> points = partOf(envelope_, start, from);
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
            const EnvelopePoint begin = pointAt(envelope_, from);
            to = endOrAll(std::max(from + leastPieceSeconds, changesAt(begin, end, mostChange)), end);
            std::vector<EnvelopePoint> part = partOf(envelope_, from, to);
            level = {from, std::ranges::max(part, {}, &EnvelopePoint::amplitude).amplitude,
                     begin.frequencyHz};
            add(std::move(part), level);
        }
    }

    /// Time at which the amplitude has risen by that factor, or fallen by mostChange, since `from`; `end` if
    /// not before.
    double changesAt(const EnvelopePoint& from, double end, double mostRise) const {
        const double low = from.amplitude / mostChange, high = from.amplitude * mostRise * (1.0 + rounding);
        EnvelopePoint last = from;
        for (const EnvelopePoint& p : partOf(envelope_, from.seconds, end)) {
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

} // namespace

std::vector<AhapPiece> ahapPieces(const ClipChannel& channel) { return Cutter{channel}.take(); }

} // namespace physvib
