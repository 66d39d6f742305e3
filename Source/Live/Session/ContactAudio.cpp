// SPDX-License-Identifier: MIT
// Renders the audio of contacts on one channel, or panned to two.
#include "Live/Session/ContactAudio.h"
#include "Core/Units.h"
#include <new>

namespace physvib {

namespace {

// A panner between left and right with constant power at every place.
PhantomPanner stereoPanner(double fieldWidthMetres, double fieldHeightMetres) noexcept {
    const ActuatorLayout leftRight{1.0, 1.0, 2, {{{0.0, 0.5}, {1.0, 0.5}}}};
    return {leftRight, PanningLaw::energy, 1.0, fieldWidthMetres, fieldHeightMetres};
}

// Settings of the renderer. With one channel the place does not matter.
RendererSettings rendererSettings(int sampleRateHz, int channels, const PhantomPanner& field) {
    const ActuatorLayout single{1.0, 1.0, 1, {}};
    return {.sampleRateHz = sampleRateHz,
            .panner = channels > 1 ? stereoPanner(field.fieldWidthMetres(), field.fieldHeightMetres())
                                   : PhantomPanner{single, PanningLaw::linear, 1.0, 1.0, 1.0}};
}

// The controls that also act on the audio: stops, and with two channels changes of the field.
std::vector<RenderControl> audioControls(std::vector<RenderControl> actuators, int channels,
                                         std::deque<PhantomPanner>& panners) {
    using enum RenderControl::Kind;
    std::erase_if(actuators, [channels](const RenderControl& control) {
        return control.kind != stopAll && !(control.kind == panner && channels > 1);
    });
    for (RenderControl& control : actuators)
        if (control.kind == panner)
            control.panner = &panners.emplace_back(
                stereoPanner(control.panner->fieldWidthMetres(), control.panner->fieldHeightMetres()));
    return actuators;
}

} // namespace

struct ContactAudio::Source {
    ContactAudio& audio;
    bool pop(CollisionEvent& event) noexcept { return audio.events_.pop(event); }
    bool pop(RenderControl& control) noexcept {
        Change change;
        if (!audio.fields_.hasRoom() || !audio.changes_.pop(change)) return false;
        control = {.timeNs = change.timeNs};
        if (change.fieldWidthMetres > 0.0) {
            control.kind = RenderControl::Kind::panner;
            control.panner =
                audio.fields_.store(stereoPanner(change.fieldWidthMetres, change.fieldHeightMetres));
        }
        return true;
    }
    void done(const RenderControl& control) noexcept { PannerPool<32>::release(control.panner); }
};

void ContactAudio::prepare(int sampleRateHz) {
    if (!renderer_->prepare(rendererSettings(sampleRateHz, channels_, field_))) throw std::bad_alloc{};
    setContacts(sampleRateHz);
    for (CollisionEvent unplayed; events_.pop(unplayed);) {
    }
    for (Change undone; changes_.pop(undone);) {
    }
    fields_.clear();
    fields_.reserve(32);
}

void ContactAudio::moveTo(int sampleRateHz, std::int64_t frame) {
    if (!renderer_->moveTo(sampleRateHz, frame)) throw std::bad_alloc{};
    setContacts(sampleRateHz);
}

void ContactAudio::setContacts(int sampleRateHz) {
    contacts_ = {recordings_, sampleRateHz};
    renderer_->setContacts({contacts_.contacts(), true});
}

void ContactAudio::discard(const WaitingEvents& which) noexcept PHYSVIB_NONBLOCKING {
    Source source{*this};
    renderer_->discard(source, which);
}

void ContactAudio::render(float* const* out, int frames) noexcept PHYSVIB_NONBLOCKING {
    Source source{*this};
    renderer_->render(source, out, frames);
    for (PlayedEvent unused; renderer_->played().pop(unused);) {
    } // discarded: the actuators' renderer has reported them
}

RenderStatus renderContactAudio(std::vector<CollisionEvent> events, std::vector<RenderControl> controls,
                                const ContactAudioRender& settings, const BlockConsumer& consume) {
    std::erase_if(events, [](const CollisionEvent& event) { return isClip(event.sound); });
    std::deque<PhantomPanner> panners;
    const auto changes = audioControls(std::move(controls), settings.channels, panners);
    const auto gain = static_cast<float>(fromDecibels(settings.levelDb));
    std::vector<std::vector<float>> scaled(static_cast<std::size_t>(settings.channels));
    std::vector<const float*> scaledChannels(scaled.size());
    return renderOffline(events,
                         {rendererSettings(settings.sampleRateHz, settings.channels, settings.field),
                          settings.frames, settings.blockFrames, changes, settings.recordings},
                         [&](const float* const* channels, int frames) {
                             for (std::size_t c = 0; c < scaled.size(); ++c) {
                                 scaled[c].assign(channels[c], channels[c] + frames);
                                 for (float& sample : scaled[c]) sample *= gain;
                                 scaledChannels[c] = scaled[c].data();
                             }
                             return consume(scaledChannels.data(), frames);
                         });
}

} // namespace physvib
