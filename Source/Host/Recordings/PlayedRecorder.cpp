// SPDX-License-Identifier: GPL-3.0-or-later
// Ring in, file out.
#include "Host/Recordings/PlayedRecorder.h"

namespace physvib {

void PlayedRecorder::drain() {
    tap_.read([this](const float* const* channels, int frames) {
        wav_.write(channels, frames);
        written_ += frames;
    });
}

const std::string& PlayedRecorder::finish() {
    drain();
    return wav_.finish();
}

} // namespace physvib
