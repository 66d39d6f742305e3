// SPDX-License-Identifier: GPL-3.0-or-later
// Every screen of the studies, for their pictures.
#pragma once
#include "Mixer/Window/MixerView.h"
#include <vector>

namespace physvib {

struct StudyShot {
    const char* name;
    void (*reach)(MixerModel&, MixerView&);
};

/// In the order of the documents. Their rows go to a folder that is removed with the program.
const std::vector<StudyShot>& studyShots();

} // namespace physvib
