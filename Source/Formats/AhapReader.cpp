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
    AhapControl(double initialValue, double minValue)
        : initialValue_{initialValue}
        , minValue_{minValue} {}

    double initialValue() const noexcept { return initialValue_; } ///< value without curves

    /// Values out of range are clamped.
    void add(std::vector<ClipPoint> points) {
        for (ClipPoint& p : points) p.value = std::clamp(p.value, minValue_, 1.0);
        if (!points.empty()) pieces_.push_back(std::move(points));
    }
    /// All pieces as one curve: each holds until the next begins.
    std::vector<ClipPoint> curve() {
        sortByTime(pieces_, [](const auto& piece) { return piece.front().seconds; });
        std::vector<ClipPoint> all{{0.0, initialValue_}};
        for (const auto& piece : pieces_) {
            const double start = piece.front().seconds, startValue = valueAt(all, start);
            while (!all.empty() && all.back().seconds > start) all.pop_back();
            all.push_back({start, startValue});
            all.insert(all.end(), piece.begin(), piece.end());
        }
        return all;
    }

private:
    double initialValue_, minValue_;
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

constexpr double maxLineChange = 0.1; // change of intensity per line: its square then deviates from its chord
                                      // by at most 0.0025

/// The times at which `curve` bends during the event, including both ends.
std::vector<double> bendTimes(const AhapEvent& event, const std::vector<ClipPoint>& curve) {
    const double end = roundedToNs(event.start + event.seconds);
    std::vector<double> times{event.start};
    const auto first = std::ranges::upper_bound(curve, event.start, {}, &ClipPoint::seconds);
    for (auto p = first; p != curve.end() && p->seconds < end; ++p) times.push_back(p->seconds);
    times.push_back(end);
    return times;
}

/// Calls `emit` for each line of `value` between bends of `curve`; it ends just before the next bend.
template <class Value, class Emit>
void forEachLine(const AhapEvent& event, const std::vector<ClipPoint>& curve, Value value, Emit emit) {
    const auto times = bendTimes(event, curve);
    for (std::size_t i = 0; i + 1 < times.size(); ++i)
        emit(ClipPoint{times[i] - event.start, value(times[i])},
             ClipPoint{times[i + 1] - event.start, value(std::nextafter(times[i + 1], 0.0))});
}

