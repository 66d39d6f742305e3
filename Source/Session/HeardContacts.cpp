// SPDX-License-Identifier: MIT
// One channel, one place.
#include "Session/HeardContacts.h"

namespace physvib {

struct HeardContacts::Source {
    HeardContacts& heard;
    bool pop(CollisionEvent& event) noexcept { return heard.events_.pop(event); }
    bool pop(RenderControl& control) noexcept {
        control.kind = RenderControl::Kind::stopAll;
        return heard.stops_.pop(control.timeNs);
    }
};

RendererSettings HeardContacts::settingsAt(int sampleRateHz) {
    const EnchanterLayout here{1.0, 1.0, 1, {}};
    return {.sampleRateHz = sampleRateHz, .panner = {here, PanningLaw::linear, 1.0, 1.0, 1.0}};
}

void HeardContacts::prepare(int sampleRateHz) {
    renderer_->prepare(settingsAt(sampleRateHz));
    setContacts(sampleRateHz);
    for (CollisionEvent unplayed; events_.pop(unplayed);) {}
    for (std::int64_t undone = 0; stops_.pop(undone);) {}
}

void HeardContacts::moveTo(int sampleRateHz, std::int64_t frame) {
    renderer_->moveTo(sampleRateHz, frame);
    setContacts(sampleRateHz);
}

void HeardContacts::setContacts(int sampleRateHz) {
    contacts_ = {recordings_, sampleRateHz};
    renderer_->setContacts(contacts_.contacts(), true);
}

void HeardContacts::render(float* out, int frames) noexcept PHYSVIB_NONBLOCKING {
    Source source{*this};
    renderer_->render(source, &out, frames);
    for (PlayedEvent told; renderer_->played().pop(told);) {} // the enchanters' renderer has told of them
}

} // namespace physvib
