// SPDX-License-Identifier: MIT
// Reads .hmpg unit by unit, packet by packet. Data of a band is kept until the end, because an effect may
// continue in a later unit.
#include "Formats/ClipLimits.h"
#include "Formats/HmpgFile.h"
#include "Formats/HmpgLayout.h"
#include "Formats/MpegEffects.h"
#include "Formats/MpegPlaces.h"
#include "Formats/TimeOrder.h"
#include "Io/Text/NumberText.h"
#include <algorithm>
#include <map>

namespace physvib {
namespace {

using namespace hmpg;

constexpr int deepestLibrary = 8; // maximum nesting of effects, which are skipped

class HmpgReader {
public:
    Clip read(BitReader file) {
        while (!file.isOver()) readUnit(file);
        for (auto& [id, told] : bands_) finish(told);
        for (ClipChannel& channel : clip_.channels) sortByTime(channel.transients, &ClipTransient::seconds);
        return std::move(clip_);
    }

private:
    struct ToldEffect {
        double startSeconds = 0.0;
        mpeg::Effect effect{};
    };
    struct ToldChannel {
        std::size_t index = 0; // index in the clip
        double gain = 1.0;
    };
    struct ToldBand {
        std::uint32_t perception = 0;
        ToldChannel channel;
        mpeg::BandKind kind;
        std::vector<ToldEffect> effects{};
        std::map<std::uint32_t, std::size_t> byId{}; // effects that may continue
    };
    using Library = std::map<std::uint32_t, mpeg::Effect>;

    void readUnit(BitReader& file) {
        const BitReader at = file;
        const std::uint32_t type = file.number(unitTypeBits);
        if (type > static_cast<std::uint32_t>(Unit::silent))
            at.fail("expected a unit of type 0 to 3, found " + std::to_string(type));
        if (timescale_ == 0 && type != static_cast<std::uint32_t>(Unit::initialization))
            at.fail("expected a unit of type 0 first, found " + std::to_string(type));
        file.skip(syncBits + layerBits);
        const std::uint32_t ticks = file.number(unitDurationBits), bytes = file.number(unitLengthBits);
        file.skip(unitReservedBits);
        for (BitReader unit = file.part(bytes); !unit.isOver();) readPacket(unit, static_cast<Unit>(type));
        if (timescale_ == 0) at.fail("expected a timescale in the first unit");
        ticks_ += ticks;
    }

    void readPacket(BitReader& unit, Unit type) {
        const auto kind = static_cast<Packet>(unit.number(packetTypeBits));
        const std::uint32_t bytes = unit.number(packetLengthBits);
        unit.skip(packetReservedBits);
        BitReader packet = unit.part(bytes);
        switch (kind) {
        case Packet::initializationTiming: return readTiming(packet);
        case Packet::experience: return readExperience(packet);
        case Packet::perception: return readPerception(packet);
        case Packet::library: return readLibrary(packet);
        case Packet::channel: return readChannel(packet);
        case Packet::band: return readBand(packet);
        case Packet::data: return type == Unit::temporal ? readData(packet) : void();
        default: return; // not tactile
        }
    }

    static std::string words(BitReader& packet) {
        return cleanLine(packet.text(packet.number(textLengthBits)));
    }

    void readTiming(BitReader& packet) {
        ticks_ = packet.number(timeBits);
        const std::uint32_t found = packet.number(timescaleBits);
        if (found < 1 || (timescale_ != 0 && found != timescale_))
            packet.fail("expected one timescale of at least a tick per second, found " +
                        std::to_string(found));
        timescale_ = found;
    }

    void readExperience(BitReader& packet) {
        words(packet), words(packet); // version, profile
        packet.skip(8);               // level
        words(packet);                // date
        clip_.title = words(packet);
    }

    void readPerception(BitReader& packet) {
        const std::uint32_t id = packet.number(perceptionBits);
        packet.skip(priorityBits);
        words(packet);
        if (packet.number(modalityBits) == vibrotactile) libraries_.try_emplace(id);
    }

    void readLibrary(BitReader& packet) {
        const auto library = libraries_.find(packet.number(perceptionBits));
        if (library == libraries_.end()) return;
        for (std::uint32_t left = packet.number(libraryCountBits); left > 0; --left)
            readLibraryEffect(packet, library->second, 0);
    }

