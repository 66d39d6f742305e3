// SPDX-License-Identifier: MIT
// Reads .hjif field by field after MPEG's schema (perceptions, channels, bands, effects, keyframes), and
// writes it: one line per effect, everything in a fixed order.
#include "Formats/ClipFile.h"
#include "Io/Json/JsonField.h"
#include "Io/Json/JsonText.h"
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace physvib {
namespace {

constexpr int ticksPerSecond = 48000; ///< in written files: onsets are as exact as in a render
// a date is mandatory; a constant one makes equal clips give equal bytes
constexpr std::string_view version = "2023", profile = "Main", date = "1970-01-01T00:00:00Z";
constexpr int level = 1;
constexpr double maxPhaseRadians = 6.28318; // 2 pi, as rounded in MPEG's schema
constexpr int anyBodyPart = 0;     // of body_part_mask: unspecified; MPEG's reader drops a channel without it
constexpr int maxCoordinate = 127; // of a place, in grid points
// indexed by ClipWaveform
constexpr std::array<std::string_view, 5> waveforms{"Sine", "Square", "Triangle", "SawToothUp",
                                                    "SawToothDown"};

std::int64_t toTicks(double seconds) { return std::llround(seconds * ticksPerSecond); }

struct GridPoint {
    int x = 0, y = 0;
};

/// A grid of whole millimetres over the clip's extent, as fine as the coordinates allow.
struct PlaceGrid {
    explicit PlaceGrid(const Clip& clip) {
        const double longest = std::max(clip.extentWidthMetres, clip.extentHeightMetres);
        pitchMetres = 1e-3 * std::max(1.0, std::ceil(longest * 1e3 / (maxCoordinate - 1) - 1e-9));
        points = {pointsOf(clip.extentWidthMetres), pointsOf(clip.extentHeightMetres)};
    }
    GridPoint nearest(const ActuatorPlace& place) const {
        const auto index = [this](double metres, int count) {
            return static_cast<int>(
                std::clamp(std::lround(metres / pitchMetres), 0L, static_cast<long>(count - 1)));
        };
        return {index(place.xMetres, points.x), index(place.yMetres, points.y)};
    }
    double pitchMetres;
    GridPoint points; ///< along each side

private:
    int pointsOf(double metres) const { return static_cast<int>(std::lround(metres / pitchMetres)) + 1; }
};

/// Sets a channel's place, on a grid of 1 mm: the format has no unit. A grid of one point has no places.
void setPlace(Clip& clip, ClipChannel& channel, GridPoint points, GridPoint at) {
    if (points.x < 1 || points.y < 1 || points.x + points.y < 3 || at.x < 0 || at.y < 0 || at.x >= points.x ||
        at.y >= points.y)
        return;
    channel.place = ActuatorPlace{1e-3 * at.x, 1e-3 * at.y};
    clip.extentWidthMetres = std::max(clip.extentWidthMetres, 1e-3 * std::max(1, points.x - 1));
    clip.extentHeightMetres = std::max(clip.extentHeightMetres, 1e-3 * std::max(1, points.y - 1));
}

enum class BandType { transient, curve, vectorial, wavelet };
constexpr std::array<std::string_view, 4> bandTypes{"Transient", "Curve", "VectorialWave", "WaveletWave"};

struct Keyframe {
    double seconds = 0.0;
    std::optional<double> amplitude, frequencyHz;
};

struct Effect {
    double phaseRadians = 0.0;
    ClipWaveform waveform = ClipWaveform::sine;
    std::vector<Keyframe> keyframes; ///< in time order
};

struct BandKind {
    BandType type = BandType::vectorial;
    bool isCubic = false; ///< for curves
    double gain = 1.0;    ///< of the channel
};

/// Approximates cubics with slope 0 at every keyframe by lines.
std::vector<ClipPoint> linearisedCubics(const std::vector<ClipPoint>& keyframes) {
    constexpr int lines = 8;
    std::vector<ClipPoint> out;
    for (std::size_t i = 0; i + 1 < keyframes.size(); ++i)
        for (int k = 0; k < lines; ++k) {
            const double s = static_cast<double>(k) / lines;
            const ClipPoint &from = keyframes[i], &to = keyframes[i + 1];
            out.push_back({from.seconds + s * (to.seconds - from.seconds),
                           from.value + s * s * (3.0 - 2.0 * s) * (to.value - from.value)});
        }
    out.push_back(keyframes.back());
    return out;
}

/// The curve itself is the signal: a sine of 0 Hz at its maximum.
void makeCurveWave(ClipWave& wave, bool isCubic) {
    wave.phaseRadians = 0.5 * std::numbers::pi;
    wave.waveform = ClipWaveform::sine;
    wave.frequencyHz = {{0.0, 0.0}};
    if (isCubic) wave.amplitude = linearisedCubics(wave.amplitude);
}

/// Adds an effect that begins at `startSeconds` to its band, or, if it has transients, to its channel.
void addEffect(const Effect& effect, double startSeconds, const BandKind& kind, ClipBand& band,
               ClipChannel& channel) {
    ClipWave wave{startSeconds, effect.phaseRadians, effect.waveform, {}, {}};
    for (const Keyframe& frame : effect.keyframes) {
        if (frame.amplitude) wave.amplitude.push_back({frame.seconds, kind.gain * *frame.amplitude});
        if (frame.frequencyHz) wave.frequencyHz.push_back({frame.seconds, *frame.frequencyHz});
        if (kind.type == BandType::transient && frame.amplitude)
            channel.transients.push_back(
                {startSeconds + frame.seconds, wave.amplitude.back().value, frame.frequencyHz.value_or(0.0)});
    }
    if (kind.type == BandType::transient) return;
    const double end = effect.keyframes.empty() ? 0.0 : effect.keyframes.back().seconds;
    if (wave.amplitude.empty()) wave.amplitude.push_back({0.0, kind.gain});
    if (wave.amplitude.back().seconds < end) wave.amplitude.push_back({end, wave.amplitude.back().value});
    if (kind.type == BandType::curve) makeCurveWave(wave, kind.isCubic);
    if (!wave.frequencyHz.empty()) band.waves.push_back(std::move(wave));
}

class HjifReader {
public:
    Clip read(const JsonField& root) {
        root.expectObject();
        if (root.has("timescale")) timescale_ = root["timescale"].wholeNumber();
        if (timescale_ < 1)
            root["timescale"].fail("expected at least one tick per second, found " +
                                   std::to_string(timescale_));
        if (root.has("description")) clip_.title = root["description"].line();
        const JsonField perceptions = root["perceptions"];
        for (std::size_t i = 0; i < perceptions.arraySize(); ++i) readPerception(perceptions.item(i));
        if (clip_.channels.empty())
            perceptions.fail("expected a vibrotactile perception with channels, found none");
        if (auto error = clipError(clip_); !error.empty()) perceptions.fail(error);
        clip_.omissions = omissions_.line();
        return std::move(clip_);
    }

private:
    void readPerception(const JsonField& perception) {
        perception.expectObject();
        if (!isVibrotactile(perception)) // actuators cannot play it
            return omissions_.add("a perception of " + perception["perception_modality"].line());
        library_.clear();
        for (std::size_t i = 0;
             perception.has("effect_library") && i < perception["effect_library"].arraySize(); ++i) {
            const JsonField effect = perception["effect_library"].item(i);
            library_.insert_or_assign(effect["id"].wholeNumber(), i);
        }
        const JsonField channels = perception["channels"];
        if (clip_.channels.size() + channels.arraySize() > static_cast<std::size_t>(limits::maxActuators))
            channels.fail("expected at most " + std::to_string(limits::maxActuators) +
                          " channels, found more");
        for (std::size_t i = 0; i < channels.arraySize(); ++i) readChannel(channels.item(i), perception);
    }

    /// Also "Other" with waves or transients, as MPEG's encoder writes .ahap; wavelets' meaning is unknown.
    static bool isVibrotactile(const JsonField& perception) {
        const JsonField modality = perception["perception_modality"];
        if (!modality.equals("Other") || !perception.has("channels")) return modality.equals("Vibrotactile");
        bool isFelt = false;
        for (std::size_t i = 0; i < perception["channels"].arraySize(); ++i) {
            const JsonField bands = perception["channels"].item(i)["bands"];
            for (std::size_t j = 0; j < bands.arraySize(); ++j) {
                const JsonField type = bands.item(j)["band_type"];
                if (type.equals("WaveletWave")) return false;
                isFelt = isFelt || type.equals("VectorialWave") || type.equals("Transient");
            }
        }
        return isFelt;
    }

    void readChannel(const JsonField& json, const JsonField& perception) {
        json.expectObject();
        ClipChannel& channel = clip_.channels.emplace_back();
        if (json.has("description")) channel.label = json["description"].line();
        if (json.has("actuator_resolution") && json.has("actuator_target") &&
            json["actuator_target"].arraySize() == 1)
            setPlace(clip_, channel, point(json["actuator_resolution"]),
                     point(json["actuator_target"].item(0)));
        gain_ = json.has("gain") ? json["gain"].numberWithin(0.0, limits::maxClipAmplitude) : 1.0;
        const JsonField bands = json["bands"];
        for (std::size_t i = 0; i < bands.arraySize(); ++i) readBand(bands.item(i), perception, channel);
        sortByTime(channel.transients, &ClipTransient::seconds);
    }

    static GridPoint point(const JsonField& vector) {
        return {vector["X"].wholeNumber(), vector["Y"].wholeNumber()};
    }

    void readBand(const JsonField& json, const JsonField& perception, ClipChannel& channel) {
        json.expectObject();
        BandKind kind{static_cast<BandType>(json["band_type"].oneOf(bandTypes)), false, gain_};
        if (kind.type == BandType::wavelet)
            json["band_type"].fail(
                "expected waves, transients or curves, found wavelets, which are not read");
        if (kind.type == BandType::curve)
            kind.isCubic = json.has("curve_type") && json["curve_type"].oneOf(curveTypes) == 1;
        const JsonField effects = json["effects"];
        ClipBand band;
        for (std::size_t i = 0; i < effects.arraySize(); ++i) {
            const JsonField effect = effects.item(i);
            const double start = effect.has("position") ? seconds(effect["position"]) : 0.0;
            addEffect(readEffect(resolvedEffect(effect, perception), kind.type), start, kind, band, channel);
        }
        makeSequential(band);
        if (!band.waves.empty()) channel.bands.push_back(std::move(band));
    }

    /// The effect itself, or the library's effect that it refers to.
    JsonField resolvedEffect(const JsonField& effect, const JsonField& perception) const {
        effect.expectObject();
        constexpr std::array<std::string_view, 2> types{"Basis", "Reference"};
        if (effect["effect_type"].oneOf(types) == 0) return effect;
        const auto found = library_.find(effect["id"].wholeNumber());
        if (found == library_.end())
            effect["id"].fail("expected an effect of the library, found none of that number");
        const JsonField basis = perception["effect_library"].item(found->second);
        if (!basis["effect_type"].equals("Basis")) basis["effect_type"].fail("expected Basis in the library");
        return basis;
    }

    Effect readEffect(const JsonField& json, BandType type) {
        Effect effect;
        const JsonField frames = json["keyframes"];
        points_ += frames.arraySize();
        if (points_ > limits::maxClipPoints)
            frames.fail("expected at most " + std::to_string(limits::maxClipPoints) +
                        " keyframes in the file, found more");
        for (std::size_t i = 0; i < frames.arraySize(); ++i) {
            const JsonField frame = frames.item(i);
            frame.expectObject();
            Keyframe key{frame.has("relative_position") ? seconds(frame["relative_position"]) : 0.0, {}, {}};
            if (!effect.keyframes.empty() && key.seconds < effect.keyframes.back().seconds)
                frame["relative_position"].fail("expected keyframes in time order");
            if (frame.has("amplitude_modulation"))
                key.amplitude = frame["amplitude_modulation"].numberWithin(-1.0, 1.0);
            if (frame.has("frequency_modulation"))
                key.frequencyHz = frame["frequency_modulation"].numberUpTo(limits::maxClipFrequencyHz);
            effect.keyframes.push_back(key);
        }
        if (type != BandType::vectorial) return effect;
        if (json.has("phase")) effect.phaseRadians = json["phase"].numberWithin(0.0, 2.0 * std::numbers::pi);
        if (json.has("base_signal"))
            effect.waveform = static_cast<ClipWaveform>(json["base_signal"].oneOf(waveforms));
        return effect;
    }

    double seconds(const JsonField& ticks) const {
        return ticks.numberUpTo(limits::maxClipSeconds * timescale_) / timescale_;
    }

    static constexpr std::array<std::string_view, 2> curveTypes{"Linear", "Cubic"};
    Clip clip_;
    OmissionCounter omissions_;
    std::map<int, std::size_t> library_; // of this perception: index of an effect by its number
    int timescale_ = 1000;
    double gain_ = 1.0;
    std::size_t points_ = 0;
};

/// A written keyframe: ticks since its effect began.
struct TickFrame {
    std::int64_t ticks = 0;
    std::optional<double> amplitude, frequencyHz;
};

/// Amplitudes (unscaled) and frequencies of a wave by tick.
std::vector<TickFrame> tickFrames(const ClipWave& wave) {
    const std::int64_t start = toTicks(wave.startSeconds);
    const auto relative = [&](const ClipPoint& p) { return toTicks(wave.startSeconds + p.seconds) - start; };
    std::vector<TickFrame> frames;
    auto frequency = wave.frequencyHz.begin();
    for (const ClipPoint& p : wave.amplitude) {
        for (; frequency != wave.frequencyHz.end() && relative(*frequency) < relative(p); ++frequency)
            frames.push_back({relative(*frequency), {}, frequency->value});
        TickFrame& frame = frames.emplace_back(TickFrame{relative(p), p.value, {}});
        if (frequency != wave.frequencyHz.end() && relative(*frequency) == relative(p))
            frame.frequencyHz = (frequency++)->value;
    }
    return frames;
}

/// Rounds a value up to 10 to what is perceptible, for short numbers.
double roundedTo8Digits(double value) { return std::round(value * 1e8) / 1e8; }

constexpr double defaultTopHz = 1000.0; // upper limit of written bands: the tactile range

/// An object without its end, for more fields.
std::string openObject(const OrderedJson& fields) {
    std::string text = compactJson(fields);
    text.resize(text.size() - 2); // " }"
    return text + ", ";
}

template <class Items, class Write>
std::string jsonList(const Items& items, Write write) {
    std::string text = "[";
    for (std::size_t i = 0; i < items.size(); ++i)
        text.append(i == 0 ? "\n" : ",\n").append(write(items[i], i));
    return text + "]";
}

OrderedJson vectorJson(GridPoint p, int z) { return {{"X", p.x}, {"Y", p.y}, {"Z", z}}; }

OrderedJson keyframesJson(const ClipWave& wave, double gain) {
    OrderedJson frames = OrderedJson::array();
    for (const TickFrame& key : tickFrames(wave)) {
        OrderedJson& frame = frames.emplace_back(OrderedJson{{"relative_position", key.ticks}});
        if (key.amplitude) frame["amplitude_modulation"] = roundedTo8Digits(*key.amplitude / gain);
        if (key.frequencyHz) frame["frequency_modulation"] = *key.frequencyHz;
    }
    return frames;
}

std::string effectText(const ClipWave& wave, double gain) {
    return compactJson({{"effect_type", "Basis"},
                        {"position", toTicks(wave.startSeconds)},
                        {"phase", roundedTo8Digits(std::min(wave.phaseRadians, maxPhaseRadians))},
                        {"base_signal", waveforms[static_cast<std::size_t>(wave.waveform)]},
                        {"keyframes", keyframesJson(wave, gain)}});
}

std::string effectText(const ClipTransient& transient, double gain) {
    const OrderedJson frame{{"relative_position", 0},
                            {"amplitude_modulation", roundedTo8Digits(transient.amplitude / gain)},
                            {"frequency_modulation", transient.frequencyHz}};
    return compactJson({{"effect_type", "Basis"},
                        {"position", toTicks(transient.seconds)},
                        {"keyframes", OrderedJson::array({frame})}});
}

template <class Effects>
std::string bandText(const char* type, const Effects& effects, double topHz, double gain) {
    return openObject({{"band_type", type},
                       {"lower_frequency_limit", 0},
                       {"upper_frequency_limit", std::ceil(topHz)}}) +
           "\"effects\": " +
           jsonList(effects, [gain](const auto& effect, std::size_t) { return effectText(effect, gain); }) +
           " }";
}

double topFrequencyHz(const ClipBand& band) {
    double top = defaultTopHz;
    for (const ClipWave& wave : band.waves)
        for (const ClipPoint& p : wave.frequencyHz) top = std::max(top, p.value);
    return top;
}

/// 1, or the largest amplitude if that is beyond full scale.
double channelGain(const ClipChannel& channel) { return std::max(1.0, peakAmplitude(channel)); }

std::string bandsText(const ClipChannel& channel, double gain) {
    std::string bands = jsonList(channel.bands, [=](const ClipBand& band, std::size_t) {
        return bandText("VectorialWave", band.waves, topFrequencyHz(band), gain);
    });
    if (channel.transients.empty()) return bands;
    bands.pop_back();
    return bands + (channel.bands.empty() ? "\n" : ",\n") +
           bandText("Transient", channel.transients, defaultTopHz, gain) + "]";
}

std::string channelText(const Clip& clip, const ClipChannel& channel, std::size_t j) {
    const double gain = channelGain(channel);
    OrderedJson head{{"id", j},      {"description", channel.label}, {"reference_device_id", j + 1},
                     {"gain", gain}, {"mixing_coefficient", 1},      {"body_part_mask", anyBodyPart}};
    if (channel.place) {
        const PlaceGrid grid{clip};
        head["actuator_resolution"] = vectorJson(grid.points, 1);
        head["actuator_target"] = OrderedJson::array({vectorJson(grid.nearest(*channel.place), 0)});
    }
    return openObject(head) + "\"bands\": " + bandsText(channel, gain) + " }";
}

std::string deviceText(const ClipChannel& channel, std::size_t j) {
    OrderedJson device{{"id", j + 1}, {"name", channel.label}};
    const ClipDevice& d = channel.device;
    for (const auto& [name, value] : {std::pair{"maximum_frequency", d.highHz},
                                      {"minimum_frequency", d.lowHz},
                                      {"resonance_frequency", d.resonanceHz},
                                      {"maximum_amplitude", d.fullScaleG * 9.80665}})
        if (value > 0.0) device[name] = value;
    return compactJson(device);
}

/// Largest displacement of a place by the grid.
double maxGridShiftMetres(const Clip& clip) {
    const PlaceGrid grid{clip};
    double metres = 0.0;
    for (const ClipChannel& channel : clip.channels)
        if (channel.place) {
            const GridPoint point = grid.nearest(*channel.place);
            metres = std::max({metres, std::abs(point.x * grid.pitchMetres - channel.place->xMetres),
                               std::abs(point.y * grid.pitchMetres - channel.place->yMetres)});
        }
    return metres;
}

} // namespace

Result<Clip> readHjif(std::string_view text, std::string_view name) {
    return readJson(text, name, limits::maxClipFileBytes, [](const Json& root) {
        return HjifReader{}.read({root, {}});
    });
}

std::string hjifText(const Clip& clip) {
    std::string text =
        openObject({{"version", version},
                    {"profile", profile},
                    {"level", level},
                    {"date", date},
                    {"description", clip.title},
                    {"timescale", ticksPerSecond},
                    {"avatars", OrderedJson::array({{{"id", 1}, {"lod", 0}, {"type", "Vibration"}}})},
                    {"syncs", OrderedJson::array({{{"timestamp", 0}, {"timescale", ticksPerSecond}}})}});
    text += "\"perceptions\": [\n" + openObject({{"id", 0},
                                                 {"perception_modality", "Vibrotactile"},
                                                 {"description", clip.title},
                                                 {"avatar_id", 1},
                                                 {"effect_library", OrderedJson::array()}});
    text += "\"reference_devices\": " + jsonList(clip.channels, deviceText) + ",\n\"channels\": ";
    return text +
           jsonList(clip.channels, [&](const ClipChannel& channel,
                                       std::size_t j) { return channelText(clip, channel, j); }) +
           " }] }\n";
}

std::vector<std::string> hjifLosses(const Clip& clip, const std::set<double>& frequenciesHz) {
    std::vector<std::string> losses;
    if (const double metres = maxGridShiftMetres(clip); metres > 1e-6)
        losses.push_back("places are moved by up to " + fixedNumber(1e3 * metres, 2) +
                         " mm, onto a grid of at most 127 points");
    const auto fractional =
        std::ranges::find_if(frequenciesHz, [](double hz) { return hz != std::floor(hz); });
    if (fractional != frequenciesHz.end())
        losses.push_back("MPEG's own decoder cuts frequencies to whole Hz, as of " +
                         fixedNumber(*fractional, 2) + " Hz; ours does not");
    return losses;
}

} // namespace physvib
