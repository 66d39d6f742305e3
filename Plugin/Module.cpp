// SPDX-License-Identifier: GPL-3.0-or-later
// Compiled for each module, with its definitions.
#include "ModuleIdentity.h"

const physvib::ModuleIdentity physvib::moduleIdentity{JucePlugin_Name, ModuleIdentity::Buses::PHYSVIB_BUSES,
                                                      PHYSVIB_CHANNELS, PHYSVIB_MUSIC_PORTS,
                                                      JucePlugin_LV2URI};
