// SPDX-License-Identifier: MIT
// Selects the reader or writer of a format, and reports what a format cannot store.
#include "Formats/ClipFile.h"
#include "Formats/EnvelopeFile.h"
#include "Io/Disk/ReadFile.h"

namespace physvib {
namespace {

struct ClipProperties {
    std::set<double> frequenciesHz;
    double peak = 0.0;
    bool hasOverlaps = false; ///< a channel has more than one wave at a time
};

ClipProperties findProperties(const Clip& clip) {
    ClipProperties properties;
    for (const ClipChannel& channel : clip.channels) {
        properties.hasOverlaps = properties.hasOverlaps || channel.bands.size() > 1;
        properties.peak = std::max(properties.peak, peakAmplitude(channel));
        for (const ClipTransient& t : channel.transients) properties.frequenciesHz.insert(t.frequencyHz);
        for (const ClipBand& band : channel.bands)
            for (const ClipWave& wave : band.waves)
                for (const ClipPoint& p : wave.frequencyHz) properties.frequenciesHz.insert(p.value);
    }
    return properties;
}

std::vector<std::string> monoLosses(const ClipProperties& properties, const FrequencyScale& scale) {
    std::vector<std::string> losses{"where a hit was is not carried"};
    if (properties.hasOverlaps)
        losses.push_back("modes that sound at once become one envelope, at the mean of their frequencies");
    const auto outside = std::ranges::count_if(
        properties.frequenciesHz, [&](double hz) { return hz < scale.lowHz || hz > scale.highHz; });
    if (outside > 0)
        losses.push_back(std::to_string(outside) + " of " + std::to_string(properties.frequenciesHz.size()) +
                         " frequencies lie outside " + fixedNumber(scale.lowHz, 0) + " to " +
                         fixedNumber(scale.highHz, 0) + " Hz and become its ends");
    if (properties.peak > 1.0)
        losses.push_back("what is above full scale is cut to it: the strongest is " +
                         fixedNumber(properties.peak, 2));
    return losses;
}

} // namespace

std::optional<ClipFormat> findClipFormat(std::string_view path) noexcept {
    const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; };
    for (std::size_t i = 0; i < writableEndings.size(); ++i)
        if (const std::string_view ending = writableEndings[i];
            path.size() > ending.size() &&
            std::ranges::equal(path.substr(path.size() - ending.size()), ending, {}, lower))
            return static_cast<ClipFormat>(i);
    return {};
}

Result<Clip> readClip(std::string_view bytes, std::string_view name, ClipFormat format,
                      const FrequencyScale& scale) {
    switch (format) {
    case ClipFormat::haptic: return readMetaHaptic(bytes, name, scale);
    case ClipFormat::ahap: return readAhap(bytes, name, scale);
    case ClipFormat::envelope:
        return Failure{std::string{name} + ": Android's envelopes are written, not read"};
    default: return readHjif(bytes, name);
    }
}

Result<Clip> loadClip(const std::filesystem::path& path, ClipFormat format, const FrequencyScale& scale) {
    return loadText(path, limits::maxClipFileBytes, [&](std::string_view bytes, std::string_view name) {
        return readClip(bytes, name, format, scale);
    });
}

std::string clipBytes(const Clip& clip, ClipFormat format, const FrequencyScale& scale) {
    switch (format) {
    case ClipFormat::haptic: return metaHapticText(clip.channels.front(), clip.title, scale);
    case ClipFormat::ahap: return ahapText(clip.channels.front(), clip.title, scale);
    case ClipFormat::envelope: return envelopeText(clip.channels.front(), clip.title, scale);
    default: return hjifText(clip);
    }
}

std::vector<std::string> clipLosses(const Clip& clip, ClipFormat format, const FrequencyScale& scale) {
    const ClipProperties properties = findProperties(clip);
    if (format == ClipFormat::hjif) return hjifLosses(clip, properties.frequenciesHz);
    std::vector<std::string> losses = monoLosses(properties, scale);
    const std::size_t raised = format == ClipFormat::haptic && !clip.channels.empty()
                                   ? raisedTransientCount(clip.channels.front())
                                   : 0;
    if (raised > 0)
        losses.push_back(std::to_string(raised) +
                         " transients are weaker than what sounds beside them and become as strong as it");
    return losses;
}

} // namespace physvib