    void readLibraryEffect(BitReader& packet, Library& library, int depth) {
        if (depth > deepestLibrary)
            packet.fail("expected effects within effects to be fewer, found more than " +
                        std::to_string(deepestLibrary));
        const std::uint32_t id = packet.number(effectBits);
        const auto type = static_cast<EffectType>(packet.number(effectTypeBits));
        if (packet.number(1) != 0) packet.skip(semanticBits);
        packet.skip(positionBits);
        expectFew(packet, 1);
        mpeg::Effect effect;
        if (type == EffectType::basis) readSignal(packet, effect);
        for (std::uint32_t left = packet.number(keyframeCountBits); left > 0; --left) {
            const std::uint32_t mask = packet.number(3);
            mpeg::Keyframe frame;
            if ((mask & libraryHasTicks) != 0) frame.seconds = seconds(packet.number(ticksBits));
            if ((mask & libraryHasAmplitude) != 0) frame.amplitude = packet.share(amplitudeBits, amplitudes);
            if ((mask & libraryHasFrequency) != 0) frame.frequencyHz = packet.number(hertzBits);
            add(packet, effect, frame);
        }
        for (std::uint32_t left = packet.number(timelineCountBits); left > 0; --left)
            readLibraryEffect(packet, library, depth + 1);
        if (type == EffectType::basis && depth == 0) library.insert_or_assign(id, std::move(effect));
    }

    static void readSignal(BitReader& packet, mpeg::Effect& effect) {
        effect.phaseRadians = packet.share(phaseBits, phases);
        const std::uint32_t waveform = packet.number(waveformBits);
        if (waveform >= mpeg::waveforms.size())
            packet.fail("expected a base signal from 0 to 4, found " + std::to_string(waveform));
        effect.waveform = static_cast<ClipWaveform>(waveform);
    }

    void readChannel(BitReader& packet) {
        const std::uint32_t id = packet.number(channelBits);
        // repeated at a later time
        if (!libraries_.contains(packet.number(perceptionBits)) || channels_.contains(id)) return;
        if (clip_.channels.size() == static_cast<std::size_t>(limits::maxEnchanters))
            packet.fail("expected at most " + std::to_string(limits::maxEnchanters) +
                        " channels, found more");
        packet.skip(priorityBits);
        ClipChannel channel;
        channel.label = words(packet);
        packet.skip(deviceBits);
        const double gain = packet.share(realBits, gains);
        constexpr double rounding = 1e-5; // tolerance for its 32 bits
        if (!(gain >= -rounding && gain <= limits::maxClipAmplitude + rounding))
            packet.fail("expected a gain from 0 to " + plainNumber(limits::maxClipAmplitude) + ", found " +
                        numberText(gain));
        packet.skip(realBits); // mixing weight
        const std::uint32_t mask = packet.number(channelMaskBits);
        if ((mask & hasBodyMask) != 0) packet.skip(bodyMaskBits);
        if ((mask & hasActuators) != 0) readPlace(packet, channel);
        channels_.emplace(
            id, ToldChannel{clip_.channels.size(), std::clamp(gain, 0.0, limits::maxClipAmplitude)});
        clip_.channels.push_back(std::move(channel));
    }

    static mpeg::GridPoint point(BitReader& packet) {
        const mpeg::GridPoint found{packet.signedNumber(axisBits), packet.signedNumber(axisBits)};
        packet.skip(axisBits); // z
        return found;
    }

    void readPlace(BitReader& packet, ClipChannel& channel) {
        const mpeg::GridPoint points = point(packet);
        packet.skip(8 * packet.number(targetCountBits)); // body parts
        if (packet.number(targetCountBits) == 1) mpeg::takePlace(clip_, channel, points, point(packet));
    }

    void readBand(BitReader& packet) {
        const std::uint32_t id = packet.number(bandBits), perception = packet.number(perceptionBits);
        if (!libraries_.contains(perception) || bands_.contains(id)) return;
        const auto channel = channels_.find(packet.number(channelBits));
        if (channel == channels_.end()) packet.fail("expected a band of a channel that was told before");
        packet.skip(priorityBits);
        ToldBand band{
            perception,
            channel->second,
            {static_cast<mpeg::BandType>(packet.number(bandTypeBits)), false, channel->second.gain}};
        if (band.kind.type == mpeg::BandType::wavelet) packet.fail(std::string(mpeg::noWavelets));
        if (band.kind.type > mpeg::BandType::wavelet)
            packet.fail("expected a band of type 0 to 2, found " +
                        std::to_string(static_cast<int>(band.kind.type)));
        if (band.kind.type == mpeg::BandType::curve) {
            const auto curve = static_cast<CurveType>(packet.number(curveTypeBits));
            if (curve > CurveType::linear) packet.fail("expected a curve that is cubic or linear");
            band.kind.isCubic = curve == CurveType::cubic;
        }
        bands_.emplace(id, std::move(band));
    }

    void readData(BitReader& packet) {
        packet.skip(1); // whether it is a random access point
        if (!libraries_.contains(packet.number(perceptionBits))) return;
        packet.skip(channelBits);
        const auto band = bands_.find(packet.number(bandBits));
        if (band == bands_.end()) packet.fail("expected data of a band that was told before");
        for (std::uint32_t left = packet.number(effectCountBits); left > 0; --left)
            readEffect(packet, band->second);
    }

