// SPDX-License-Identifier: GPL-3.0-or-later
// Clips that are dropped on the desk: read beside M, struck as messages are.
#pragma once
#include "Host/Devices/AudioOutput.h"
#include "Live/Messages/MessageRouter.h"
#include <functional>
#include <juce_core/juce_core.h>
#include <juce_events/juce_events.h>
#include <mutex>
#include <string>
#include <vector>

namespace physvib {

/// Whether that is dragged which may be dropped as a clip: documents are the window's. M.
bool isClipDrag(const juce::StringArray& files);

/// M only.
class DeskClips final : private juce::AsyncUpdater {
public:
    /// All outlive it; `told` is called on M for each clip, when it has been struck (with a note or an empty
    /// line) or refused (why).
    DeskClips(Session& session, const AudioOutput& output,
              std::function<void(const Result<std::string>&)> told);
    ~DeskClips() override;

    /// As soon as it has been read: at that place of the field, or on the enchanter there alone. Several wait
    /// for one another.
    void feel(const juce::File& file, const EnchanterPlace& atMetres, bool isAlone);

private:
    Result<std::string> strike(const juce::File& file, const EnchanterPlace& atMetres, bool isAlone);
    void handleAsyncUpdate() override;

    const AudioOutput& output_;
    std::function<void(const Result<std::string>&)> told_;
    MessageRouter messages_;
    std::mutex mutex_; // guards what follows
    std::vector<Result<std::string>> results_;
    juce::ThreadPool reader_{1}; // last: its thread uses the others
};

} // namespace physvib
