// SPDX-License-Identifier: GPL-3.0-or-later
// Ring in, file out.
#include "Host/Recordings/PlayedRecorder.h"
#include "Io/Text/NumberText.h"

namespace physvib {

void PlayedRecorder::drain() {
    tap_.read([this](const float* const* channels, int frames) {
        if (const auto begins = beginsSeconds(); begins && written_ == 0)
            wav_.setComment("begins at session time " + fixedNumber(*begins, 6) + " s");
        wav_.write(channels, frames);
        written_ += frames;
    });
}

const std::string& PlayedRecorder::finish() {
    drain();
    return wav_.finish();
}

} // namespace physvib