    void readEffect(BitReader& packet, ToldBand& band) {
        const std::uint32_t id = packet.number(effectBits);
        const auto type = static_cast<EffectType>(packet.number(effectTypeBits));
        const double start = seconds(ticks_ + packet.signedNumber(positionBits));
        if (type == EffectType::reference) return refer(packet, band, id, start);
        if (type != EffectType::basis) packet.fail("expected one effect, found a composite");
        if (packet.number(1) != 0) packet.skip(semanticBits);
        const auto [known, isNew] = band.byId.try_emplace(id, band.effects.size());
        if (isNew) expectFew(packet, 1), band.effects.push_back({begins(packet, start), {}});
        mpeg::Effect& effect = band.effects[known->second].effect;
        const std::uint32_t frames = packet.number(keyframeCountBits);
        if (band.kind.type == mpeg::BandType::vectorial) readSignal(packet, effect);
        for (std::uint32_t left = frames; left > 0; --left)
            add(packet, effect, keyframe(packet, band.kind.type));
    }

    void refer(BitReader& packet, ToldBand& band, std::uint32_t id, double start) {
        const Library& library = libraries_.at(band.perception);
        const auto found = library.find(id);
        if (found == library.end())
            packet.fail("expected an effect of the library, found none of that number");
        expectFew(packet, 1 + found->second.keyframes.size());
        band.effects.push_back({begins(packet, start), found->second});
    }

    mpeg::Keyframe keyframe(BitReader& packet, mpeg::BandType type) const {
        const bool isWave = type == mpeg::BandType::vectorial;
        const std::uint32_t mask = isWave                          ? packet.number(2)
                                   : type == mpeg::BandType::curve ? hasAmplitude
                                                                   : hasAmplitude | hasFrequency;
        mpeg::Keyframe frame;
        if ((mask & hasAmplitude) != 0) frame.amplitude = packet.share(amplitudeBits, amplitudes);
        frame.seconds = seconds(packet.number(ticksBits));
        if ((mask & hasFrequency) != 0) frame.frequencyHz = packet.number(hertzBits);
        return frame;
    }

    void add(const BitReader& packet, mpeg::Effect& effect, const mpeg::Keyframe& frame) {
        if (!effect.keyframes.empty() && frame.seconds < effect.keyframes.back().seconds)
            packet.fail(std::string(mpeg::inTimeOrder));
        expectFew(packet, 1);
        effect.keyframes.push_back(frame);
    }

    /// An effect counts like a keyframe.
    void expectFew(const BitReader& packet, std::size_t more) {
        points_ += more;
        if (points_ > limits::maxClipPoints)
            packet.fail("expected at most " + std::to_string(limits::maxClipPoints) +
                        " effects and keyframes in the file, found more");
    }

    static double begins(const BitReader& packet, double start) {
        if (!(start >= 0.0 && start <= limits::maxClipSeconds))
            packet.fail("expected an effect that begins within 0 to " + plainNumber(limits::maxClipSeconds) +
                        " s, found " + numberText(start));
        return start;
    }

    void finish(const ToldBand& told) {
        ClipChannel& channel = clip_.channels[told.channel.index];
        ClipBand band;
        for (const ToldEffect& one : told.effects)
            mpeg::takeEffect(one.effect, one.startSeconds, told.kind, band, channel);
        keepOneAtATime(band);
        if (!band.waves.empty()) channel.bands.push_back(std::move(band));
    }

    double seconds(std::int64_t ticks) const {
        return timescale_ == 0 ? 0.0 : static_cast<double>(ticks) / timescale_;
    }

    Clip clip_;
    std::map<std::uint32_t, Library> libraries_; // of the vibrotactile perceptions
    std::map<std::uint32_t, ToldChannel> channels_;
    std::map<std::uint32_t, ToldBand> bands_;
    std::uint32_t timescale_ = 0;
    std::int64_t ticks_ = 0; // start of this unit
    std::size_t points_ = 0;
};

} // namespace

Result<Clip> readHmpg(std::string_view bytes, std::string_view name) {
    const std::string file{name};
    if (bytes.size() > limits::maxClipFileBytes)
        return Failure{file + ": expected at most " + std::to_string(limits::maxClipFileBytes) +
                       " bytes, found " + std::to_string(bytes.size())};
    if (const std::size_t first = bytes.find_first_not_of(" \t\r\n");
        first != std::string_view::npos && bytes[first] == '{')
        return Failure{file + ": expected the bits of an .hmpg, found JSON: this looks like .hjif"};
    try {
        Clip clip = HmpgReader{}.read(BitReader{bytes});
        if (clip.channels.empty())
            return Failure{file + ": expected a vibrotactile perception with channels, found none"};
        if (const std::string fault = clipFault(clip); !fault.empty()) return Failure{file + ": " + fault};
        return clip;
    } catch (const BitFault& fault) {
        return Failure{file + ": " + fault.what()};
    }
}

} // namespace physvib
