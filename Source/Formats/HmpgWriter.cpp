// SPDX-License-Identifier: MIT
// Writes .hmpg: one unit that describes all channels and bands, then one per uninterrupted stretch of sound,
// and one per silence.
#include "Formats/CurveWalk.h"
#include "Formats/HmpgFile.h"
#include "Formats/HmpgLayout.h"
#include "Formats/MpegEffects.h"
#include "Formats/MpegPlaces.h"
#include "Formats/TimeOrder.h"
#include <algorithm>
#include <numbers>
#include <utility>

namespace physvib {
namespace {

using namespace hmpg;

constexpr auto longestUnit = static_cast<std::int64_t>(most(unitDurationBits));
constexpr std::size_t framesOfAnEffect = 16'384; // a packet can hold 24,000 with frequencies
constexpr std::size_t bytesOfData = 14'000; // a packet takes no further effect beyond this: an effect has at
                                            // most 86,000, a packet 131,000

/// The wave before `seconds` and from there on, continuing its phase.
std::pair<ClipWave, ClipWave> cut(const ClipWave& wave, double seconds) {
    ClipWave head{wave.startSeconds, wave.phaseRadians, wave.waveform, {}, {}};
    const double turn = 2.0 * std::numbers::pi;
    const double phase =
        std::fmod(wave.phaseRadians + turn * CurveWalk{wave.frequencyHz}.integral(seconds), turn);
    ClipWave tail{wave.startSeconds + seconds, phase < 0.0 ? phase + turn : phase, wave.waveform, {}, {}};
    const auto divide = [=](const std::vector<ClipPoint>& curve, std::vector<ClipPoint>& before,
                            std::vector<ClipPoint>& after) {
        const ClipPoint at{seconds, valueAt(curve, seconds)};
        for (const ClipPoint& p : curve)
            if (p.seconds < seconds)
                before.push_back(p);
            else if (p.seconds > seconds)
                after.push_back({p.seconds - seconds, p.value});
        before.push_back(at);
        after.insert(after.begin(), {0.0, at.value});
    };
    divide(wave.amplitude, head.amplitude, tail.amplitude);
    divide(wave.frequencyHz, head.frequencyHz, tail.frequencyHz);
    return {std::move(head), std::move(tail)};
}

/// Divides a wave into pieces whose keyframes the format can represent.
std::vector<ClipWave> pieces(ClipWave wave) {
    constexpr double mostSeconds = static_cast<double>(most(ticksBits)) / mpeg::ticksPerSecond;
    std::vector<ClipWave> all;
    for (;;) {
        const auto manyFrom =
            std::max(wave.amplitude.size(), wave.frequencyHz.size()) > framesOfAnEffect / 2
                ? (wave.amplitude.size() > wave.frequencyHz.size() ? wave.amplitude
                                                                   : wave.frequencyHz)[framesOfAnEffect / 2]
                      .seconds
                : mostSeconds;
        const double seconds =
            static_cast<double>(mpeg::tickOf(std::min(manyFrom, mostSeconds))) / mpeg::ticksPerSecond;
        if (!(wave.seconds() > seconds) || !(seconds > 0.0)) break;
        auto [head, tail] = cut(wave, seconds);
        all.push_back(std::move(head));
        wave = std::move(tail);
    }
    all.push_back(std::move(wave));
    return all;
}

struct WrittenEffect {
    std::int64_t tick = 0;
    std::vector<mpeg::TickFrame> frames;
    double phaseRadians = 0.0;
    ClipWaveform waveform = ClipWaveform::sine;
};

/// A stretch of sound without a pause, in ticks.
struct Stretch {
    std::int64_t from = 0, to = 0;
    bool keepGoing = false; ///< a wave of the stretch before still sounds, which was too long for one unit
    std::string packets{};
};

struct WrittenBand {
    std::size_t channel = 0;
    mpeg::BandType type = mpeg::BandType::vectorial;
    std::vector<WrittenEffect> effects{};
};

/// Adds the bands of one channel; none has more effects than the format can number.
void takeBands(const ClipChannel& channel, std::size_t j, std::vector<WrittenBand>& bands) {
    const auto room = [&](mpeg::BandType type, bool isNew) -> std::vector<WrittenEffect>& {
        if (isNew || bands.back().effects.size() == most(effectBits)) bands.push_back({j, type});
        return bands.back().effects;
    };
    for (const ClipBand& band : channel.bands) {
        bool isNew = true;
        for (const ClipWave& wave : band.waves)
            for (const ClipWave& piece : pieces(wave)) {
                room(mpeg::BandType::vectorial, isNew)
                    .push_back({mpeg::tickOf(piece.startSeconds), mpeg::tickFrames(piece), piece.phaseRadians,
                                piece.waveform});
                isNew = false;
            }
    }
    for (std::size_t i = 0; i < channel.transients.size(); ++i) {
        const ClipTransient& t = channel.transients[i];
        room(mpeg::BandType::transient, i == 0)
            .push_back({mpeg::tickOf(t.seconds), {{0, t.amplitude, t.frequencyHz}}});
    }
}

class HmpgWriter {
public:
    explicit HmpgWriter(const Clip& clip)
        : clip_{clip} {
        for (std::size_t j = 0; j < clip.channels.size(); ++j) {
            takeBands(clip.channels[j], j, bands_);
            const double peak = peakOf(clip.channels[j]);
            gains_.push_back(gains.at(gains.share(peak > 0.0 ? peak : 1.0, realBits), realBits));
        }
        for (WrittenBand& band : bands_) sortByTime(band.effects, &WrittenEffect::tick);
    }

