// SPDX-License-Identifier: MIT
// JavaScript exports for files: haptic clips (read as samples, write from events), event lists, WAV heads.
#include "Api/C/Calls.h"
#include "Api/JavaScript/Exports.h"
#include "Formats/Clip.h"
#include "Formats/ClipFile.h"
#include "Formats/StrikeClip.h"
#include "Io/Text/NameList.h"
#include "Io/Wav/WavHeader.h"
#include "Scene/EventsCsv.h"
#include "Scene/LayoutFile.h"
#include <physvib/Version.h>

namespace physvib::js {

namespace {

Clip clip;
SampledSound sound;

ClipFormat findFormat(const char* name) {
    const auto format = findClipFormat(name);
    if (!format) throwError("expected a file " + nameList(clipEndings, " or "));
    return *format;
}

Clip singleChannelClip(const Clip& source, int channel) {
    return {source.title, 0.0, 0.0, {source.channels[static_cast<std::size_t>(channel)]}};
}

} // namespace

extern "C" {

/// Reads a file of that name to samples at that rate; returns the channels. Errors throw in JavaScript.
int PHYSVIB_JS(clip_read)(const char* bytes, int count, const char* name, int rateHz) {
    auto read = readClip({bytes, static_cast<std::size_t>(count)}, name, findFormat(name));
    if (!read) throwError(read.error);
    if (const std::string error = clipError(read.value); !error.empty())
        throwError(std::string{name} + ": " + error);
    clip = std::move(read.value);
    sound = clipSound(clip, rateHz);
    textBuffer() = clip.omissions;
    return static_cast<int>(clip.channels.size());
}

const float* PHYSVIB_JS(clip_samples)(int channel) {
    return sound.channels[static_cast<std::size_t>(channel)].data();
}
int PHYSVIB_JS(clip_frames)() { return static_cast<int>(sound.channels.front().size()); }

/// Place of a channel, x (axis 0) or y (1), in m; NaN: none. Axes 2 and 3: width and height of the extent.
double PHYSVIB_JS(clip_place)(int channel, int axis) {
    if (axis > 1) return axis == 2 ? clip.extentWidthMetres : clip.extentHeightMetres;
    const auto& place = clip.channels[static_cast<std::size_t>(channel)].place;
    if (!place) return std::nan("");
    return axis == 0 ? place->xMetres : place->yMetres;
}

/// Converts events to a clip with one channel per actuator; returns their number. Errors throw in JavaScript.
int PHYSVIB_JS(clip_of)(const physvib_event* events, int count, const physvib_renderer_settings* settings,
                        double maxError) {
    std::vector<CollisionEvent> converted;
    RendererSettings renderer;
    if (const auto error = api::convert(*settings, renderer); !error.empty()) throwError(error);
    if (const auto error = api::readSorted(events, count, converted); !error.empty()) throwError(error);
    if (converted.size() > limits::maxClipEvents)
        throwError("events: expected at most " + std::to_string(limits::maxClipEvents));
    if (!(maxError > 0.0 && maxError <= 0.5)) throwError("error: expected more than 0, to 0.5");
    const PhantomPanner& panner = renderer.panner;
    clip = clipFromEvents(
        converted, {maxError, static_cast<std::size_t>(panner.channels()),
                    [&](const CollisionEvent& e, PhantomPanner::Gains& gains) { panner.gainsAt(e, gains); }});
    const LayoutDescription layout = describeLayout("layout", panner.layout());
    clip.extentWidthMetres = layout.geometry.extentWidthMetres;
    clip.extentHeightMetres = layout.geometry.extentHeightMetres;
    for (std::size_t j = 0; j < clip.channels.size(); ++j) {
        clip.channels[j].label = layout.actuators[j].label;
        clip.channels[j].place = layout.geometry.places[j];
    }
    if (const std::string error = clipError(clip); !error.empty()) throwError(error);
    return static_cast<int>(clip.channels.size());
}

/// Writes one channel of the clip (-1: all) to textBuffer(), in the file name's format. Returns 0 if silent.
int PHYSVIB_JS(clip_write)(const char* name, int channel) {
    const ClipFormat format = findFormat(name);
    const Clip selected = channel < 0 ? clip : singleChannelClip(clip, channel);
    if (!(selected.seconds() > 0.0)) return 0;
    textBuffer() = clipBytes(selected, format);
    return 1;
}

int PHYSVIB_JS(clip_is_mono)(const char* name) { return isMono(findFormat(name)) ? 1 : 0; }
const char* PHYSVIB_JS(clip_label)(int channel) {
    return clip.channels[static_cast<std::size_t>(channel)].label.c_str();
}

/// Writes an event list with its field, if given, to textBuffer(); errors as in physvib.h.
int PHYSVIB_JS(events_text)(const physvib_event* events, int count, double width, double height) {
    std::vector<CollisionEvent> converted;
    if (const auto error = api::readSorted(events, count, converted); !error.empty())
        return api::fail(PHYSVIB_ERROR_ARGUMENT, error);
    textBuffer() = eventsCsv(converted, {width, height}, {PHYSVIB_VERSION, {}});
    return PHYSVIB_OK;
}

/// Writes the bytes before the samples of a WAV file to textBuffer().
void PHYSVIB_JS(wav_head)(int channels, int rateHz, double frames) {
    textBuffer() = wavHeader(channels, rateHz, static_cast<std::int64_t>(frames) * channels * 4, {});
}
}

} // namespace physvib::js
