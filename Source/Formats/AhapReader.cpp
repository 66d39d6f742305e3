// SPDX-License-Identifier: MIT
// Reads an .ahap file entry by entry with Apple's rules: missing values have defaults, unknown fields are
// ignored. Its events and the curves that control all of them become waves and transients: each event with
// the curves that apply during it, sampled where they bend.
#include "Formats/ClipFile.h"
#include "Io/Json/JsonField.h"
#include "Io/Json/JsonText.h"
#include <algorithm>
#include <cmath>

namespace physvib {
namespace {

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

constexpr double longestLine = 0.1; // change of intensity per line: its square then deviates from its chord
                                    // by at most 0.0025

/// The times at which `curve` bends during the event, including both ends.
std::vector<double> bends(const AhapEvent& event, const std::vector<ClipPoint>& curve) {
    const double end = momentOf(event.start + event.seconds);
    std::vector<double> at{event.start};
    const auto first = std::ranges::upper_bound(curve, event.start, {}, &ClipPoint::seconds);
    for (auto p = first; p != curve.end() && p->seconds < end; ++p) at.push_back(p->seconds);
    at.push_back(end);
    return at;
}

/// Calls `take` for each line of `value` between bends of `curve`, up to its value just before the next bend.
template <class Value, class Take>
void eachLine(const AhapEvent& event, const std::vector<ClipPoint>& curve, Value value, Take take) {
    const auto at = bends(event, curve);
    for (std::size_t i = 0; i + 1 < at.size(); ++i)
        take(ClipPoint{at[i] - event.start, value(at[i])},
             ClipPoint{at[i + 1] - event.start, value(std::nextafter(at[i + 1], 0.0))});
}

void put(std::vector<ClipBand>& bands, ClipWave wave) {
    const auto isFree = [&](const ClipBand& band) {
        return band.waves.back().endSeconds() <= wave.startSeconds + sameMomentSeconds;
    };
    auto band = std::ranges::find_if(bands, isFree);
    if (band == bands.end()) band = bands.insert(bands.end(), ClipBand{});
    if (bands.size() > limits::maxClipBands)
        throw JsonError("Pattern", "expected at most " + std::to_string(limits::maxClipBands) +
                                       " events at once, found more");
    band->waves.push_back(std::move(wave));
}

class Bender {
public:
    Bender(AhapPattern& pattern, const FrequencyScale& scale)
        : scale_{scale}
        , intensity_{pattern.intensity.curve()}
        , sharpness_{pattern.sharpness.curve()} {}

    ClipTransient transientOf(const AhapEvent& event) const {
        const double strength = strengthOf(event, event.start);
        return {event.start, strength * strength, hertzOf(event, event.start)};
    }

    ClipWave waveOf(const AhapEvent& event) {
        ClipWave wave{event.start, 0.0, ClipWaveform::sine, {}, {}};
        const auto strength = [&](double at) { return strengthOf(event, at); };
        eachLine(event, intensity_, strength, [&](const ClipPoint& from, const ClipPoint& to) {
            const int pieces =
                std::max(1, static_cast<int>(std::ceil(std::abs(to.value - from.value) / longestLine)));
            grow(static_cast<std::size_t>(pieces));
            wave.amplitude.push_back({from.seconds, from.value * from.value});
            for (int k = 1; k < pieces; ++k) {
                const double share = static_cast<double>(k) / pieces,
                             value = std::lerp(from.value, to.value, share);
                wave.amplitude.push_back({std::lerp(from.seconds, to.seconds, share), value * value});
            }
            wave.amplitude.push_back({to.seconds, to.value * to.value});
        });
        const auto hertz = [&](double at) { return hertzOf(event, at); };
        eachLine(event, sharpness_, hertz, [&](const ClipPoint& from, const ClipPoint& to) {
            grow(1);
            wave.frequencyHz.push_back(from);
            wave.frequencyHz.push_back(to);
        });
        return wave;
    }

private:
    double strengthOf(const AhapEvent& event, double at) const {
        return event.intensity * valueAt(intensity_, at);
    }
    double hertzOf(const AhapEvent& event, double at) const {
        return scale_.hertz(event.sharpness + valueAt(sharpness_, at));
    }

    /// Each event copies the curves that apply during it: many could exceed the file's size by far.
    void grow(std::size_t points) {
        made_ += points;
        if (made_ > 4 * limits::maxClipPoints)
            throw JsonError("Pattern", "expected fewer events at once on such long curves");
    }

    FrequencyScale scale_;
    std::vector<ClipPoint> intensity_, sharpness_;
    std::size_t made_ = 0;
};

/// Throws JsonError if the result is too large.
Clip clipOf(AhapPattern pattern, const FrequencyScale& scale) {
    sortByTime(pattern.events, &AhapEvent::start);
    Bender bender{pattern, scale};
    Clip clip;
    ClipChannel& channel = clip.channels.emplace_back();
    for (const AhapEvent& event : pattern.events)
        if (event.seconds == 0.0)
            channel.transients.push_back(bender.transientOf(event));
        else
            put(channel.bands, bender.waveOf(event));
    return clip;
}

constexpr double assumedIntensity = 1.0, assumedSharpness = 0.5;

class AhapReader {
public:
    Clip read(const JsonField& root, const FrequencyScale& scale) {
        expectKeys(root, {"Version", "Metadata", "Pattern"});
        const JsonField list = root["Pattern"];
        for (std::size_t i = 0; i < list.arraySize(); ++i) readEntry(list.item(i));
        Clip clip = clipOf(std::move(pattern_), scale);
        clip.leftOut = leftOut_.line();
        if (auto fault = clipFault(clip); !fault.empty()) list.fail(fault);
        return clip;
    }

private:
    void expectKeys(const JsonField& json, std::initializer_list<std::string_view> known) {
        json.expectObject();
        for (const std::string& name : json.names())
            if (std::ranges::find(known, name) == known.end()) leftOut_.add(name);
    }

