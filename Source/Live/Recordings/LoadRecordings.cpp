// SPDX-License-Identifier: MIT
// Loads each recording of a saved session once, and checks the limits on samples.
#include "Live/Recordings/LoadRecordings.h"
#include "Io/Disk/FileLimits.h"
#include "Live/Recordings/ClipFolder.h"
#include "Live/Recordings/LoadContact.h"
#include "Scene/SceneFileLimits.h"
#include <algorithm>

namespace physvib {
namespace {

/// Loads one set of recordings, reusing files that other sets have loaded.
Result<std::vector<ContactRecording>> loadSet(const std::vector<RecordingFile>& files,
                                              const LoadedRecordings& before) {
    std::vector<ContactRecording> set;
    for (const RecordingFile& file : files) {
        const ContactRecording* known = nullptr;
        for (const auto& other : before.sets)
            if (const auto found = std::ranges::find(other, file, &ContactRecording::file);
                found != other.end())
                known = &*found;
        if (known != nullptr) {
            set.push_back(*known);
            continue;
        }
        auto contact = loadContact(file);
        if (!contact) return Failure{contact.error};
        set.push_back(std::move(contact.value));
    }
    return set;
}

std::size_t samplesOf(const std::vector<ContactRecording>& set) {
    std::size_t count = 0;
    for (const ContactRecording& recording : set) count += recording.samples.size();
    return count;
}

} // namespace

Result<LoadedRecordings> loadRecordings(const SessionLog& log) {
    LoadedRecordings all;
    std::vector<const std::vector<RecordingFile>*> files; // one entry per set
    std::size_t samples = 0;
    for (const RecordingsChange& change : log.recordings) {
        const auto same =
            std::ranges::find_if(files, [&](const auto* known) { return *known == change.files; });
        all.setOfChange.push_back(static_cast<std::size_t>(same - files.begin()));
        if (same != files.end()) continue;
        auto set = loadSet(change.files, all);
        if (!set) return Failure{set.error};
        samples += samplesOf(set.value);
        if (files.size() == limits::maxRecordingSets)
            return Failure{"recordings: expected at most " + std::to_string(limits::maxRecordingSets) +
                           " different sets"};
        if (samples > static_cast<std::size_t>(limits::maxRecordingSamples))
            return Failure{"recordings: expected at most " + std::to_string(limits::maxRecordingSamples) +
                           " samples in all sets"};
        files.push_back(&change.files);
        all.sets.push_back(std::move(set.value));
    }
    auto clips = loadKeptClips(log.clips);
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

} // namespace physvib