    std::string fault() const {
        if (bands_.size() > most(bandBits) + 1)
            return "expected at most " + std::to_string(most(bandBits) + 1) + " bands, found " +
                   std::to_string(bands_.size());
        for (std::size_t j = 0; j < clip_.channels.size(); ++j)
            if (std::ranges::count(bands_, j, &WrittenBand::channel) >
                static_cast<std::ptrdiff_t>(most(bandCountBits)))
                return "expected at most " + std::to_string(most(bandCountBits)) +
                       " bands in a channel, found more";
        for (const WrittenBand& band : bands_)
            for (const WrittenEffect& effect : band.effects)
                if (effect.frames.size() > framesOfAnEffect)
                    return "expected at most " + std::to_string(framesOfAnEffect) +
                           " keyframes within a tick, found more";
        return {};
    }

    std::string bytes() {
        const std::vector<Stretch> all = stretches();
        addUnit(Unit::initialization, 0,
                packet(Packet::initializationTiming, timing(all)) + packet(Packet::experience, experience()) +
                    packet(Packet::perception, perception()) + channelPackets() + bandPackets());
        std::int64_t now = 0;
        for (const Stretch& stretch : all) {
            addSilence(stretch.from - now);
            addUnit(Unit::temporal, stretch.to - stretch.from, stretch.packets, stretch.keepGoing);
            now = stretch.to;
        }
        return file_.bytes();
    }

private:
    static void addWords(BitWriter& out, std::string_view words) {
        std::size_t bytes = std::min(words.size(), most(textLengthBits));
        // not inside a UTF-8 character
        while (bytes < words.size() && bytes > 0 && (static_cast<unsigned char>(words[bytes]) & 0xc0) == 0x80)
            --bytes;
        out.number(bytes, textLengthBits);
        for (const char c : words.substr(0, bytes)) out.number(static_cast<unsigned char>(c), 8);
    }

    static std::string packet(Packet type, BitWriter content) {
        BitWriter out;
        out.number(static_cast<std::uint64_t>(type), packetTypeBits);
        out.number(content.bytes().size(), packetLengthBits);
        out.number(0, packetReservedBits);
        return out.bytes() + content.bytes();
    }

    void addUnit(Unit type, std::int64_t ticks, std::string_view packets, bool needsThoseBefore = false) {
        file_.number(static_cast<std::uint64_t>(type), unitTypeBits);
        file_.number(needsThoseBefore, syncBits);
        file_.number(0, layerBits);
        file_.number(static_cast<std::uint64_t>(ticks), unitDurationBits);
        file_.number(packets.size(), unitLengthBits);
        file_.number(0, unitReservedBits);
        file_.add(packets);
    }

    void addSilence(std::int64_t ticks) {
        for (; ticks > 0; ticks -= std::min(ticks, longestUnit))
            addUnit(Unit::silent, std::min(ticks, longestUnit), {});
    }

