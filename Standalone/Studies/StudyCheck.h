// SPDX-License-Identifier: GPL-3.0-or-later
// A study looked at before anybody takes part: how strong each stimulus is, what limiter and guard would
// alter, how long it takes, how orders balance.
#pragma once
#include "Lab/Study/Protocol.h"
#include <string>
#include <vector>

namespace physvib {

/// A stimulus of a condition, or a part of it (an alternative, an object), at the highest level that the
/// protocol allows.
struct CheckedStimulus {
    std::size_t condition = 0; ///< its index in the protocol
    std::string label, part;   ///< no part: empty
    double levelDb = 0.0;      ///< of the part, the highest that a session can set
    double seconds = 0.0;      ///< that it lasts
    double frequencyHz = 0.0;  ///< of the strongest impact or pulse
    double peakShare = 0.0;    ///< of its own full scale, of the actuator nearest to it or furthest beyond;
                               ///< without the limiter
    double neededG = 0.0;      ///< full scale that this actuator would need for it
    double peakG = 0.0, rmsG = 0.0; ///< of the strongest actuator, the latter over the time that it lasts
    double squareGSeconds = 0.0;    ///< hand-weighted, of all actuators together: see HandWeighting.h
    double guardGain = 1.0;         ///< the least that OutputGuard leaves of it; 1: all
    bool isOpenEnded = false;       ///< a world with hands: as its own script has it
    std::string error;              ///< it cannot be played: one line
};

/// What is found. M only.
struct StudyCheck {
    std::vector<CheckedStimulus> stimuli;
    std::vector<std::string> errors;     ///< why it may not be run
    std::vector<std::string> warnings;   ///< what a person should decide
    std::vector<std::string> facts;      ///< trials, time, exposure, orders
    std::vector<std::string> deviations; ///< from the thesis, of a built-in protocol
};

/// The check as one page of text: a line per stimulus, then facts, deviations, errors and warnings. Any
/// thread (allocates).
std::string textOf(const StudyCheck& check, const Protocol& protocol);

/// The same as a page of HTML that needs nothing else. Any thread (allocates).
std::string htmlOf(const StudyCheck& check, const Protocol& protocol);

/// Renders every stimulus once. M only.
StudyCheck checkStudy(const Protocol& protocol, int participants);

/// The first stimulus that would need the limiter, or more than its layout can give, at the highest level
/// that a session can set, with what it would need instead; empty if there is none. Worlds with hands are
/// left out: how strong they are, their participants decide. M only.
std::string limiterFault(const Protocol& protocol);

} // namespace physvib