    void readEntry(const JsonField& entry) {
        expectKeys(entry, {"Event", "ParameterCurve", "Parameter"});
        if (entry.has("Event")) readEvent(entry["Event"]);
        if (entry.has("ParameterCurve")) readCurve(entry["ParameterCurve"]);
        if (entry.has("Parameter")) readStep(entry["Parameter"]);
    }

    static double time(const JsonField& json) {
        return json.has("Time") ? momentOf(json["Time"].numberUpTo(limits::maxClipSeconds)) : 0.0;
    }

    static double value(const JsonField& json, double assumed) {
        return json.has("ParameterValue") ? json["ParameterValue"].number() : assumed;
    }

    void readEvent(const JsonField& json) {
        json.expectObject();
        constexpr std::array<std::string_view, 4> types{"HapticTransient", "HapticContinuous",
                                                        "AudioContinuous", "AudioCustom"};
        const std::size_t type = json["EventType"].oneOf(types);
        if (type > 1) return leftOut_.add(types[type]); // audible, not tactile
        expectKeys(json, {"Time", "EventType", "EventDuration", "EventParameters"});
        AhapEvent event{time(json), type == 0 ? 0.0 : duration(json), assumedIntensity, assumedSharpness};
        for (std::size_t i = 0; json.has("EventParameters") && i < json["EventParameters"].arraySize(); ++i)
            readParameter(json["EventParameters"].item(i), event);
        if (type == 0 || event.seconds > 0.0) pattern_.events.push_back(event);
    }

    double duration(const JsonField& json) {
        if (json.has("EventDuration"))
            return momentOf(json["EventDuration"].numberUpTo(limits::maxClipSeconds));
        return limits::maxAhapEventSeconds; // without an end a phone stops it then
    }

    void readParameter(const JsonField& json, AhapEvent& event) {
        expectKeys(json, {"ParameterID", "ParameterValue"});
        const auto share = [&](double assumed) { return std::clamp(value(json, assumed), 0.0, 1.0); };
        const std::string name = idOf(json);
        if (name == "HapticIntensity")
            event.intensity = share(assumedIntensity);
        else if (name == "HapticSharpness")
            event.sharpness = share(assumedSharpness);
        else
            leftOut_.add(name);
    }

    static std::string idOf(const JsonField& json) {
        return json.has("ParameterID") ? json["ParameterID"].line() : "a parameter without ParameterID";
    }

    /// The control that a curve or step applies to; null if it is not tactile.
    AhapControl* controlOf(const JsonField& json) {
        const std::string name = idOf(json);
        if (name == "HapticIntensityControl") return &pattern_.intensity;
        if (name == "HapticSharpnessControl") return &pattern_.sharpness;
        leftOut_.add(name); // sound, attack, decay, release
        return nullptr;
    }

    void readStep(const JsonField& json) {
        expectKeys(json, {"ParameterID", "Time", "ParameterValue"});
        AhapControl* const control = controlOf(json);
        if (control) control->add({{time(json), value(json, control->before())}});
    }

    void readCurve(const JsonField& json) {
        expectKeys(json, {"ParameterID", "Time", "ParameterCurveControlPoints"});
        AhapControl* const control = controlOf(json);
        if (!control || !json.has("ParameterCurveControlPoints")) return;
        const JsonField list = json["ParameterCurveControlPoints"];
        points_ += list.arraySize();
        if (points_ > limits::maxClipPoints)
            list.fail("expected at most " + std::to_string(limits::maxClipPoints) +
                      " control points in the file, found more");
        std::vector<ClipPoint> points;
        for (std::size_t i = 0; i < list.arraySize(); ++i) {
            const JsonField point = list.item(i);
            expectKeys(point, {"Time", "ParameterValue"});
            const double at = momentOf(time(json) + time(point));
            if (!points.empty() && at < points.back().seconds)
                point["Time"].fail("expected control points in time order");
            points.push_back({at, value(point, control->before())});
        }
        control->add(std::move(points));
    }

    AhapPattern pattern_;
    LeftOut leftOut_;
    std::size_t points_ = 0;
};

/// Apple's own samples have commas after the last item of a list: replaces them by spaces, except in strings.
std::string withoutLastCommas(std::string_view text) {
    std::string out{text};
    std::size_t comma = std::string::npos;
    bool isString = false;
    char last = '[';
    for (std::size_t i = 0; i < out.size(); ++i) {
        const char c = out[i];
        if (isString) {
            if (c == '\\') ++i;
            isString = c != '"';
            continue;
        }
        if (c == ' ' || c == '\t' || c == '\n' || c == '\r') continue;
        if ((c == ']' || c == '}') && comma != std::string::npos) out[comma] = ' ';
        comma = c == ',' && last != '[' && last != '{' && last != ',' ? i : std::string::npos;
        isString = c == '"';
        last = c;
    }
    return out;
}

} // namespace

Result<Clip> readAhap(std::string_view text, std::string_view name, const FrequencyScale& scale) {
    const auto read = [&](const Json& root) { return AhapReader{}.read({root, {}}, scale); };
    if (text.size() > limits::maxClipFileBytes) return readJson(text, name, limits::maxClipFileBytes, read);
    return readJson(withoutLastCommas(text), name, limits::maxClipFileBytes, read);
}

} // namespace physvib
