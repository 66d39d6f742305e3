// SPDX-License-Identifier: MIT
// Reads an .ahap file entry by entry with Apple's rules: missing values have defaults, unknown fields are
// ignored.
#include "Formats/AhapFile.h"
#include "Formats/AhapPattern.h"
#include "Formats/ClipLimits.h"
#include "Formats/LeftOut.h"
#include "Io/Json/JsonField.h"
#include "Io/Json/JsonText.h"

namespace physvib {
namespace {

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

/// Apple's own samples have commas after the last item of a list: replaces them by spaces. Strings are not
/// changed.
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
