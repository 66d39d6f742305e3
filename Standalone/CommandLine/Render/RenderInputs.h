// SPDX-License-Identifier: GPL-3.0-or-later
// The one door by which scenes, saved sessions and event lists become the events of a render or an export.
#pragma once
#include "Calls/LoadedRender.h"
#include "Core/RenderControl.h"
#include "Io/Wav/SampledSound.h"
#include <vector>

namespace physvib {
/// Reads and checks what the options name: scene, session, clip or event list, layout, actuators, coupling.
/// exitDone, or the code to leave with after a line on stderr. M only.
int takeInputs(LoadedRender& job);

/// The job's events, shaped as its options say: simulated, or those of the list. Warnings for people on what
/// the shaping loses; or one line. M only.
Result<std::vector<std::string>> makeEvents(LoadedRender& job);

// Haptic files of others as inputs: on which enchanters each of their channels is felt.

/// A clip's channels at a rate, and one event for each: played as recorded contacts are.
class ClipVoices {
public:
    /// `job` has a clip; see RenderInputs.cpp for where its channels are felt. What they lose goes to stderr.
    explicit ClipVoices(const LoadedRender& job);

    const std::vector<CollisionEvent>& events() const { return events_; }
    std::span<const RecordedContact> contacts() const { return contacts_; }

private:
    SampledSound sound_;
    std::vector<CollisionEvent> events_;
    std::vector<RecordedContact> contacts_;
};

/// What phones' frequencies are by the options: the band of a named --actuator, else what is usual. One line
/// if there is no such actuator. M only.
Result<FrequencyScale> frequencyScaleOf(const RenderJob& options);

/// Takes the clip that the options name, and its own layout if none is given, into `job`: exitDone, or the
/// code to leave with after a line on stderr. M only.
int takeClip(LoadedRender& job);

} // namespace physvib
