// SPDX-License-Identifier: GPL-3.0-or-later
// Inputs of a render or an export: loads what the options name, and makes its events; the channels of clips.
#pragma once
#include "Calls/LoadedRender.h"
#include "Core/RenderControl.h"
#include "Io/Wav/SampledSound.h"
#include <vector>

namespace physvib {
/// Reads and checks what the options name: scene, session, clip or event list, layout, actuators, coupling.
/// Returns exitDone, or the exit code after an error line on stderr. Message thread.
int loadInputs(LoadedRender& job);

/// Simulates the job's events, or uses those of its list, and applies the options' event shaping. Returns
/// warnings about what the shaping loses, or one error line. Message thread.
Result<std::vector<std::string>> makeEvents(LoadedRender& job);

/// The channels of a clip (a haptic file of another program) at the job's sample rate, each as a recorded
/// contact, and the events that play them.
class ClipEvents {
public:
    /// `job` has a clip. Its channels are played at their places; without places one on each actuator, or a
    /// single channel in the middle of all. Prints losses on stderr.
    explicit ClipEvents(const LoadedRender& job);

    const std::vector<CollisionEvent>& events() const { return events_; }
    std::span<const RecordedContact> contacts() const { return contacts_; }

private:
    SampledSound sound_;
    std::vector<CollisionEvent> events_;
    std::vector<RecordedContact> contacts_;
};

/// The frequency range that a phone's haptic file refers to: the band of a named --actuator, else the
/// default. Or one error line if there is no such actuator. Message thread.
Result<FrequencyScale> findFrequencyScale(const RenderJob& options);

/// Loads the clip that the options name, and its own layout if none is given, into `job`. Returns exitDone,
/// or the exit code after an error line on stderr. Message thread.
int loadClipInto(LoadedRender& job);

} // namespace physvib