void addWave(std::vector<ClipBand>& bands, ClipWave wave) {
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

class AhapEventConverter {
public:
    AhapEventConverter(AhapPattern& pattern, const FrequencyScale& scale)
        : scale_{scale}
        , intensity_{pattern.intensity.curve()}
        , sharpness_{pattern.sharpness.curve()} {}

    ClipTransient toTransient(const AhapEvent& event) const {
        const double strength = intensityAt(event, event.start);
        return {event.start, strength * strength, frequencyHzAt(event, event.start)};
    }

    ClipWave toWave(const AhapEvent& event) {
        ClipWave wave{event.start, 0.0, ClipWaveform::sine, {}, {}};
        const auto strength = [&](double seconds) { return intensityAt(event, seconds); };
        forEachLine(event, intensity_, strength, [&](const ClipPoint& from, const ClipPoint& to) {
            const int pieces =
                std::max(1, static_cast<int>(std::ceil(std::abs(to.value - from.value) / maxLineChange)));
            countPoints(static_cast<std::size_t>(pieces));
            wave.amplitude.push_back({from.seconds, from.value * from.value});
            for (int k = 1; k < pieces; ++k) {
                const double share = static_cast<double>(k) / pieces,
                             value = std::lerp(from.value, to.value, share);
                wave.amplitude.push_back({std::lerp(from.seconds, to.seconds, share), value * value});
            }
            wave.amplitude.push_back({to.seconds, to.value * to.value});
        });
        const auto frequencyHz = [&](double seconds) { return frequencyHzAt(event, seconds); };
        forEachLine(event, sharpness_, frequencyHz, [&](const ClipPoint& from, const ClipPoint& to) {
            countPoints(1);
            wave.frequencyHz.push_back(from);
            wave.frequencyHz.push_back(to);
        });
        return wave;
    }

private:
    double intensityAt(const AhapEvent& event, double seconds) const {
        return event.intensity * valueAt(intensity_, seconds);
    }
    double frequencyHzAt(const AhapEvent& event, double seconds) const {
        return scale_.toHz(event.sharpness + valueAt(sharpness_, seconds));
    }

    /// Each event copies the curves that apply during it: many could exceed the file's size by far.
    void countPoints(std::size_t points) {
        pointCount_ += points;
        if (pointCount_ > 4 * limits::maxClipPoints)
            throw JsonError("Pattern", "expected fewer events at once on such long curves");
    }

    FrequencyScale scale_;
    std::vector<ClipPoint> intensity_, sharpness_;
    std::size_t pointCount_ = 0;
};

/// Throws JsonError if the result is too large.
Clip toClip(AhapPattern pattern, const FrequencyScale& scale) {
    sortByTime(pattern.events, &AhapEvent::start);
    AhapEventConverter converter{pattern, scale};
    Clip clip;
    ClipChannel& channel = clip.channels.emplace_back();
    for (const AhapEvent& event : pattern.events)
        if (event.seconds == 0.0)
            channel.transients.push_back(converter.toTransient(event));
        else
            addWave(channel.bands, converter.toWave(event));
    return clip;
}

constexpr double defaultIntensity = 1.0, defaultSharpness = 0.5;

class AhapReader {
public:
    Clip read(const JsonField& root, const FrequencyScale& scale) {
        expectKeys(root, {"Version", "Metadata", "Pattern"});
        const JsonField list = root["Pattern"];
        for (std::size_t i = 0; i < list.arraySize(); ++i) readEntry(list.item(i));
        Clip clip = toClip(std::move(pattern_), scale);
        clip.omissions = omissions_.line();
        if (auto error = clipError(clip); !error.empty()) list.fail(error);
        return clip;
    }

private:
    void expectKeys(const JsonField& json, std::initializer_list<std::string_view> allowed) {
        json.expectObject();
        for (const std::string& name : json.names())
            if (std::ranges::find(allowed, name) == allowed.end()) omissions_.add(name);
    }

    void readEntry(const JsonField& entry) {
        expectKeys(entry, {"Event", "ParameterCurve", "Parameter"});
        if (entry.has("Event")) readEvent(entry["Event"]);
        if (entry.has("ParameterCurve")) readCurve(entry["ParameterCurve"]);
        if (entry.has("Parameter")) readStep(entry["Parameter"]);
    }

    static double time(const JsonField& json) {
        return json.has("Time") ? roundedToNs(json["Time"].numberUpTo(limits::maxClipSeconds)) : 0.0;
    }

    static double value(const JsonField& json, double fallback) {
        return json.has("ParameterValue") ? json["ParameterValue"].number() : fallback;
    }

    void readEvent(const JsonField& json) {
        json.expectObject();
        constexpr std::array<std::string_view, 4> types{"HapticTransient", "HapticContinuous",
                                                        "AudioContinuous", "AudioCustom"};
        const std::size_t type = json["EventType"].oneOf(types);
        if (type > 1) return omissions_.add(types[type]); // audible, not tactile
        expectKeys(json, {"Time", "EventType", "EventDuration", "EventParameters"});
        AhapEvent event{time(json), type == 0 ? 0.0 : duration(json), defaultIntensity, defaultSharpness};
        for (std::size_t i = 0; json.has("EventParameters") && i < json["EventParameters"].arraySize(); ++i)
            readParameter(json["EventParameters"].item(i), event);
        if (type == 0 || event.seconds > 0.0) pattern_.events.push_back(event);
    }

    double duration(const JsonField& json) {
        if (json.has("EventDuration"))
            return roundedToNs(json["EventDuration"].numberUpTo(limits::maxClipSeconds));
        return limits::maxAhapEventSeconds; // without an end a phone stops it then
    }

    void readParameter(const JsonField& json, AhapEvent& event) {
        expectKeys(json, {"ParameterID", "ParameterValue"});
        const auto share = [&](double fallback) { return std::clamp(value(json, fallback), 0.0, 1.0); };
        const std::string name = readParameterId(json);
        if (name == "HapticIntensity")
            event.intensity = share(defaultIntensity);
        else if (name == "HapticSharpness")
            event.sharpness = share(defaultSharpness);
        else
            omissions_.add(name);
    }

    static std::string readParameterId(const JsonField& json) {
        return json.has("ParameterID") ? json["ParameterID"].line() : "a parameter without ParameterID";
    }

    /// The control that a curve or step applies to; null if it is not tactile.
    AhapControl* findControl(const JsonField& json) {
        const std::string name = readParameterId(json);
        if (name == "HapticIntensityControl") return &pattern_.intensity;
        if (name == "HapticSharpnessControl") return &pattern_.sharpness;
        omissions_.add(name); // sound, attack, decay, release
        return nullptr;
    }

    void readStep(const JsonField& json) {
        expectKeys(json, {"ParameterID", "Time", "ParameterValue"});
        AhapControl* const control = findControl(json);
        if (control) control->add({{time(json), value(json, control->initialValue())}});
    }

    void readCurve(const JsonField& json) {
        expectKeys(json, {"ParameterID", "Time", "ParameterCurveControlPoints"});
        AhapControl* const control = findControl(json);
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
            const double seconds = roundedToNs(time(json) + time(point));
            if (!points.empty() && seconds < points.back().seconds)
                point["Time"].fail("expected control points in time order");
            points.push_back({seconds, value(point, control->initialValue())});
        }
        control->add(std::move(points));
    }

    AhapPattern pattern_;
    OmissionCounter omissions_;
    std::size_t points_ = 0;
};

/// Apple's own samples have commas after the last item of a list: replaces them by spaces, except in strings.
std::string withoutTrailingCommas(std::string_view text) {
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
    return readJson(withoutTrailingCommas(text), name, limits::maxClipFileBytes, read);
}

} // namespace physvib