    static BitWriter timing(const std::vector<Stretch>& stretches) {
        std::int64_t longest = 0, shortest = longestUnit;
        for (const Stretch& stretch : stretches)
            longest = std::max(longest, stretch.to - stretch.from),
            shortest = std::min(shortest, stretch.to - stretch.from);
        BitWriter out;
        out.number(0, timeBits);
        out.number(mpeg::ticksPerSecond, timescaleBits);
        out.number(static_cast<std::uint64_t>(longest), nominalDurationBits);
        out.number(static_cast<std::uint64_t>(std::max<std::int64_t>(0, longest - shortest)),
                   durationDeviationBits);
        out.number(0, 1); // units do not overlap
        return out;
    }

    BitWriter experience() const {
        BitWriter out;
        addWords(out, mpeg::version);
        addWords(out, mpeg::profile);
        out.number(mpeg::level, 8);
        addWords(out, mpeg::date);
        addWords(out, clip_.title);
        out.number(1, 8); // perceptions
        out.number(1, 8); // avatars
        constexpr int vibration = 1;
        out.number(1, avatarBits);
        out.number(0, 8); // level of detail
        out.number(vibration, 8);
        return out;
    }

    BitWriter perception() const {
        constexpr std::uint64_t thousandths = 0xfd; // -3: metres in mm
        BitWriter out;
        out.number(0, perceptionBits + priorityBits);
        addWords(out, clip_.title);
        out.number(vibrotactile, modalityBits);
        out.number(1, avatarBits);
        out.number(0, libraryCountBits);
        out.number(0, 1); // no semantic description
        out.number(thousandths, exponentBits);
        out.number(0, exponentBits);
        out.number(clip_.channels.size(), deviceCountBits);
        for (std::size_t j = 0; j < clip_.channels.size(); ++j) addDevice(out, j);
        out.number(clip_.channels.size(), channelCountBits);
        return out;
    }

    void addDevice(BitWriter& out, std::size_t j) const {
        const ClipChannel& channel = clip_.channels[j];
        out.number(j + 1, deviceBits);
        addWords(out, channel.label);
        out.number(0, bodyMaskBits);
        const double facts[] = {channel.device.highHz, channel.device.lowHz, channel.device.resonanceHz,
                                channel.device.fullScaleG * 9.80665};
        for (const double fact : facts) out.number(fact > 0.0, 1);
        out.number(0, deviceMaskBits - static_cast<int>(std::size(facts)));
        for (const double fact : facts)
            if (fact > 0.0) out.share(fact, realBits, positives);
    }

    std::string channelPackets() const {
        std::string all;
        for (std::size_t j = 0; j < clip_.channels.size(); ++j)
            all += packet(Packet::channel, channelContent(j));
        return all;
    }

    BitWriter channelContent(std::size_t j) const {
        const ClipChannel& channel = clip_.channels[j];
        BitWriter out;
        out.number(j, channelBits);
        out.number(0, perceptionBits + priorityBits);
        addWords(out, channel.label);
        out.number(j + 1, deviceBits);
        out.share(gains_[j], realBits, gains);
        out.share(1.0, realBits, positives); // mixing weight
        out.number(channel.place ? hasActuators : 0, channelMaskBits);
        if (channel.place) {
            const mpeg::PlaceGrid grid{clip_};
            addPoint(out, grid.points, 1);
            out.number(0, targetCountBits); // no body parts
            out.number(1, targetCountBits);
            addPoint(out, grid.at(*channel.place), 0);
        }
        out.number(0, samplingBits);
        out.number(0, vertexCountBits);
        out.number(static_cast<std::uint64_t>(std::ranges::count(bands_, j, &WrittenBand::channel)),
                   bandCountBits);
        return out;
    }

    static void addPoint(BitWriter& out, mpeg::GridPoint p, int z) {
        for (const int axis : {p.x, p.y, z}) out.number(static_cast<std::uint64_t>(axis), axisBits);
    }

    std::string bandPackets() const {
        constexpr int topHz = 1000; // the tactile range
        std::string all;
        for (std::size_t b = 0; b < bands_.size(); ++b) {
            BitWriter out;
            out.number(b, bandBits);
            out.number(0, perceptionBits);
            out.number(bands_[b].channel, channelBits);
            out.number(0, priorityBits);
            out.number(static_cast<std::uint64_t>(bands_[b].type), bandTypeBits);
            out.number(0, bandLimitBits);
            out.number(topHz, bandLimitBits);
            out.number(bands_[b].effects.size(), effectCountBits);
            all += packet(Packet::band, std::move(out));
        }
        return all;
    }

