// SPDX-License-Identifier: MIT
// Reads recordings and clips, trims and scales them, makes synthetic contacts, and checks hashes and limits.
#include "Live/Recordings/LoadRecordings.h"
#include "Core/PortableMath.h"
#include "Core/Samples.h"
#include "Formats/ClipFile.h"
#include "Io/Disk/FileClash.h"
#include "Io/Disk/ReadFile.h"
#include "Live/Recordings/ReadRecording.h"
#include "Measure/HitExcerpt.h"
#include "Stimuli/SeededRandom.h"
#include <numbers>

namespace physvib {

namespace {

struct FileContent {
    SampledSound sound;
    std::string hash;
    std::vector<ActuatorPlace> places{};
};

/// Positions of the channels as fractions of the extent; empty unless every channel has one.
std::vector<ActuatorPlace> relativePlaces(const Clip& clip) {
    std::vector<ActuatorPlace> places;
    for (const ClipChannel& channel : clip.channels)
        if (channel.place && clip.extentWidthMetres > 0.0 && clip.extentHeightMetres > 0.0)
            places.push_back({channel.place->xMetres / clip.extentWidthMetres,
                              channel.place->yMetres / clip.extentHeightMetres});
    return places.size() == clip.channels.size() ? places : std::vector<ActuatorPlace>{};
}

/// Reads a haptic file once: samples and hash come from the same bytes.
Result<FileContent> readHapticFile(const std::filesystem::path& path, ClipFormat format) {
    if (const auto regular = openRegularFile(path, limits::maxRecordingFileBytes); !regular)
        return Failure{regular.error};
    const auto bytes = readFile(path, limits::maxClipFileBytes);
    if (!bytes) return Failure{bytes.error};
    const auto clip = readClip(bytes.value, path.string(), format);
    if (!clip) return Failure{clip.error};
    auto sound = clipToSound(clip.value, path);
    if (!sound) return Failure{sound.error};
    return FileContent{std::move(sound.value), contentHash(bytes.value), relativePlaces(clip.value)};
}

/// The decoders read from the disk, so computing the hash reads the file again.
Result<FileContent> readSoundFile(const std::filesystem::path& path) {
    auto sound = readRecording(path);
    if (!sound) return Failure{sound.error};
    const auto bytes = readFile(path, limits::maxRecordingFileBytes);
    if (!bytes) return Failure{bytes.error};
    return FileContent{std::move(sound.value), contentHash(bytes.value)};
}

/// Loads one set of recordings, reusing files that other sets have loaded.
Result<std::vector<ContactRecording>> loadRecordingSet(const std::vector<RecordingFile>& files,
                                                       const LoadedRecordings& loaded) {
    std::vector<ContactRecording> set;
    for (const RecordingFile& file : files) {
        const ContactRecording* cached = nullptr;
        for (const auto& other : loaded.sets)
            if (const auto found = std::ranges::find(other, file, &ContactRecording::file);
                found != other.end())
                cached = &*found;
        auto contact = cached != nullptr ? Result<ContactRecording>{*cached} : loadContact(file);
        if (!contact) return Failure{contact.error};
        set.push_back(std::move(contact.value));
    }
    return set;
}

/// A synthetic contact, for trying out what needs recordings: six partials from `frequencyHz` up and 3 ms of
/// noise. The partials are inharmonic like those of a struck bar (assumed: ratios near the square roots of 1,
/// 2, 4, 6, 9, 13, varied by the seed); higher ones are weaker and shorter. One second at most. The same
/// arguments give the same samples. Any thread.
std::vector<float> syntheticContact(double frequencyHz, double decayPerSecond, std::uint32_t seed,
                                    int sampleRateHz) {
    constexpr double ratios[] = {1.0, 1.41, 2.0, 2.45, 3.0, 3.61}, noiseSeconds = 0.003;
    SeededRandom random{seed, "contact"};
    // to -60 dB
    std::vector<float> samples(static_cast<std::size_t>(sampleRateHz * std::min(1.0, 7.0 / decayPerSecond)));
    double weight = 1.0, decay = decayPerSecond;
    for (const double ratio : ratios) {
        const double hz = frequencyHz * ratio * (ratio > 1.0 ? 0.96 + 0.08 * random.uniform() : 1.0),
                     amplitude = weight * (0.7 + 0.6 * random.uniform());
        if (hz < 0.45 * sampleRateHz)
            for (std::size_t n = 0; n < samples.size(); ++n) {
                const double t = static_cast<double>(n) / sampleRateHz;
                samples[n] += static_cast<float>(amplitude * portable::sin(2.0 * std::numbers::pi * hz * t) *
                                                 portable::exp(-decay * t));
            }
        weight *= 0.6;
        decay *= 1.4;
    }
    for (std::size_t n = 0; n < samples.size(); ++n)
        samples[n] += static_cast<float>(
            0.3 * random.normal() * portable::exp(-static_cast<double>(n) / (noiseSeconds * sampleRateHz)));
    return samples;
}

constexpr std::uint32_t linearSeed = 0; // synthetic-0 is a linearTone()

/// A tone at the material's frequency, whose envelope falls in a straight line for as long as its decay takes
/// to a tenth (Eq. 5.5): what thesis 5.3.2 suggests as cheaper than an exponential. Any thread.
std::vector<float> linearTone(double frequencyHz, double decayPerSecond, int sampleRateHz) {
    const double length = sampleRateHz * std::numbers::ln10 / decayPerSecond;
    std::vector<float> samples(static_cast<std::size_t>(std::min(length, 1.0 * sampleRateHz)));
    for (std::size_t n = 0; n < samples.size(); ++n)
        samples[n] = static_cast<float>(
            (1.0 - static_cast<double>(n) / length) *
            portable::sin(2.0 * std::numbers::pi * frequencyHz * static_cast<double>(n) / sampleRateHz));
    return samples;
}

constexpr int syntheticRateHz = 48000;
constexpr double assumedDecayPerSecond = 40.0; // of synthetic contacts of an unknown material

Result<ContactRecording> readContact(const RecordingFile& file) {
    constexpr double minSeconds = 0.001;
    const std::string& path = file.path;
    if (const auto seed = syntheticSeed(path)) {
        const double decay = file.decayPerSecond > 0.0 ? file.decayPerSecond : assumedDecayPerSecond;
        return ContactRecording{file.frequencyHz, syntheticRateHz,
                                *seed == linearSeed
                                    ? linearTone(file.frequencyHz, decay, syntheticRateHz)
                                    : syntheticContact(file.frequencyHz, decay, *seed, syntheticRateHz),
                                file};
    }
    const auto read = readRecording(path);
    if (!read) return Failure{read.error};
    const std::vector<float>& channel = loudestChannel(read.value.channels);
    const double rateHz = read.value.sampleRateHz;
    std::string error = recordingError(channel, rateHz, minSeconds);
    if (error.empty() && isSilent(channel)) error = "expected a hit, found silence";
    if (error.empty()) error = clippingError(channel, rateHz);
    if (!error.empty()) return Failure{path + ": " + error};
    const HitExcerpt hit = strongestHit(channel, rateHz);
    ContactRecording contact{file.frequencyHz,
                             read.value.sampleRateHz,
                             {channel.begin() + static_cast<std::ptrdiff_t>(hit.begin),
                              channel.begin() + static_cast<std::ptrdiff_t>(hit.end)},
                             file};
    for (float& x : contact.samples) x -= static_cast<float>(hit.offset);
    if (!(peakOf(contact.samples) > 0.0f)) return Failure{path + ": expected a hit, found silence"};
    const SlowPart removed = removeSlowPart(contact.samples, rateHz, peakOf(contact.samples));
    if (!(peakOf(contact.samples) > 0.0f))
        return Failure{path + ": expected a hit, found nothing above " + numberText(limits::slowestToneHz) +
                       " Hz"};
    if (removed.isPresent()) contact.note = cleanLine(path + ": " + removed.text());
    return contact;
}

/// Compares the file with its hash and sets a missing one. Empty, or the error that the file has changed.
std::string checkAndSetHash(RecordingFile& file) {
    if (syntheticSeed(file.path)) return {};
    const auto bytes = readFile(file.path, limits::maxRecordingFileBytes);
    if (!bytes) return bytes.error;
    const std::string hash = contentHash(bytes.value);
    if (!file.hash.empty() && file.hash != hash)
        return file.path + ": expected the recording with the hash " + file.hash + ", found " + hash +
               ": it has changed since";
    file.hash = hash;
    return {};
}

double computeEnergy(const std::vector<float>& samples, int rateHz) {
    double sum = 0.0;
    for (std::size_t n = 0;
         n < std::min(samples.size(), static_cast<std::size_t>(matchWindowSeconds * rateHz)); ++n)
        sum += double{samples[n]} * samples[n];
    return sum / rateHz;
}

/// Energy of the mode whose envelope starts at 1.
double modeEnergy(double frequencyHz, double decayPerSecond, int rateHz) {
    std::vector<float> mode(static_cast<std::size_t>(matchWindowSeconds * rateHz));
    for (std::size_t n = 0; n < mode.size(); ++n) {
        const double t = static_cast<double>(n) / rateHz;
        mode[n] = static_cast<float>(portable::sin(2.0 * std::numbers::pi * frequencyHz * t) *
                                     portable::exp(-decayPerSecond * t));
    }
    return computeEnergy(mode, rateHz);
}

} // namespace

Result<LoadedClip> loadWholeClip(const std::filesystem::path& path) {
    const auto format = findClipFormat(path.string());
    auto content = format ? readHapticFile(path, *format) : readSoundFile(path);
    if (!content) return Failure{content.error};
    LoadedClip clip;
    const std::string note = removeSlowPart(content.value.sound, path);
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
    clip.places = std::move(content.value.places);
    return clip;
}

Result<LoadedClip> ClipFolder::operator()(const std::string& name) const {
    std::error_code failed;
    const std::filesystem::path requested{name}, folder = std::filesystem::canonical(folder_, failed);
    if (failed) return Failure{folder_.string() + ": expected a folder of clips"};
    if (name.empty() || requested.is_absolute() || !isWithin(folder, folder / requested))
        return Failure{inQuotes(name) + ": expected a file in " + folder_.string() + " or below"};
    return loadWholeClip(std::filesystem::weakly_canonical(folder / requested, failed));
}

Result<std::vector<ContactRecording>> loadSessionClips(const std::vector<ClipFile>& clips) {
    std::vector<ContactRecording> loadedClips;
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
        loadedClips.push_back(last.channels[static_cast<std::size_t>(clip.channel)]);
        samples += loadedClips.back().samples.size();
        if (samples > static_cast<std::size_t>(limits::maxRecordingSamples))
            return Failure{path + ": expected at most " + std::to_string(limits::maxRecordingSamples) +
                           " samples in all clips"};
    }
    return loadedClips;
}

