// SPDX-License-Identifier: MIT
// Reads .hjif field by field after MPEG's schema: perceptions, channels, bands, effects, keyframes.
#include "Formats/ClipLimits.h"
#include "Formats/HjifFile.h"
#include "Formats/LeftOut.h"
#include "Formats/MpegEffects.h"
#include "Formats/MpegPlaces.h"
#include "Formats/TimeOrder.h"
#include "Io/Json/JsonField.h"
#include "Io/Json/JsonText.h"
#include <map>
#include <numbers>

namespace physvib {
namespace {

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
        if (auto fault = clipFault(clip_); !fault.empty()) perceptions.fail(fault);
        clip_.leftOut = leftOut_.line();
        return std::move(clip_);
    }

private:
    void readPerception(const JsonField& perception) {
        perception.expectObject();
        if (!isVibrotactile(perception))
            return leftOut_.add("a perception of " + perception["perception_modality"].line()); // actuators
                                                                                                // cannot play
                                                                                                // it
        library_.clear();
        for (std::size_t i = 0;
             perception.has("effect_library") && i < perception["effect_library"].arraySize(); ++i) {
            const JsonField effect = perception["effect_library"].item(i);
            library_.insert_or_assign(effect["id"].wholeNumber(), i);
        }
        const JsonField channels = perception["channels"];
        if (clip_.channels.size() + channels.arraySize() > static_cast<std::size_t>(limits::maxEnchanters))
            channels.fail("expected at most " + std::to_string(limits::maxEnchanters) +
                          " channels, found more");
        for (std::size_t i = 0; i < channels.arraySize(); ++i) readChannel(channels.item(i), perception);
    }

    /// Includes "Other" with waves or transients, which MPEG's encoder writes for every .ahap, but not with
    /// wavelets, whose meaning is unknown.
    static bool isVibrotactile(const JsonField& perception) {
        const JsonField modality = perception["perception_modality"];
        if (!modality.is("Other") || !perception.has("channels")) return modality.is("Vibrotactile");
        bool isFelt = false;
        for (std::size_t i = 0; i < perception["channels"].arraySize(); ++i) {
            const JsonField bands = perception["channels"].item(i)["bands"];
            for (std::size_t j = 0; j < bands.arraySize(); ++j) {
                const JsonField type = bands.item(j)["band_type"];
                if (type.is("WaveletWave")) return false;
                isFelt = isFelt || type.is("VectorialWave") || type.is("Transient");
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
            mpeg::takePlace(clip_, channel, point(json["actuator_resolution"]),
                            point(json["actuator_target"].item(0)));
        gain_ = json.has("gain") ? json["gain"].numberWithin(0.0, limits::maxClipAmplitude) : 1.0;
        const JsonField bands = json["bands"];
        for (std::size_t i = 0; i < bands.arraySize(); ++i) readBand(bands.item(i), perception, channel);
        sortByTime(channel.transients, &ClipTransient::seconds);
    }

    static mpeg::GridPoint point(const JsonField& vector) {
        return {vector["X"].wholeNumber(), vector["Y"].wholeNumber()};
    }

    void readBand(const JsonField& json, const JsonField& perception, ClipChannel& channel) {
        json.expectObject();
        mpeg::BandKind kind{static_cast<mpeg::BandType>(json["band_type"].oneOf(mpeg::bandTypes)), false,
                            gain_};
        if (kind.type == mpeg::BandType::wavelet) json["band_type"].fail(std::string(mpeg::noWavelets));
        if (kind.type == mpeg::BandType::curve)
            kind.isCubic = json.has("curve_type") && json["curve_type"].oneOf(curveTypes) == 1;
        const JsonField effects = json["effects"];
        ClipBand band;
        for (std::size_t i = 0; i < effects.arraySize(); ++i) {
            const JsonField effect = effects.item(i);
            const double start = effect.has("position") ? seconds(effect["position"]) : 0.0;
            mpeg::takeEffect(effectOf(referred(effect, perception), kind.type), start, kind, band, channel);
        }
        keepOneAtATime(band);
        if (!band.waves.empty()) channel.bands.push_back(std::move(band));
    }

    /// The effect itself, or the library's effect that it refers to.
    JsonField referred(const JsonField& effect, const JsonField& perception) const {
        effect.expectObject();
        constexpr std::array<std::string_view, 2> types{"Basis", "Reference"};
        if (effect["effect_type"].oneOf(types) == 0) return effect;
        const auto found = library_.find(effect["id"].wholeNumber());
        if (found == library_.end())
            effect["id"].fail("expected an effect of the library, found none of that number");
        const JsonField basis = perception["effect_library"].item(found->second);
        if (!basis["effect_type"].is("Basis")) basis["effect_type"].fail("expected Basis in the library");
        return basis;
    }

    mpeg::Effect effectOf(const JsonField& json, mpeg::BandType type) {
        mpeg::Effect effect;
        const JsonField frames = json["keyframes"];
        points_ += frames.arraySize();
        if (points_ > limits::maxClipPoints)
            frames.fail("expected at most " + std::to_string(limits::maxClipPoints) +
                        " keyframes in the file, found more");
        for (std::size_t i = 0; i < frames.arraySize(); ++i) {
            const JsonField frame = frames.item(i);
            frame.expectObject();
            mpeg::Keyframe key{
                frame.has("relative_position") ? seconds(frame["relative_position"]) : 0.0, {}, {}};
            if (!effect.keyframes.empty() && key.seconds < effect.keyframes.back().seconds)
                frame["relative_position"].fail(std::string(mpeg::inTimeOrder));
            if (frame.has("amplitude_modulation"))
                key.amplitude = frame["amplitude_modulation"].numberWithin(-1.0, 1.0);
            if (frame.has("frequency_modulation"))
                key.frequencyHz = frame["frequency_modulation"].numberUpTo(limits::maxClipFrequencyHz);
            effect.keyframes.push_back(key);
        }
        if (type != mpeg::BandType::vectorial) return effect;
        if (json.has("phase")) effect.phaseRadians = json["phase"].numberWithin(0.0, 2.0 * std::numbers::pi);
        if (json.has("base_signal"))
            effect.waveform = static_cast<ClipWaveform>(json["base_signal"].oneOf(mpeg::waveforms));
        return effect;
    }

    double seconds(const JsonField& ticks) const {
        return ticks.numberUpTo(limits::maxClipSeconds * timescale_) / timescale_;
    }

    static constexpr std::array<std::string_view, 2> curveTypes{"Linear", "Cubic"};
    Clip clip_;
    LeftOut leftOut_;
    std::map<int, std::size_t> library_; // of this perception: index of an effect by its number
    int timescale_ = 1000;
    double gain_ = 1.0;
    std::size_t points_ = 0;
};

} // namespace

Result<Clip> readHjif(std::string_view text, std::string_view name) {
    return readJson(text, name, limits::maxClipFileBytes, [](const Json& root) {
        return HjifReader{}.read({root, {}});
    });
}

} // namespace physvib
