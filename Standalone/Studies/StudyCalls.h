// SPDX-License-Identifier: GPL-3.0-or-later
// What a trial's stimuli are for a live session. A protocol's own calls are text, which is parsed here as the
// program parses it.
#pragma once
#include "Io/Result.h"
#include "Lab/Study/Trial.h"
#include "Live/Session/SessionSetup.h"
#include "Scene/LayoutFile.h"
#include "Stimuli/Stimulus.h"
#include <string>
#include <vector>

namespace physvib {

struct FeltStimulus {
    Stimulus stimulus; ///< times from 0
    LayoutDescription layout;
    std::vector<float> gains; ///< of each enchanter: from the events' unit (g, or shares of full scale) to
                              ///< full scale
    std::vector<ContactRecording> recordings; ///< played instead of modes; none: modes
};

/// A scene that can be watched while it is felt.
struct FeltWorld {
    SessionSetup setup;
    LayoutDescription layout;
    double seconds = 0.0; ///< of the call
};

/// A built-in protocol, or that of a file (see findProtocol) of whose calls none names a file to be written;
/// or one line. M.
Result<Protocol> protocolNamed(const std::string& nameOrPath);

/// What the protocol asks of layouts, names and calls that reading it could not tell; empty, or one line that
/// begins with `name`. M.
std::string protocolFault(const Protocol& protocol, const std::string& name);

/// What is felt, or one line with what is wrong. Files are looked for in `folder` first, if there is one.
/// What `physvib stimulus` would refuse as too strong for the layout at `sampleRateHz` is refused here, and
/// so are recordings, which are samples and no events. M only.
Result<FeltStimulus> feltStimulus(const TrialJob& job, int sampleRateHz, const std::string& folder = {});

/// The world of `render SCENE ...`, as `physvib play` would play it, its files as above; or one line with
/// what is wrong. M only.
Result<FeltWorld> feltWorld(const WrittenCall& call, const std::string& folder = {});

} // namespace physvib