Result<LoadedRecordings> loadRecordings(const SessionLog& log) {
    LoadedRecordings all;
    std::vector<const std::vector<RecordingFile>*> files; // one entry per set
    std::size_t samples = 0;
    for (const RecordingsChange& change : log.recordings) {
        const auto sameSet =
            std::ranges::find_if(files, [&](const auto* known) { return *known == change.files; });
        all.setIndices.push_back(static_cast<std::size_t>(sameSet - files.begin()));
        if (sameSet != files.end()) continue;
        auto set = loadRecordingSet(change.files, all);
        if (!set) return Failure{set.error};
        for (const ContactRecording& recording : set.value) samples += recording.samples.size();
        if (files.size() == limits::maxRecordingSets)
            return Failure{"recordings: expected at most " + std::to_string(limits::maxRecordingSets) +
                           " different sets"};
        if (samples > static_cast<std::size_t>(limits::maxRecordingSamples))
            return Failure{"recordings: expected at most " + std::to_string(limits::maxRecordingSamples) +
                           " samples in all sets"};
        files.push_back(&change.files);
        all.sets.push_back(std::move(set.value));
    }
    auto clips = loadSessionClips(log.clips);
    if (!clips) return Failure{clips.error};
    all.clips = std::move(clips.value);
    return all;
}

std::vector<std::string> recordingPaths(const SessionLog& log) {
    std::vector<std::string> paths;
    for (const RecordingsChange& change : log.recordings)
        for (const RecordingFile& file : change.files) paths.push_back(file.path);
    for (const ClipFile& clip : log.clips) paths.push_back(clip.file.path);
    return paths;
}

Result<ContactRecording> loadContact(const RecordingFile& file) {
    auto contact = readContact(file);
    if (!contact) return contact;
    if (auto error = checkAndSetHash(contact.value.file); !error.empty()) return Failure{error};
    auto& [frequencyHz, rateHz, samples, source, note] = contact.value;
    if (syntheticSeed(file.path) != linearSeed) // that begins at 1, as a mode does
        for (const float peak = peakOf(samples); float& x : samples) x /= peak;
    if (!file.isMatched || !(file.decayPerSecond > 0.0)) return contact;
    const auto gain = static_cast<float>(
        std::sqrt(modeEnergy(frequencyHz, file.decayPerSecond, rateHz) / computeEnergy(samples, rateHz)));
    for (float& x : samples) x *= gain;
    return contact;
}

} // namespace physvib
