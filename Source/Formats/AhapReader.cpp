// SPDX-License-Identifier: MIT
// Events become waves and transients, bent by the curves that hold while they last.
#include "Files/Json/JsonField.h"
#include "Files/Json/JsonFile.h"
#include "Formats/AhapFile.h"
#include "Formats/ClipLimits.h"
#include <cmath>

namespace physvib {
namespace {

constexpr double assumedIntensity = 1.0, assumedSharpness = 0.5;
constexpr double longestLine = 0.1; // of intensity: its square is within 0.0025 of its chord

/// What a dynamic parameter does over time: curves and steps, one after the other.
class Control {
public:
    explicit Control(double before)
        : before_{before} {}

    void add(std::vector<ClipPoint> points) {
        if (!points.empty()) pieces_.push_back(std::move(points));
    }
    /// All in one: each piece holds until the next begins.
    std::vector<ClipPoint> curve() {
        std::ranges::stable_sort(pieces_, {}, [](const auto& piece) { return piece.front().seconds; });
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
    double before_;
    std::vector<std::vector<ClipPoint>> pieces_;
};

struct Event {
    double start, seconds; ///< 0: a transient
    double intensity, sharpness;
};

class AhapReader {
public:
    explicit AhapReader(const FrequencyScale& scale)
        : scale_{scale} {}

    Clip read(const JsonField& root) {
        root.expectObject();
        const JsonField pattern = root["Pattern"];
        for (std::size_t i = 0; i < pattern.arraySize(); ++i) readEntry(pattern.item(i));
        Clip clip = made();
        if (auto fault = clipFault(clip); !fault.empty()) pattern.fail(fault);
        return clip;
    }

private:
    void readEntry(const JsonField& entry) {
        entry.expectObject();
        if (entry.has("Event")) readEvent(entry["Event"]);
        if (entry.has("ParameterCurve")) readCurve(entry["ParameterCurve"]);
        if (entry.has("Parameter")) control(entry["Parameter"], {{time(entry["Parameter"]), entry["Parameter"]["ParameterValue"].number()}});
    }

    static double time(const JsonField& json) { return json.has("Time") ? json["Time"].numberUpTo(limits::maxClipSeconds) : 0.0; }

    void readEvent(const JsonField& json) {
        json.expectObject();
        constexpr std::array<std::string_view, 4> types{"HapticTransient", "HapticContinuous", "AudioContinuous", "AudioCustom"};
        const std::size_t type = json["EventType"].oneOf(types);
        if (type > 1) return; // heard, not felt
        Event event{time(json), type == 0 ? 0.0 : json["EventDuration"].numberUpTo(limits::maxClipSeconds), assumedIntensity, assumedSharpness};
        for (std::size_t i = 0; json.has("EventParameters") && i < json["EventParameters"].arraySize(); ++i) {
            const JsonField parameter = json["EventParameters"].item(i);
            const double value = std::clamp(parameter["ParameterValue"].number(), 0.0, 1.0);
            if (parameter["ParameterID"].is("HapticIntensity")) event.intensity = value;
            if (parameter["ParameterID"].is("HapticSharpness")) event.sharpness = value;
        }
        if (type == 0 || event.seconds > 0.0) events_.push_back(event);
    }

    void readCurve(const JsonField& json) {
        json.expectObject();
        const JsonField list = json["ParameterCurveControlPoints"];
        points_ += list.arraySize();
        if (points_ > limits::maxClipPoints) list.fail("expected at most " + std::to_string(limits::maxClipPoints) + " control points in the file, found more");
        std::vector<ClipPoint> points;
        for (std::size_t i = 0; i < list.arraySize(); ++i) {
            const double at = time(json) + time(list.item(i));
            if (!points.empty() && at < points.back().seconds) list.item(i)["Time"].fail("expected control points in time order");
            points.push_back({at, list.item(i)["ParameterValue"].number()});
        }
        control(json, std::move(points));
    }

    void control(const JsonField& json, std::vector<ClipPoint> points) {
        const bool isSharpness = json["ParameterID"].is("HapticSharpnessControl");
        if (!isSharpness && !json["ParameterID"].is("HapticIntensityControl")) return; // of sound, attack, decay, release
        for (ClipPoint& p : points) p.value = std::clamp(p.value, isSharpness ? -1.0 : 0.0, 1.0);
        (isSharpness ? sharpness_ : intensity_).add(std::move(points));
    }

