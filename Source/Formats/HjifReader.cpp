// SPDX-License-Identifier: MIT
// Field by field after MPEG's schema: perceptions, channels, bands, effects, keyframes.
#include "Files/Json/JsonField.h"
#include "Files/Json/JsonFile.h"
#include "Files/Text/NumberText.h"
#include "Formats/ClipLimits.h"
#include "Formats/HjifFile.h"
#include "Formats/MpegPlaces.h"
#include <map>
#include <numbers>

namespace physvib {
namespace {

constexpr std::array<std::string_view, 4> bandTypes{"VectorialWave", "Transient", "Curve", "WaveletWave"};
enum BandType : std::size_t { vectorial, transient, curve, wavelet };

class HjifReader {
public:
    Clip read(const JsonField& root) {
        root.expectObject();
        if (root.has("timescale")) timescale_ = root["timescale"].wholeNumber();
        if (timescale_ < 1) root["timescale"].fail("expected at least one tick per second, found " + std::to_string(timescale_));
        if (root.has("description")) clip_.title = root["description"].line();
        const JsonField perceptions = root["perceptions"];
        for (std::size_t i = 0; i < perceptions.arraySize(); ++i) readPerception(perceptions.item(i));
        if (clip_.channels.empty()) perceptions.fail("expected a vibrotactile perception with channels, found none");
        if (auto fault = clipFault(clip_); !fault.empty()) perceptions.fail(fault);
        return std::move(clip_);
    }

private:
    void readPerception(const JsonField& perception) {
        perception.expectObject();
        if (!perception["perception_modality"].is("Vibrotactile")) return; // nothing that an enchanter could do
        library_.clear();
        for (std::size_t i = 0; perception.has("effect_library") && i < perception["effect_library"].arraySize(); ++i) {
            const JsonField effect = perception["effect_library"].item(i);
            library_.insert_or_assign(effect["id"].wholeNumber(), i);
        }
        const JsonField channels = perception["channels"];
        if (clip_.channels.size() + channels.arraySize() > static_cast<std::size_t>(limits::maxEnchanters))
            channels.fail("expected at most " + std::to_string(limits::maxEnchanters) + " channels, found more");
        for (std::size_t i = 0; i < channels.arraySize(); ++i) readChannel(channels.item(i), perception);
    }

    void readChannel(const JsonField& json, const JsonField& perception) {
        json.expectObject();
        ClipChannel& channel = clip_.channels.emplace_back();
        if (json.has("description")) channel.label = json["description"].line();
        if (json.has("actuator_resolution") && json.has("actuator_target") && json["actuator_target"].arraySize() == 1)
            mpeg::takePlace(clip_, channel, point(json["actuator_resolution"]), point(json["actuator_target"].item(0)));
        gain_ = json.has("gain") ? json["gain"].numberWithin(0.0, limits::maxClipAmplitude) : 1.0;
        const JsonField bands = json["bands"];
        for (std::size_t i = 0; i < bands.arraySize(); ++i) readBand(bands.item(i), perception, channel);
        std::ranges::stable_sort(channel.transients, {}, &ClipTransient::seconds);
    }

    static mpeg::GridPoint point(const JsonField& vector) { return {vector["X"].wholeNumber(), vector["Y"].wholeNumber()}; }

    void readBand(const JsonField& band, const JsonField& perception, ClipChannel& channel) {
        band.expectObject();
        const auto type = static_cast<BandType>(band["band_type"].oneOf(bandTypes));
        if (type == wavelet) band["band_type"].fail("expected waves, transients or curves, found wavelets, which are not read");
        if (type == curve) isCubic_ = band.has("curve_type") && band["curve_type"].oneOf(curveTypes) == 1;
        const JsonField effects = band["effects"];
        ClipBand waves;
        for (std::size_t i = 0; i < effects.arraySize(); ++i) {
            const JsonField effect = effects.item(i);
            const double start = effect.has("position") ? seconds(effect["position"]) : 0.0;
            readEffect(referred(effect, perception), start, type, waves, channel);
        }
        keepOneAtATime(waves);
        if (!waves.waves.empty()) channel.bands.push_back(std::move(waves));
    }

