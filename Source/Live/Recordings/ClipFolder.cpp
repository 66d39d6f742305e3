// SPDX-License-Identifier: MIT
// Finds a clip by name, reads it and computes its hash.
#include "Live/Recordings/ClipFolder.h"
#include "Formats/Clip.h"
#include "Formats/ClipFile.h"
#include "Io/Disk/ContentHash.h"
#include "Io/Disk/FileClash.h"
#include "Io/Disk/ReadFile.h"
#include "Io/Text/NumberText.h"
#include "Live/Recordings/ReadRecording.h"
#include <algorithm>

namespace physvib {
namespace {

struct Content {
    SampledSound sound;
    std::string hash;
    std::vector<EnchanterPlace> shares{};
};

/// Positions of the channels as fractions of the extent; empty unless every channel has one.
std::vector<EnchanterPlace> sharesOf(const Clip& clip) {
    std::vector<EnchanterPlace> shares;
    for (const ClipChannel& channel : clip.channels)
        if (channel.place && clip.extentWidthMetres > 0.0 && clip.extentHeightMetres > 0.0)
            shares.push_back({channel.place->xMetres / clip.extentWidthMetres,
                              channel.place->yMetres / clip.extentHeightMetres});
    return shares.size() == clip.channels.size() ? shares : std::vector<EnchanterPlace>{};
}

/// Reads a haptic file once: samples and hash come from the same bytes.
Result<Content> readDrawn(const std::filesystem::path& path, ClipFormat format) {
    if (const auto regular = openRegular(path, limits::maxRecordingFileBytes); !regular)
        return Failure{regular.error};
    const auto bytes = readFile(path, limits::maxClipFileBytes);
    if (!bytes) return Failure{bytes.error};
    const auto clip = readClip(bytes.value, path.string(), format);
    if (!clip) return Failure{clip.error};
    auto sound = soundOf(clip.value, path);
    if (!sound) return Failure{sound.error};
    return Content{std::move(sound.value), contentHash(bytes.value), sharesOf(clip.value)};
}

/// The decoders read from the disk, so computing the hash reads the file again.
Result<Content> readSampled(const std::filesystem::path& path) {
    auto sound = readRecording(path);
    if (!sound) return Failure{sound.error};
    const auto bytes = readFile(path, limits::maxRecordingFileBytes);
    if (!bytes) return Failure{bytes.error};
    return Content{std::move(sound.value), contentHash(bytes.value)};
}

} // namespace

Result<LoadedClip> loadWholeClip(const std::filesystem::path& path) {
    const auto format = clipFormatOf(path.string());
    auto content = format ? readDrawn(path, *format) : readSampled(path);
    if (!content) return Failure{content.error};
    LoadedClip clip;
    const std::string note = takeSlowPart(content.value.sound, path);
    for (std::vector<float>& samples : content.value.sound.channels) {
        ContactRecording& channel = clip.channels.emplace_back();
        channel.sampleRateHz = content.value.sound.sampleRateHz;
        channel.samples = std::move(samples);
        channel.file.path = path.string();
        channel.file.hash = content.value.hash;
        channel.note = note;
    }
    if (clip.channels.empty() || clip.channels.front().samples.empty())
        return Failure{path.string() + ": expected something to feel, found no samples"};
    clip.shares = std::move(content.value.shares);
    return clip;
}

Result<LoadedClip> ClipFolder::operator()(const std::string& name) const {
    std::error_code failed;
    const std::filesystem::path asked{name}, folder = std::filesystem::canonical(folder_, failed);
    if (failed) return Failure{folder_.string() + ": expected a folder of clips"};
    if (name.empty() || asked.is_absolute() || !isWithin(folder, folder / asked))
        return Failure{inQuotes(name) + ": expected a file in " + folder_.string() + " or below"};
    return loadWholeClip(std::filesystem::weakly_canonical(folder / asked, failed));
}

Result<std::vector<ContactRecording>> loadKeptClips(const std::vector<ClipFile>& clips) {
    std::vector<ContactRecording> kept;
    LoadedClip last; // channels of one file are adjacent
    std::size_t samples = 0;
    for (const ClipFile& clip : clips) {
        const std::string& path = clip.file.path;
        if (last.channels.empty() || last.channels.front().file.path != path) {
            auto loaded = loadWholeClip(path);
            if (!loaded) return Failure{loaded.error};
            last = std::move(loaded.value);
        }
        const std::string& hash = last.channels.front().file.hash;
        if (hash != clip.file.hash)
            return Failure{path + ": expected the clip with the hash " + clip.file.hash + ", found " + hash +
                           ": it has changed since"};
        if (clip.channel >= std::ssize(last.channels))
            return Failure{path + ": expected at least " + std::to_string(clip.channel + 1) +
                           " channels, found " + std::to_string(last.channels.size())};
        kept.push_back(last.channels[static_cast<std::size_t>(clip.channel)]);
        samples += kept.back().samples.size();
        if (samples > static_cast<std::size_t>(limits::maxRecordingSamples))
            return Failure{path + ": expected at most " + std::to_string(limits::maxRecordingSamples) +
                           " samples in all clips"};
    }
    return kept;
}

} // namespace physvib
