// SPDX-License-Identifier: MIT
// Writes .hjif: one line per effect, everything in a fixed order.
#include "Formats/HjifFile.h"
#include "Formats/MpegEffects.h"
#include "Formats/MpegPlaces.h"
#include "Io/Json/JsonLines.h"

namespace physvib {
namespace {

using mpeg::tickOf;

/// Rounds a value up to 10 to what is perceptible, for short numbers.
double eightDigits(double value) { return std::round(value * 1e8) / 1e8; }

constexpr double usualTopHz = 1000.0; // upper limit of written bands: the tactile range

/// An object without its end, for more fields.
std::string begun(const OrderedJson& fields) {
    std::string text = jsonLine(fields);
    text.resize(text.size() - 2); // " }"
    return text + ", ";
}

template <class Items, class Write>
std::string listed(const Items& items, Write write) {
    std::string text = "[";
    for (std::size_t i = 0; i < items.size(); ++i)
        text.append(i == 0 ? "\n" : ",\n").append(write(items[i], i));
    return text + "]";
}

OrderedJson vectorJson(mpeg::GridPoint p, int z) { return {{"X", p.x}, {"Y", p.y}, {"Z", z}}; }

OrderedJson keyframesJson(const ClipWave& wave, double gain) {
    OrderedJson frames = OrderedJson::array();
    for (const mpeg::TickFrame& found : mpeg::tickFrames(wave)) {
        OrderedJson& frame = frames.emplace_back(OrderedJson{{"relative_position", found.ticks}});
        if (found.amplitude) frame["amplitude_modulation"] = eightDigits(*found.amplitude / gain);
        if (found.frequencyHz) frame["frequency_modulation"] = *found.frequencyHz;
    }
    return frames;
}

std::string effectText(const ClipWave& wave, double gain) {
    return jsonLine({{"effect_type", "Basis"},
                     {"position", tickOf(wave.startSeconds)},
                     {"phase", eightDigits(std::min(wave.phaseRadians, mpeg::mostPhase))},
                     {"base_signal", mpeg::waveforms[static_cast<std::size_t>(wave.waveform)]},
                     {"keyframes", keyframesJson(wave, gain)}});
}

std::string effectText(const ClipTransient& transient, double gain) {
    const OrderedJson frame{{"relative_position", 0},
                            {"amplitude_modulation", eightDigits(transient.amplitude / gain)},
                            {"frequency_modulation", transient.frequencyHz}};
    return jsonLine({{"effect_type", "Basis"},
                     {"position", tickOf(transient.seconds)},
                     {"keyframes", OrderedJson::array({frame})}});
}

template <class Effects>
std::string bandText(const char* type, const Effects& effects, double topHz, double gain) {
    return begun({{"band_type", type},
                  {"lower_frequency_limit", 0},
                  {"upper_frequency_limit", std::ceil(topHz)}}) +
           "\"effects\": " +
           listed(effects, [gain](const auto& effect, std::size_t) { return effectText(effect, gain); }) +
           " }";
}

double topOf(const ClipBand& band) {
    double top = usualTopHz;
    for (const ClipWave& wave : band.waves)
        for (const ClipPoint& p : wave.frequencyHz) top = std::max(top, p.value);
    return top;
}

/// 1, or the largest amplitude if that is beyond full scale.
double gainOf(const ClipChannel& channel) { return std::max(1.0, peakOf(channel)); }

std::string bandsText(const ClipChannel& channel, double gain) {
    std::string bands = listed(channel.bands, [=](const ClipBand& band, std::size_t) {
        return bandText("VectorialWave", band.waves, topOf(band), gain);
    });
    if (channel.transients.empty()) return bands;
    bands.pop_back();
    return bands + (channel.bands.empty() ? "\n" : ",\n") +
           bandText("Transient", channel.transients, usualTopHz, gain) + "]";
}

std::string channelText(const Clip& clip, const ClipChannel& channel, std::size_t j) {
    const double gain = gainOf(channel);
    OrderedJson head{{"id", j},      {"description", channel.label}, {"reference_device_id", j + 1},
                     {"gain", gain}, {"mixing_coefficient", 1},      {"body_part_mask", mpeg::anyBodyPart}};
    if (channel.place) {
        const mpeg::PlaceGrid grid{clip};
        head["actuator_resolution"] = vectorJson(grid.points, 1);
        head["actuator_target"] = OrderedJson::array({vectorJson(grid.at(*channel.place), 0)});
    }
    return begun(head) + "\"bands\": " + bandsText(channel, gain) + " }";
}

std::string deviceText(const ClipChannel& channel, std::size_t j) {
    OrderedJson device{{"id", j + 1}, {"name", channel.label}};
    const ClipDevice& d = channel.device;
    for (const auto& [name, value] : {std::pair{"maximum_frequency", d.highHz},
                                      {"minimum_frequency", d.lowHz},
                                      {"resonance_frequency", d.resonanceHz},
                                      {"maximum_amplitude", d.fullScaleG * 9.80665}})
        if (value > 0.0) device[name] = value;
    return jsonLine(device);
}

} // namespace

std::string hjifText(const Clip& clip) {
    std::string text =
        begun({{"version", mpeg::version},
               {"profile", mpeg::profile},
               {"level", mpeg::level},
               {"date", mpeg::date},
               {"description", clip.title},
               {"timescale", mpeg::ticksPerSecond},
               {"avatars", OrderedJson::array({{{"id", 1}, {"lod", 0}, {"type", "Vibration"}}})},
               {"syncs", OrderedJson::array({{{"timestamp", 0}, {"timescale", mpeg::ticksPerSecond}}})}});
    text += "\"perceptions\": [\n" + begun({{"id", 0},
                                            {"perception_modality", "Vibrotactile"},
                                            {"description", clip.title},
                                            {"avatar_id", 1},
                                            {"effect_library", OrderedJson::array()}});
    text += "\"reference_devices\": " + listed(clip.channels, deviceText) + ",\n\"channels\": ";
    return text +
           listed(clip.channels,
                  [&](const ClipChannel& channel, std::size_t j) { return channelText(clip, channel, j); }) +
           " }] }\n";
}

} // namespace physvib
