// SPDX-License-Identifier: GPL-3.0-or-later
// Records what the mixer plays: files with their events (MixerRecording), fader moves as gain lanes
// (MixerLanes), the last contacts (RecentContacts). UserFolder finds the folder for the user's files.
#pragma once
#include "Core/CollisionEvent.h"
#include "Io/Result.h"
#include "Live/Devices/AudioOutput.h"
#include "Live/Documents/Mix.h"
#include "Live/Recordings/Recording.h"
#include "Live/Session/Session.h"
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <juce_core/juce_core.h>
#include <memory>
#include <string>
#include <vector>

namespace physvib {

class MixerModel;

/// Records the actuator channels as WAV, and the events beside it; one at a time. Message thread.
class MixerRecording {
public:
    /// All references outlive it. `onChange` is called when a recording starts, stops and is complete.
    MixerRecording(Session& session, AudioOutput& output, const Mix& mix, std::function<void()> onChange);

    ~MixerRecording() { complete(); }

    /// Completes a running recording. Precondition: the output was stopped.
    void complete();

    /// Records the attached actuators as WAV, and the events beside it. Empty, or an error.
    std::string start(const juce::File& file);
    void stop(); ///< the files are complete a moment later, when onEnd is called
    bool isRunning() const noexcept { return recording_ != nullptr && !isEnding_; }
    double seconds() const noexcept;
    bool wasSilent() const noexcept { return wasSilent_; } ///< the last recording, from start to end
    std::int64_t startFrame() const noexcept { return startFrame_; } ///< session frame of its start
    std::function<void(const juce::File&, const juce::String& error)> onEnd;

    /// Records an event that was played.
    void add(const PlayedEvent& played) {
        if (recording_) recording_->addEvent(played);
    }

    void poll(const AudioOutputStatus& device); ///< to be called often, with the newest status

private:
    void detachRecorder();
    juce::String close();

    Session& session_;
    AudioOutput& output_;
    const Mix& mix_;
    std::function<void()> onChange_;
    std::unique_ptr<Recording> recording_;
    juce::File file_;
    bool isEnding_ = false, wasSilent_ = false;
    std::int64_t startFrame_ = 0;
    std::uint64_t lastBlock_ = 0;
};

/// Writes fader moves of a recording to gain lanes (automation over the scene's time). Message thread.
class MixerLanes {
public:
    /// `model` outlives it.
    explicit MixerLanes(MixerModel& model)
        : model_{model} {}

    void poll(); ///< to be called often

private:
    struct Fader {
        double startDb = 0.0, lastDb = 0.0;
        std::string name;
        GainLane moves{}; ///< its values in dB over the scene's time
    };
    std::vector<Fader> fadersNow() const; ///< of all strips, then of all groups
    double sceneSeconds() const;
    void recordMoves(const std::vector<Fader>& now);
    void end();

    MixerModel& model_;
    std::vector<Fader> faders_; // empty: not recording
    std::size_t stripCount_ = 0, runNumber_ = 0;
    double polledAtSeconds_ = 0.0;
};

/// A played impact, or a rolling or sliding contact with all its grains.
struct RecentContact {
    CollisionEvent event; ///< its first event, with the largest amplitude and the place of the last one
    int grainCount = 1;
    std::int64_t lastGrainNs = 0;
    std::uint64_t id = 0; ///< unique
};

/// The contacts played last: single impacts, and rolling or sliding contacts that combine all their grains.
/// Message thread.
class RecentContacts {
public:
    static constexpr std::size_t maxContacts = 100;
    static constexpr std::size_t maxGrains = 20'000;      ///< 3 MB, some minutes of a rough surface
    static constexpr std::int64_t maxGapNs = 250'000'000; ///< a longer pause starts a new contact

    /// Adds a played event, as a new contact or as a grain of a contact that continues.
    void add(const CollisionEvent& event) {
        const bool isHit = event.source.kind == ContactKind::hit;
        auto contact = std::ranges::find_if(contacts_, [&](const RecentContact& c) {
            const CollisionSource &a = c.event.source, &b = event.source;
            return !isHit && a.kind == b.kind && a.fixture == b.fixture && a.other == b.other &&
                   event.timeNs - c.lastGrainNs < maxGapNs;
        });
        if (contact == contacts_.end()) {
            contacts_.push_front({event, 1, event.timeNs, ++lastId_});
            if (contacts_.size() > maxContacts) contacts_.pop_back();
            contact = contacts_.begin();
        } else {
            ++contact->grainCount;
            contact->lastGrainNs = event.timeNs;
            contact->event.x = event.x;
            contact->event.y = event.y;
            if (std::abs(event.amplitude) > std::abs(contact->event.amplitude))
                contact->event.amplitude = event.amplitude;
        }
        if (isHit) return;
        grains_.push_back({contact->id, event});
        if (grains_.size() > maxGrains) grains_.pop_front();
    }
    const std::deque<RecentContact>& newestFirst() const noexcept { return contacts_; }

    /// Appends the contact's events: one impact, or its last grains as far as they are stored.
    void appendEvents(const RecentContact& contact, std::vector<CollisionEvent>& events) const {
        if (contact.event.source.kind == ContactKind::hit) return events.push_back(contact.event);
        for (const Grain& grain : grains_)
            if (grain.contactId == contact.id) events.push_back(grain.event);
    }

private:
    struct Grain {
        std::uint64_t contactId;
        CollisionEvent event;
    };
    std::deque<RecentContact> contacts_;
    std::deque<Grain> grains_;
    std::uint64_t lastId_ = 0;
};

/// The folder for files of the mixer: recordings, movies, sessions and studies. One for all windows of the
/// process, as a juce::SharedResourcePointer. Message thread.
class UserFolder {
public:
    /// Sets the user's choice. Without one, or if it cannot be written, the folder is PhysVib in the
    /// documents or else in the home folder.
    void choose(const juce::File& folder) { chosenFolder_ = folder; }

    /// The first of these folders that can be written or created; an empty file if none can.
    juce::File location() const;

    /// The folder of location(), created if it is missing; or one line of error.
    Result<juce::File> create() const;

    /// A new file in it with the first of `endings`, such as ".wav"; its name is free with all of them.
    Result<juce::File> newFile(const juce::String& name, const juce::StringArray& endings) const;

private:
    juce::Array<juce::File> candidates() const;

    juce::File chosenFolder_;
};

} // namespace physvib
