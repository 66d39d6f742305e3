// SPDX-License-Identifier: MIT
// Selects the reader or writer of a format, and reports what a format cannot store.
#include "Formats/ClipFile.h"
#include "Formats/AhapFile.h"
#include "Formats/ClipLimits.h"
#include "Formats/HjifFile.h"
#include "Formats/HmpgFile.h"
#include "Formats/MetaHapticFile.h"
#include "Formats/MpegPlaces.h"
#include "Io/Disk/ReadFile.h"
#include "Io/Text/NumberText.h"
#include <cmath>
#include <set>

namespace physvib {
namespace {

struct Facts {
    std::set<double> frequenciesHz;
    double peak = 0.0;
    bool overlaps = false; ///< a channel has more than one wave at a time
};

Facts factsOf(const Clip& clip) {
    Facts facts;
    for (const ClipChannel& channel : clip.channels) {
        facts.overlaps = facts.overlaps || channel.bands.size() > 1;
        facts.peak = std::max(facts.peak, peakOf(channel));
        for (const ClipTransient& t : channel.transients) facts.frequenciesHz.insert(t.frequencyHz);
        for (const ClipBand& band : channel.bands)
            for (const ClipWave& wave : band.waves)
                for (const ClipPoint& p : wave.frequencyHz) facts.frequenciesHz.insert(p.value);
    }
    return facts;
}

/// Largest displacement of a place by the grid.
double farthestFromGrid(const Clip& clip) {
    const mpeg::PlaceGrid grid{clip};
    double most = 0.0;
    for (const ClipChannel& channel : clip.channels)
        if (channel.place) {
            const mpeg::GridPoint at = grid.at(*channel.place);
            most = std::max({most, std::abs(at.x * grid.pitchMetres - channel.place->xMetres),
                             std::abs(at.y * grid.pitchMetres - channel.place->yMetres)});
        }
    return most;
}

std::string placeLoss(const Clip& clip) {
    const double metres = farthestFromGrid(clip);
    return metres > 1e-6 ? "places are moved by up to " + fixedNumber(1e3 * metres, 2) +
                               " mm, onto a grid of at most 127 points"
                         : "";
}

std::vector<std::string> hjifLosses(const Clip& clip, const Facts& facts) {
    std::vector<std::string> losses;
    if (const std::string loss = placeLoss(clip); !loss.empty()) losses.push_back(loss);
    const auto broken =
        std::ranges::find_if(facts.frequenciesHz, [](double hz) { return hz != std::floor(hz); });
    if (broken != facts.frequenciesHz.end())
        losses.push_back("MPEG's own decoder cuts frequencies to whole Hz, as of " + fixedNumber(*broken, 2) +
                         " Hz; ours does not");
    return losses;
}

std::vector<std::string> hmpgLosses(const Clip& clip, const Facts& facts) {
    std::vector<std::string> losses{"amplitudes have 8 bits: each wave is within " +
                                    fixedNumber(hmpgStep(clip), 5) +
                                    " of what it was, in shares of full scale"};
    if (const std::string loss = placeLoss(clip); !loss.empty()) losses.push_back(loss);
    double farthest = 0.0;
    for (const double hz : facts.frequenciesHz) farthest = std::max(farthest, std::abs(hz - std::round(hz)));
    if (farthest > 0.0)
        losses.push_back("frequencies are whole Hz: they are moved by up to " + fixedNumber(farthest, 2) +
                         " Hz");
    return losses;
}

std::vector<std::string> monoLosses(const Facts& facts, const FrequencyScale& scale) {
    std::vector<std::string> losses{"where a hit was is not carried"};
    if (facts.overlaps)
        losses.push_back("modes that sound at once become one envelope, at the mean of their frequencies");
    const auto outside = std::ranges::count_if(
        facts.frequenciesHz, [&](double hz) { return hz < scale.lowHz || hz > scale.highHz; });
    if (outside > 0)
        losses.push_back(std::to_string(outside) + " of " + std::to_string(facts.frequenciesHz.size()) +
                         " frequencies lie outside " + fixedNumber(scale.lowHz, 0) + " to " +
                         fixedNumber(scale.highHz, 0) + " Hz and become its ends");
    if (facts.peak > 1.0)
        losses.push_back("what is above full scale is cut to it: the strongest is " +
                         fixedNumber(facts.peak, 2));
    return losses;
}

} // namespace

std::optional<ClipFormat> clipFormatOf(std::string_view path) noexcept {
    const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; };
    for (std::size_t i = 0; i < clipEndings.size(); ++i)
        if (path.size() > clipEndings[i].size() &&
            std::ranges::equal(path.substr(path.size() - clipEndings[i].size()), clipEndings[i], {}, lower))
            return static_cast<ClipFormat>(i);
    return {};
}

Result<Clip> readClip(std::string_view bytes, std::string_view name, ClipFormat format,
                      const FrequencyScale& scale) {
    switch (format) {
    case ClipFormat::hmpg: return readHmpg(bytes, name);
    case ClipFormat::haptic: return readMetaHaptic(bytes, name, scale);
    case ClipFormat::ahap: return readAhap(bytes, name, scale);
    default: return readHjif(bytes, name);
    }
}

Result<Clip> loadClip(const std::filesystem::path& path, ClipFormat format, const FrequencyScale& scale) {
    return loadText(path, limits::maxClipFileBytes, [&](std::string_view bytes, std::string_view name) {
        return readClip(bytes, name, format, scale);
    });
}

Result<std::string> clipBytes(const Clip& clip, ClipFormat format, const FrequencyScale& scale) {
    switch (format) {
    case ClipFormat::hmpg: return hmpgBytes(clip);
    case ClipFormat::haptic: return metaHapticText(clip.channels.front(), clip.title, scale);
    case ClipFormat::ahap: return ahapText(clip.channels.front(), clip.title, scale);
    default: return hjifText(clip);
    }
}

std::vector<std::string> clipLosses(const Clip& clip, ClipFormat format, const FrequencyScale& scale) {
    const Facts facts = factsOf(clip);
    if (format == ClipFormat::hmpg) return hmpgLosses(clip, facts);
    if (format == ClipFormat::hjif) return hjifLosses(clip, facts);
    std::vector<std::string> losses = monoLosses(facts, scale);
    const std::size_t raised =
        format == ClipFormat::haptic && !clip.channels.empty() ? metaHapticRaised(clip.channels.front()) : 0;
    if (raised > 0)
        losses.push_back(std::to_string(raised) +
                         " transients are weaker than what sounds beside them and become as strong as it");
    return losses;
}

} // namespace physvib
