// SPDX-License-Identifier: GPL-3.0-or-later
// Rendering, growing and ending of a take.
#include "Take.h"
#include <algorithm>

namespace physvib {

Take::Take(std::shared_ptr<const TakeOrder> order, int sampleRateHz, int blockFrames, std::int64_t leadFrames)
    : session{order->setup}
    , order_{std::move(order)}
    , sampleRateHz_{sampleRateHz} {
    out.assign(static_cast<std::size_t>(session.channels()), std::vector<float>(static_cast<std::size_t>(blockFrames)));
    rewind(leadFrames);
}

void Take::rewind(std::int64_t leadFrames) {
    session.prepare(sampleRateHz_, static_cast<int>(leadFrames));
    session.advance(); // its time begins with the first block
    fade_.prepare(sampleRateHz_, limits::channelRampSeconds, 1.0f);
    gap_.prepare(sampleRateHz_, limits::channelRampSeconds, 1.0f);
    last_.fill(0.0f);
    leadFrames_ = leadFrames;
    owed_ = -1;
    over_ = false;
    number = 0;
    isEnded = false;
    told_ = {};
}

bool Take::tell(std::span<const Strip> strips) {
    return tellStrips(told_, strips, [this](const RenderControl& control) { return session.take({control}).error.empty(); });
}

void Take::end() noexcept {
    if (owed_ < 0) owed_ = session.timeline().bornLatencyFrames();
}

void Take::render(int frames, std::int64_t leadFrames, RenderMode mode) noexcept {
    const int waits = static_cast<int>(std::clamp<std::int64_t>(leadFrames - this->leadFrames(), 0, frames));
    if (waits > 0) standStill(waits);
    if (waits < frames) play(waits, frames - waits, mode);
}

std::array<float*, limits::maxEnchanters> Take::from(int frame) noexcept {
    std::array<float*, limits::maxEnchanters> at{};
    for (std::size_t j = 0; j < out.size(); ++j) at[j] = out[j].data() + frame;
    return at;
}

// What was played last falls to silence: a hand would feel the step.
void Take::standStill(int frames) noexcept {
    session.wait(frames);
    for (std::size_t j = 0; j < out.size(); ++j) std::fill_n(out[j].data(), frames, last_[j]);
    gap_.moveTo(0.0f);
    gap_.apply(from(0).data(), session.channels(), frames);
}

void Take::play(int first, int frames, RenderMode mode) noexcept {
    const auto at = from(first);
    session.render(at.data(), frames, mode);
    fade(first, frames);
    for (std::size_t j = 0; j < out.size(); ++j) last_[j] = at[j][frames - 1];
    gap_.moveTo(1.0f);
    gap_.apply(at.data(), session.channels(), frames);
}

void Take::fade(int first, int frames) noexcept {
    if (owed_ < 0) return;
    const int kept = static_cast<int>(std::min<std::int64_t>(owed_, frames));
    owed_ -= kept;
    if (kept == frames) return;
    fade_.moveTo(0.0f);
    fade_.apply(from(first + kept).data(), session.channels(), frames - kept);
    over_ = fade_.isResting();
}

} // namespace physvib
