// SPDX-License-Identifier: GPL-3.0-or-later
// Converts the stimuli of a trial to events or worlds for a live session. Calls of a protocol are parsed with
// the program's option tables.
#pragma once
#include "Io/Result.h"
#include "Lab/Study/Experiment.h"
#include "Live/Session/SessionSetup.h"
#include "Scene/LayoutFile.h"
#include "Stimuli/Stimulus.h"
#include <string>
#include <vector>

namespace physvib {

struct PlayableStimulus {
    Stimulus stimulus; ///< times start at 0
    LayoutDescription layout;
    std::vector<float> gains; ///< per actuator: from the events' unit (g, or shares) to full scale
    std::vector<ContactRecording> recordings; ///< are played instead of modes; empty: modes
};

/// A scene to be seen and felt.
struct PlayableWorld {
    SessionSetup setup;
    LayoutDescription layout;
    double seconds = 0.0; ///< duration in the call
};

/// A built-in protocol, or the one of a file (see findProtocol) whose calls write no files; or one error
/// line. Message thread.
Result<Protocol> loadCheckedProtocol(const std::string& nameOrPath);

/// Checks layouts, names and calls, which reading the protocol cannot check. Empty, or one line that starts
/// with `name`. Message thread.
std::string protocolError(const Protocol& protocol, const std::string& name);

/// The stimulus, or one error line. Files are searched in `folder` first, if it is not empty. Like `physvib
/// stimulus`, it rejects stimuli that are too strong for the layout at `sampleRateHz`. It also rejects
/// phantoms with recordings, which are samples and not events. Message thread.
Result<PlayableStimulus> makePlayableStimulus(const TrialJob& job, int sampleRateHz,
                                              const std::string& folder = {});

/// The world of `render SCENE ...`, as `physvib play` plays it; or one error line. Files are searched in
/// `folder` first, if it is not empty. Message thread.
Result<PlayableWorld> makePlayableWorld(const ResolvedCall& call, const std::string& folder = {});

} // namespace physvib
