// SPDX-License-Identifier: GPL-3.0-or-later
// Plays clips dropped on the mixer: a background thread reads them and posts them like messages.
#pragma once
#include "Live/Devices/AudioOutput.h"
#include "Live/Messages/MessageRouter.h"
#include <functional>
#include <juce_core/juce_core.h>
#include <juce_events/juce_events.h>
#include <mutex>
#include <string>
#include <vector>

namespace physvib {

/// True if the dragged files may be dropped as clips; the window handles documents. Message thread.
bool isClipDrag(const juce::StringArray& files);

/// Message thread only.
class DeskClips final : private juce::AsyncUpdater {
public:
    /// All references outlive it. `told` is called on the message thread for each clip: with a note or an
    /// empty text if it plays, or with the reason if it was rejected.
    DeskClips(Session& session, const AudioOutput& output,
              std::function<void(const Result<std::string>&)> told);
    ~DeskClips() override;

    /// Plays the clip when it has been read: at that place of the field, or only on the actuator there. Clips
    /// are read one after the other.
    void feel(const juce::File& file, const EnchanterPlace& atMetres, bool isAlone);
    /// The same, each channel on the actuator of its number.
    void play(const juce::File& file);

private:
    void read(PlainMessage clip);
    Result<std::string> strike(const PlainMessage& clip);
    void handleAsyncUpdate() override;

    const AudioOutput& output_;
    std::function<void(const Result<std::string>&)> told_;
    MessageRouter messages_;
    std::mutex mutex_; // guards the members below
    std::vector<Result<std::string>> results_;
    juce::ThreadPool reader_{1}; // destroyed first, because its thread uses the other members
};

} // namespace physvib