    static std::int64_t endOf(const WrittenBand& band, const WrittenEffect& effect) {
        constexpr auto knock = static_cast<std::int64_t>(ClipTransient::lastsSeconds * mpeg::ticksPerSecond);
        const std::int64_t last = effect.frames.empty() ? 0 : effect.frames.back().ticks;
        return effect.tick + std::max<std::int64_t>(1, band.type == mpeg::BandType::transient ? knock : last);
    }

    std::vector<Stretch> stretches() const {
        std::vector<Stretch> parts, all;
        for (const WrittenBand& band : bands_)
            for (const WrittenEffect& effect : band.effects)
                parts.push_back({effect.tick, endOf(band, effect)});
        std::ranges::sort(parts, {}, &Stretch::from);
        for (Stretch& part : parts) {
            const bool touches = !all.empty() && part.from < all.back().to;
            if (touches && part.to - all.back().from <= longestUnit) {
                all.back().to = std::max(all.back().to, part.to);
                continue;
            }
            if (touches) all.back().to = part.from;
            part.keepGoing = touches;
            all.push_back(std::move(part));
        }
        for (std::size_t b = 0; b < bands_.size(); ++b) addData(b, all);
        return all;
    }

    void addData(std::size_t b, std::vector<Stretch>& stretches) const {
        const std::vector<WrittenEffect>& effects = bands_[b].effects;
        auto stretch = stretches.begin();
        for (std::size_t i = 0; i < effects.size();) {
            while (effects[i].tick >= stretch->to) ++stretch;
            const std::size_t from = i;
            std::size_t bits = 0;
            do bits += effectSize(effects[i++]);
            while (i < effects.size() && effects[i].tick < stretch->to && bits < 8 * bytesOfData);
            stretch->packets += packet(Packet::data, dataContent(b, from, i, stretch->from));
        }
    }

    static std::size_t effectSize(const WrittenEffect& effect) {
        return 80 + effect.frames.size() * (2 + amplitudeBits + ticksBits + hertzBits);
    }

    BitWriter dataContent(std::size_t b, std::size_t from, std::size_t to, std::int64_t startTick) const {
        const WrittenBand& band = bands_[b];
        BitWriter out;
        out.number(0, 1); // random access point
        out.number(0, perceptionBits);
        out.number(band.channel, channelBits);
        out.number(b, bandBits);
        out.number(to - from, effectCountBits);
        for (std::size_t i = from; i < to; ++i) addEffect(out, i, band, startTick);
        return out;
    }

    void addEffect(BitWriter& out, std::size_t i, const WrittenBand& band, std::int64_t startTick) const {
        const WrittenEffect& effect = band.effects[i];
        out.number(i, effectBits);
        out.number(static_cast<std::uint64_t>(EffectType::basis), effectTypeBits);
        out.number(static_cast<std::uint64_t>(effect.tick - startTick), positionBits);
        out.number(0, 1); // no semantic description
        out.number(effect.frames.size(), keyframeCountBits);
        const bool isWave = band.type == mpeg::BandType::vectorial;
        if (isWave) {
            out.share(effect.phaseRadians, phaseBits, phases);
            out.number(static_cast<std::uint64_t>(effect.waveform), waveformBits);
        }
        for (const mpeg::TickFrame& frame : effect.frames) {
            if (isWave)
                out.number((frame.amplitude ? hasAmplitude : 0) | (frame.frequencyHz ? hasFrequency : 0), 2);
            if (frame.amplitude)
                out.share(*frame.amplitude / gains_[band.channel], amplitudeBits, amplitudes);
            out.number(static_cast<std::uint64_t>(frame.ticks), ticksBits);
            if (frame.frequencyHz)
                out.number(static_cast<std::uint64_t>(std::llround(*frame.frequencyHz)), hertzBits);
        }
    }

    const Clip& clip_;
    std::vector<WrittenBand> bands_;
    std::vector<double> gains_; // per channel, as they will be read: the largest amplitudes
    BitWriter file_;
};

} // namespace

Result<std::string> hmpgBytes(const Clip& clip) {
    HmpgWriter writer{clip};
    if (const std::string fault = writer.fault(); !fault.empty()) return Failure{fault};
    return writer.bytes();
}

double hmpgStep(const Clip& clip) noexcept {
    double peak = 0.0;
    for (const ClipChannel& channel : clip.channels) peak = std::max(peak, peakOf(channel));
    return peak / BitRange::top(amplitudeBits); // half a step of the range from -peak to peak
}

} // namespace physvib
