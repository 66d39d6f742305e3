// SPDX-License-Identifier: GPL-3.0-or-later
// What a call of the program renders, as events for a live session: a trial is felt by the words that its row keeps.
#pragma once
#include "Files/LayoutFile.h"
#include "Files/Result.h"
#include "Session/SessionSetup.h"
#include "Study/Stimulus.h"
#include <string>
#include <vector>

namespace physvib {

struct CallStimulus {
    Stimulus stimulus;            ///< times from 0
    LayoutDescription layout;
    std::vector<float> gains;     ///< of each enchanter: from the events' unit (g, or shares of full scale) to full scale
    std::vector<ContactRecording> recordings; ///< played instead of modes; none: modes
};

/// A scene that can be watched while it is felt.
struct CallWorld {
    SessionSetup setup;
    LayoutDescription layout;
    double seconds = 0.0; ///< of the call
};

/// Empty, or what the program would find wrong with the words of a call. M only.
std::string wordsFault(const std::string& call);

/// Empty, or that a call renders a fixed level that its layout cannot give without the limiter. M only.
std::string studyLevelFault(const std::string& call, const std::string& folder);

/// The stimulus of `render SCENE ...` or `stimulus ...`, without the name of the program; or one line with what is wrong. Files are looked
/// for in `folder` first, if there is one.
/// What `physvib stimulus` would refuse as too strong for the layout at `sampleRateHz` is refused here, and so is `stimulus
/// wav`, which is samples and no events. M only.
Result<CallStimulus> stimulusOfCall(const std::string& call, int sampleRateHz, const std::string& folder = {});

/// The world of `render SCENE ...`, as `physvib play` would play it, its files as above; or one line with what is wrong. M only.
Result<CallWorld> worldOfCall(const std::string& call, const std::string& folder = {});

} // namespace physvib