    Clip made() {
        std::ranges::stable_sort(events_, {}, &Event::start);
        const auto intensity = intensity_.curve(), sharpness = sharpness_.curve();
        Clip clip{"", 0.0, 0.0, {{}}};
        ClipChannel& channel = clip.channels[0];
        for (const Event& event : events_) {
            const auto strength = [&](double at) { return event.intensity * valueAt(intensity, at); };
            const auto hertz = [&](double at) { return scale_.hertz(event.sharpness + valueAt(sharpness, at)); };
            if (event.seconds == 0.0) channel.transients.push_back({event.start, strength(event.start) * strength(event.start), hertz(event.start)});
            else put(channel.bands, waveOf(event, intensity, sharpness, strength, hertz));
        }
        return clip;
    }

    /// Where `curve` bends during the event, from its start on.
    static std::vector<double> bends(const Event& event, const std::vector<ClipPoint>& curve) {
        std::vector<double> at{0.0};
        const auto first = std::ranges::upper_bound(curve, event.start, {}, &ClipPoint::seconds);
        for (auto p = first; p != curve.end() && p->seconds < event.start + event.seconds; ++p) at.push_back(p->seconds - event.start);
        at.push_back(event.seconds);
        return at;
    }

    template <class Strength, class Hertz>
    ClipWave waveOf(const Event& event, const std::vector<ClipPoint>& intensity, const std::vector<ClipPoint>& sharpness, Strength strength, Hertz hertz) {
        ClipWave wave{event.start, 0.0, ClipWaveform::sine, {}, {}};
        eachLine(event, intensity, strength, [&](const ClipPoint& from, const ClipPoint& to) {
            const int pieces = std::max(1, static_cast<int>(std::ceil(std::abs(to.value - from.value) / longestLine)));
            grow(static_cast<std::size_t>(pieces));
            wave.amplitude.push_back({from.seconds, from.value * from.value});
            for (int k = 1; k < pieces; ++k) {
                const double value = std::lerp(from.value, to.value, static_cast<double>(k) / pieces);
                wave.amplitude.push_back({std::lerp(from.seconds, to.seconds, static_cast<double>(k) / pieces), value * value});
            }
            wave.amplitude.push_back({to.seconds, to.value * to.value});
        });
        eachLine(event, sharpness, hertz, [&](const ClipPoint& from, const ClipPoint& to) {
            grow(1);
            wave.frequencyHz.push_back(from);
            wave.frequencyHz.push_back(to);
        });
        return wave;
    }

    /// Lines of `value` between the bends of `curve`, from where it is at one to where it is just before the next.
    template <class Value, class Take>
    static void eachLine(const Event& event, const std::vector<ClipPoint>& curve, Value value, Take take) {
        const auto at = bends(event, curve);
        for (std::size_t i = 0; i + 1 < at.size(); ++i)
            take(ClipPoint{at[i], value(event.start + at[i])}, ClipPoint{at[i + 1], value(std::nextafter(event.start + at[i + 1], 0.0))});
    }

    /// Every event takes the curves that hold during it: many events on long curves are more than the file has.
    void grow(std::size_t points) {
        made_ += points;
        if (made_ > 4 * limits::maxClipPoints) throw JsonError("Pattern", "expected fewer events at once on such long curves");
    }

    static void put(std::vector<ClipBand>& bands, ClipWave wave) {
        const auto isFree = [&](const ClipBand& band) { return band.waves.back().endSeconds() <= wave.startSeconds; };
        auto band = std::ranges::find_if(bands, isFree);
        if (band == bands.end()) band = bands.insert(bands.end(), ClipBand{});
        if (bands.size() > limits::maxClipBands) throw JsonError("Pattern", "expected at most " + std::to_string(limits::maxClipBands) + " events at once, found more");
        band->waves.push_back(std::move(wave));
    }

    FrequencyScale scale_;
    std::vector<Event> events_;
    Control intensity_{1.0}, sharpness_{0.0};
    std::size_t points_ = 0, made_ = 0;
};

} // namespace

Result<Clip> readAhap(std::string_view text, std::string_view name, const FrequencyScale& scale) {
    return readJson(text, name, limits::maxClipFileBytes, [&](const Json& root) { return AhapReader{scale}.read({root, {}}); });
}

} // namespace physvib
