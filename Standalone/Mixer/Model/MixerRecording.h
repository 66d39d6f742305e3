// SPDX-License-Identifier: GPL-3.0-or-later
// Keeps what the mixer plays: recordings with their events (MixerRecording), fader moves as gain lanes
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

    ~MixerRecording() { keep(); }

    /// Completes a running recording. Precondition: the output was stopped.
    void keep();

    /// Records the attached actuators as WAV, and the events beside it. Empty, or an error.
    std::string start(const juce::File& file);
    void stop(); ///< the files are complete a moment later, when onEnd is called
    bool isRunning() const noexcept { return recording_ != nullptr && !isEnding_; }
    double seconds() const noexcept;
    bool wasSilent() const noexcept { return wasSilent_; } ///< the last one, throughout
    std::int64_t from() const noexcept { return from_; }   ///< session frame of the last recording's start
    std::function<void(const juce::File&, const juce::String& error)> onEnd;

    /// Records an event that was played.
    void add(const PlayedEvent& played) {
        if (recording_) recording_->take(played);
    }

    /// To be called often, with the newest device status.
    void look(const AudioOutputStatus& device);

private:
    void letGo();
    juce::String close();

    Session& session_;
    AudioOutput& output_;
    const Mix& mix_;
    std::function<void()> onChange_;
    std::unique_ptr<Recording> recording_;
    juce::File file_;
    bool isEnding_ = false, wasSilent_ = false;
    std::int64_t from_ = 0;
    std::uint64_t endsAfterBlock_ = 0;
};

/// Records fader moves during a recording as automation lanes over the scene's time. Message thread.
class MixerLanes {
public:
    /// `model` outlives it.
    explicit MixerLanes(MixerModel& model)
        : model_{model} {}

    void look(); ///< to be called often

private:
    struct Fader {
        double startDb = 0.0, nowDb = 0.0;
        GainLane moves{}; ///< its values, in dB
    };
    std::vector<double> faders() const; ///< values of all strips, then of all groups
    double sceneSeconds() const;
    void follow();
    void end();

    MixerModel& model_;
    std::vector<Fader> faders_; // empty: not recording
    std::size_t strips_ = 0, run_ = 0;
    double lookedAtSeconds_ = 0.0;
};

struct RecentContact {
    CollisionEvent event; ///< the first event, with the largest amplitude and the last place
    int grains = 1;
    std::int64_t lastNs = 0;
    std::uint64_t number = 0; ///< unique
};

/// The contacts played last: single impacts, and rolling or sliding contacts that combine all their grains.
/// Message thread.
class RecentContacts {
public:
    static constexpr std::size_t most = 100;
    static constexpr std::size_t maxGrains = 20'000;     ///< 3 MB, some minutes of a rough surface
    static constexpr std::int64_t pauseNs = 250'000'000; ///< a longer pause starts a new contact

    void add(const CollisionEvent& event) {
        const bool isHit = event.source.kind == ContactKind::hit;
        auto known = std::ranges::find_if(contacts_, [&](const RecentContact& c) {
            const CollisionSource &a = c.event.source, &b = event.source;
            return !isHit && a.kind == b.kind && a.fixture == b.fixture && a.other == b.other &&
                   event.timeNs - c.lastNs < pauseNs;
        });
        if (known == contacts_.end()) {
            contacts_.push_front({event, 1, event.timeNs, ++begun_});
            if (contacts_.size() > most) contacts_.pop_back();
            known = contacts_.begin();
        } else {
            ++known->grains;
            known->lastNs = event.timeNs;
            known->event.x = event.x;
            known->event.y = event.y;
            if (std::abs(event.amplitude) > std::abs(known->event.amplitude))
                known->event.amplitude = event.amplitude;
        }
        if (isHit) return;
        grains_.push_back({known->number, event});
        if (grains_.size() > maxGrains) grains_.pop_front();
    }
    const std::deque<RecentContact>& newestFirst() const noexcept { return contacts_; }

    /// Appends the contact's events: one impact, or its last grains as far as they are stored.
    void appendEvents(const RecentContact& contact, std::vector<CollisionEvent>& events) const {
        if (contact.event.source.kind == ContactKind::hit) return events.push_back(contact.event);
        for (const Grain& grain : grains_)
            if (grain.contact == contact.number) events.push_back(grain.event);
    }

private:
    struct Grain {
        std::uint64_t contact;
        CollisionEvent event;
    };
    std::deque<RecentContact> contacts_;
    std::deque<Grain> grains_;
    std::uint64_t begun_ = 0;
};

/// The folder for what the mixer makes: recordings, movies, sessions and studies. One for all windows of the
/// process, as a juce::SharedResourcePointer. Message thread.
class UserFolder {
public:
    /// The user's choice; without one, or where it cannot be written: PhysVib in the documents, else in the
    /// home folder.
    void choose(const juce::File& folder) { chosen_ = folder; }
    const juce::File& chosen() const noexcept { return chosen_; }

    /// The first of these that can be written or created; an empty file if none can.
    juce::File place() const;

    /// The same, created if missing; or one line with the reason.
    Result<juce::File> make() const;

    /// A new file in it with the first of `endings`, such as ".wav"; its name is free with all of them.
    Result<juce::File> fresh(const juce::String& name, const juce::StringArray& endings) const;

private:
    juce::Array<juce::File> candidates() const;

    juce::File chosen_;
};

} // namespace physvib
