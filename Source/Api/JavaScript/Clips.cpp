// SPDX-License-Identifier: MIT
// JavaScript exports for haptic clips: read a file to samples, write events as a file.
#include "Api/C/Calls.h"
#include "Api/JavaScript/Exports.h"
#include "Formats/Clip.h"
#include "Formats/ClipFile.h"
#include "Formats/StrikeClip.h"
#include "Io/Text/NameList.h"
#include "Io/Wav/WavHead.h"
#include "Scene/EventsCsv.h"
#include "Scene/LayoutFile.h"
#include <physvib/Version.h>

namespace physvib::js {

namespace {

Clip clip;
SampledSound sound;

ClipFormat formatOf(const char* name) {
    const auto format = clipFormatOf(name);
    if (!format) refuse("expected a file " + listed(clipEndings, " or "));
    return *format;
}

/// A clip with only channel `channel`, for formats with one channel.
Clip oneOf(const Clip& all, int channel) {
    return {all.title, 0.0, 0.0, {all.channels[static_cast<std::size_t>(channel)]}};
}

} // namespace

extern "C" {

/// Reads a file of that name to samples at that rate; returns the channels. Errors throw in JavaScript.
int PHYSVIB_JS(clip_read)(const char* bytes, int count, const char* name, int rateHz) {
    auto read = readClip({bytes, static_cast<std::size_t>(count)}, name, formatOf(name));
    if (!read) refuse(read.error);
    if (const std::string fault = clipFault(read.value); !fault.empty())
        refuse(std::string{name} + ": " + fault);
    clip = std::move(read.value);
    sound = clipSound(clip, rateHz);
    text() = clip.leftOut;
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
                        double error) {
    std::vector<CollisionEvent> own;
    RendererSettings wanted;
    if (const auto fault = api::convert(*settings, wanted); !fault.empty()) refuse(fault);
    if (const auto fault = api::readSorted(events, count, own); !fault.empty()) refuse(fault);
    if (own.size() > limits::maxClipStrikes)
        refuse("events: expected at most " + std::to_string(limits::maxClipStrikes));
    if (!(error > 0.0 && error <= 0.5)) refuse("error: expected more than 0, to 0.5");
    const PhantomPanner& panner = wanted.panner;
    clip = clipOfStrikes(
        own, {error, static_cast<std::size_t>(panner.channels()),
              [&](const CollisionEvent& e, PhantomPanner::Gains& gains) { panner.gainsAt(e, gains); }});
    const LayoutDescription layout = describeLayout("layout", panner.layout());
    clip.extentWidthMetres = layout.geometry.extentWidthMetres;
    clip.extentHeightMetres = layout.geometry.extentHeightMetres;
    for (std::size_t j = 0; j < clip.channels.size(); ++j) {
        clip.channels[j].label = layout.enchanters[j].label;
        clip.channels[j].place = layout.geometry.places[j];
    }
    if (const std::string fault = clipFault(clip); !fault.empty()) refuse(fault);
    return static_cast<int>(clip.channels.size());
}

/// Writes one channel of the clip (-1: all) to text(), in the file name's format. Returns 0 if silent.
int PHYSVIB_JS(clip_write)(const char* name, int channel) {
    const ClipFormat format = formatOf(name);
    const Clip one = channel < 0 ? clip : oneOf(clip, channel);
    if (!(one.seconds() > 0.0)) return 0;
    text() = clipBytes(one, format);
    return 1;
}

int PHYSVIB_JS(clip_is_mono)(const char* name) { return isMono(formatOf(name)) ? 1 : 0; }
const char* PHYSVIB_JS(clip_label)(int channel) {
    return clip.channels[static_cast<std::size_t>(channel)].label.c_str();
}

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