    /// The effect itself, or that of the library which it names.
    JsonField referred(const JsonField& effect, const JsonField& perception) const {
        effect.expectObject();
        constexpr std::array<std::string_view, 2> types{"Basis", "Reference"};
        if (effect["effect_type"].oneOf(types) == 0) return effect;
        const auto found = library_.find(effect["id"].wholeNumber());
        if (found == library_.end()) effect["id"].fail("expected an effect of the library, found none of that number");
        const JsonField basis = perception["effect_library"].item(found->second);
        if (!basis["effect_type"].is("Basis")) basis["effect_type"].fail("expected Basis in the library");
        return basis;
    }

    void readEffect(const JsonField& effect, double start, BandType type, ClipBand& band, ClipChannel& channel) {
        ClipWave wave{start, 0.0, ClipWaveform::sine, {}, {}};
        double end = 0.0;
        const JsonField frames = effect["keyframes"];
        points_ += frames.arraySize();
        if (points_ > limits::maxClipPoints) frames.fail("expected at most " + std::to_string(limits::maxClipPoints) + " keyframes in the file, found more");
        for (std::size_t i = 0; i < frames.arraySize(); ++i) {
            const JsonField frame = frames.item(i);
            frame.expectObject();
            const double at = frame.has("relative_position") ? seconds(frame["relative_position"]) : 0.0;
            if (at < end) frame["relative_position"].fail("expected keyframes in time order");
            end = at;
            if (frame.has("amplitude_modulation")) wave.amplitude.push_back({at, gain_ * frame["amplitude_modulation"].numberWithin(-1.0, 1.0)});
            if (frame.has("frequency_modulation")) wave.frequencyHz.push_back({at, frame["frequency_modulation"].numberUpTo(limits::maxClipFrequencyHz)});
            if (type == transient && frame.has("amplitude_modulation"))
                channel.transients.push_back({start + at, wave.amplitude.back().value, frame.has("frequency_modulation") ? wave.frequencyHz.back().value : 0.0});
        }
        if (type == transient) return;
        if (wave.amplitude.empty()) wave.amplitude.push_back({0.0, gain_});
        if (wave.amplitude.back().seconds < end) wave.amplitude.push_back({end, wave.amplitude.back().value});
        if (type == curve) asCurve(wave);
        else readSignal(effect, wave);
        if (!wave.frequencyHz.empty()) band.waves.push_back(std::move(wave));
    }

    static void readSignal(const JsonField& effect, ClipWave& wave) {
        if (effect.has("phase")) wave.phaseRadians = effect["phase"].numberWithin(0.0, 2.0 * std::numbers::pi);
        if (effect.has("base_signal")) wave.waveform = static_cast<ClipWaveform>(effect["base_signal"].oneOf(mpeg::waveforms));
    }

    /// The curve is the signal: a sine that stands still at its top.
    void asCurve(ClipWave& wave) const {
        wave.phaseRadians = 0.5 * std::numbers::pi;
        wave.frequencyHz = {{0.0, 0.0}};
        if (isCubic_) wave.amplitude = smoothed(wave.amplitude);
    }

    /// Cubics that are level at every keyframe, as lines.
    static std::vector<ClipPoint> smoothed(const std::vector<ClipPoint>& keyframes) {
        constexpr int lines = 8;
        std::vector<ClipPoint> out;
        for (std::size_t i = 0; i + 1 < keyframes.size(); ++i)
            for (int k = 0; k < lines; ++k) {
                const double s = static_cast<double>(k) / lines;
                const ClipPoint &from = keyframes[i], &to = keyframes[i + 1];
                out.push_back({from.seconds + s * (to.seconds - from.seconds), from.value + s * s * (3.0 - 2.0 * s) * (to.value - from.value)});
            }
        out.push_back(keyframes.back());
        return out;
    }

    double seconds(const JsonField& ticks) const { return ticks.numberUpTo(limits::maxClipSeconds * timescale_) / timescale_; }

    static constexpr std::array<std::string_view, 2> curveTypes{"Linear", "Cubic"};
    Clip clip_;
    std::map<int, std::size_t> library_; // of this perception: where effects of a number stand
    int timescale_ = 1000;
    double gain_ = 1.0;
    bool isCubic_ = false;
    std::size_t points_ = 0;
};

} // namespace

Result<Clip> readHjif(std::string_view text, std::string_view name) {
    return readJson(text, name, limits::maxClipFileBytes, [](const Json& root) { return HjifReader{}.read({root, {}}); });
}

} // namespace physvib
