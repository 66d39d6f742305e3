// SPDX-License-Identifier: MIT
// Collects the waveform envelopes of the whole render and of its strongest impact.
#include "RenderedPicture.h"

namespace physvib {

namespace {
WaveformEnvelope zoomOf(std::span<const CollisionEvent> events, int channels, int sampleRateHz) {
    const FrameWindow window = zoomWindow(events, sampleRateHz);
    return {channels, window.firstFrame, window.frameCount};
}
} // namespace

RenderedPicture::RenderedPicture(const std::string& path, std::span<const CollisionEvent> events,
                                 int channels, int sampleRateHz, std::int64_t frames)
    : file_{path}
    , events_{events}
    , sampleRateHz_{sampleRateHz}
    , whole_{channels, 0, frames}
    , zoom_{zoomOf(events, channels, sampleRateHz)} {}

const std::string& RenderedPicture::draw(PictureInput words) {
    words.events = events_;
    words.waveform = &whole_;
    words.zoom = &zoom_;
    words.sampleRateHz = sampleRateHz_;
    words.durationSeconds = static_cast<double>(whole_.frameCount()) / sampleRateHz_;
    return file_.write(picturePng(words));
}

} // namespace physvib
