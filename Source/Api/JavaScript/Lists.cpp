// SPDX-License-Identifier: MIT
// JavaScript exports for event lists as CSV text, and for the header of a WAV file.
#include "Api/C/Calls.h"
#include "Api/JavaScript/Exports.h"
#include "Io/Wav/WavHead.h"
#include "Scene/EventsCsv.h"
#include <physvib/Version.h>

namespace physvib::js {

extern "C" {

/// Writes an event list with its field, if given, to text(); errors as in physvib.h.
int PHYSVIB_JS(events_text)(const physvib_event* events, int count, double width, double height) {
    std::vector<CollisionEvent> own;
    if (const auto fault = api::readSorted(events, count, own); !fault.empty())
        return api::fail(PHYSVIB_ERROR_ARGUMENT, fault);
    text() = eventsCsv(own, {width, height}, {PHYSVIB_VERSION, {}});
    return PHYSVIB_OK;
}

/// Writes the bytes before the samples of a WAV file to text().
void PHYSVIB_JS(wav_head)(int channels, int rateHz, double frames) {
    text() = wavHead(channels, rateHz, static_cast<std::int64_t>(frames) * channels * 4, {});
}
}

} // namespace physvib::js
