// SPDX-License-Identifier: MIT
// Recordings of contacts and clips of a session, as read from files and resampled to the renderer's rate.
#pragma once
#include "Core/NameNumbers.h"
#include "Core/RenderControl.h"
#include "Live/Documents/SessionLog.h"
#include <algorithm>
#include <deque>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace physvib {
/// A recording from its onset on, with its original level.
struct ContactRecording {
    double frequencyHz = 0.0; ///< frequency of the events that play it, unless its file names a material
    int sampleRateHz = 0;
    std::vector<float> samples;
    RecordingFile file{}; ///< its file, with hash
    std::string note{};   ///< a line for the user on removed content, or empty
    bool operator==(const ContactRecording&) const = default;
};

/// The files of recordings. Any thread.
std::vector<RecordingFile> recordingFiles(const std::vector<ContactRecording>& recordings);

/// Notes of recordings, without duplicates. Any thread.
std::vector<std::string> recordingNotes(const std::vector<ContactRecording>& recordings);

/// Recordings at one rate, and the list of them for a renderer. Both are valid as long as this object, which
/// must not move meanwhile. Any thread but the render thread (R).
class ContactSounds {
public:
    ContactSounds() = default;
    ContactSounds(const std::vector<ContactRecording>& recordings, int sampleRateHz);
    ContactSounds(ContactSounds&&) = default; // vectors keep their memory
    ContactSounds& operator=(ContactSounds&&) = default;

    std::span<const RecordedContact> contacts() const noexcept { return contacts_; }

private:
    std::vector<std::vector<float>> samples_;
    std::vector<RecordedContact> contacts_;
};

// Storage of a session's recordings: each set once per sample rate, and its clips.

/// A clip at each requested sample rate.
class ClipSound {
public:
    ClipSound(ContactRecording clip)
        : clip_{std::move(clip)} {}

    bool hasRate(int sampleRateHz) const {
        return std::ranges::find(sounds_, sampleRateHz, &ResampledClip::sampleRateHz) != sounds_.end();
    }

    /// The samples at that rate. The first call for a rate takes long. Valid as long as this object.
    std::span<const float> resample(int sampleRateHz) {
        auto sound = std::ranges::find(sounds_, sampleRateHz, &ResampledClip::sampleRateHz);
        if (sound == sounds_.end())
            sound = sounds_.insert(sounds_.end(), ResampledClip{sampleRateHz, {{clip_}, sampleRateHz}});
        return sound->sounds.contacts().front().samples;
    }

    /// Number of samples at the highest of these rates or its own.
    double maxSampleCount(const std::vector<int>& rates) const {
        const double maxRateHz = rates.empty() ? 0.0 : *std::ranges::max_element(rates);
        return static_cast<double>(clip_.samples.size()) * std::max(1.0, maxRateHz / clip_.sampleRateHz);
    }

private:
    struct ResampledClip {
        int sampleRateHz;
        ContactSounds sounds;
    };
    ContactRecording clip_;
    std::vector<ResampledClip> sounds_;
};

/// Keeps every set for the session's life, because the render thread (R) may still use any. One thread at a
/// time: Session guards it by its input mutex.
class RecordingSets {
public:
    /// The list for a renderer at that rate: these recordings and all clips, including those that are added
    /// later. Valid as long as this object. Without recordings, all but clips play their mode.
    RecordedContacts contacts(int sampleRateHz, const std::vector<ContactRecording>& recordings) {
        const auto existing = std::ranges::find_if(sets_, [&](const Set& set) {
            return set.sampleRateHz == sampleRateHz && set.recordings == recordings;
        });
        if (existing != sets_.end()) return existing->contactList();
        Set& set = sets_.emplace_back(Set{recordings, sampleRateHz, {recordings, sampleRateHz}, {}});
        const auto sounds = set.sounds.contacts();
        set.contacts.assign(sounds.begin(), sounds.end());
        for (int k = 0; k < maxClips; ++k) set.contacts.push_back({clipFrequencyHz, {}, soundOfClip(k)});
        for (std::size_t k = 0; k < clips_.size(); ++k) setClip(set, k);
        return set.contactList();
    }

    /// The rates of the stored lists.
    std::vector<int> rates() const {
        std::vector<int> all;
        for (const Set& set : sets_) all.push_back(set.sampleRateHz);
        return all;
    }

    const std::deque<ClipSound>& clips() const noexcept { return clips_; }

    /// Adds a clip with the number clips().size(), which must be below maxClips. Fast if it is at all
    /// rates() already. R may be searching any list meanwhile: it reads the numbers of the clips' entries,
    /// which do not change, and reads this clip's samples only for an event that is sent after this call.
    void add(ClipSound clip) {
        clips_.push_back(std::move(clip));
        for (Set& set : sets_) setClip(set, clips_.size() - 1);
    }

private:
    struct Set {
        std::vector<ContactRecording> recordings;
        int sampleRateHz;
        ContactSounds sounds; // at that rate
        std::vector<RecordedContact> contacts;
        RecordedContacts contactList() const noexcept { return {contacts, recordings.empty()}; }
    };

    void setClip(Set& set, std::size_t number) {
        set.contacts[set.recordings.size() + number].samples = clips_[number].resample(set.sampleRateHz);
    }

    std::deque<Set> sets_;
    std::deque<ClipSound> clips_;
};

} // namespace physvib
