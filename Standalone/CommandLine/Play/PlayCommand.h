// SPDX-License-Identifier: GPL-3.0-or-later
// `physvib play`: a scene felt live on an audio device, without a window; `physvib devices`: where that can be.
#pragma once
#include "CommandLine/Music/BeatOptions.h"
#include "CommandLine/Render/RenderOptions.h"
#include "Host/Devices/AudioOutput.h"
#include "Host/Osc/OscPort.h"
#include <string>

namespace physvib {

/// The scene options, and where to play.
struct PlayOptions {
    RenderOptions scene;
    std::string device;
    std::string board;              ///< serial port of a four-channel board, alone or beside a device
    std::string map;                ///< "1,2,3,4": device outputs from 1, in the order of the enchanters
    std::string onOff;              ///< enchanters from 1 that are motors, on or off; empty: none
    double threshold = OnOffSteps::thesisThreshold; ///< of these, in full scale
    std::string noise;              ///< as map: outputs that play pink noise; empty: none
    double noiseDb = PinkNoise::safeDb;   ///< its root mean square, of full scale
    std::string driver = "message"; ///< or "thread"
    std::string recordPath;         ///< WAV of what was played; empty: not wanted
    std::string savePath;           ///< the session as JSON; empty: not wanted
    bool listens = false, hasHands = false, isDirect = false; ///< to standard input
    std::string clips = ".";        ///< folder of its messages' clips, and of OSC's
    std::string beatInputs;         ///< as map: of the device, whose beats are struck; empty: none
    BeatOptions beats;
    OscSettings osc;
    double oscTurnDegrees = 0.0;    ///< by which a phone is held counter-clockwise of upright
    double levelDb = safeStartDecibels; ///< master level
    std::string ceilings = "0";     ///< dB of full scale: one for all enchanters, or one each
    int blockFrames = 0;            ///< 0: as the device stands
};

void declarePlayOptions(OptionTable& command, PlayOptions& options);

/// Plays until the time is over or the user interrupts; an exit code.
int runPlay(PlayOptions& options);

/// A line per output device; an exit code.
int runDevices();

} // namespace physvib
