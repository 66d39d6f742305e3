// SPDX-License-Identifier: MIT
// C functions of a renderer (queue events and changes, render samples), and of the motors of controllers.
#include "Api/C/Calls.h"
#include "Api/C/Objects.h"
#include "Core/ClockLaw.h"
#include "Scene/PadFile.h"

using namespace physvib;
using namespace physvib::api;

namespace {

constexpr std::string_view wrongTime = "time: expected 0 to 10^17 ns";

bool isTime(physvib_int64 ns) noexcept { return ns >= 0 && ns <= limits::maxTimeNs; }

int change(physvib_renderer name, const RenderControl& control) noexcept {
    const auto renderer = use(name);
    if (!renderer) return unknownHandle();
    if (!isTime(control.timeNs)) return fail(PHYSVIB_ERROR_ARGUMENT, wrongTime);
    if (control.channel < 0 || control.channel >= renderer->channels)
        return fail(PHYSVIB_ERROR_ARGUMENT, "channel: expected one of the renderer");
    if (!(control.value >= 0.0F && control.value <= 10000.0F))
        return fail(PHYSVIB_ERROR_ARGUMENT, "gain: expected 0 to 10000");
    if (control.panner != nullptr && control.panner->channels() > renderer->channels)
        return fail(PHYSVIB_ERROR_ARGUMENT, "layout: expected at most as many enchanters as channels");
    const std::lock_guard lock{renderer->producers};
    if (!renderer->source.controls.push(control))
        return fail(PHYSVIB_ERROR_FULL, "changes: expected at most 256 that wait");
    renderer->changes.take(control);
    return PHYSVIB_OK;
}

RenderControl controlOf(RenderControl::Kind kind, physvib_int64 timeNs, int channel, double value) {
    RenderControl control;
    control.timeNs = timeNs;
    control.kind = kind;
    control.channel = channel;
    control.value = static_cast<float>(value);
    return control;
}

/// Marks a renderer as rendering, so that a second thread is refused. R.
class Pulling {
public:
    explicit Pulling(Renderer& renderer) noexcept
        : flag_(renderer.isPulled)
        , isAlone_(!flag_.test_and_set(std::memory_order_acquire)) {}
    ~Pulling() {
        if (isAlone_) flag_.clear(std::memory_order_release);
    }
    Pulling(const Pulling&) = delete;
    Pulling& operator=(const Pulling&) = delete;
    explicit operator bool() const noexcept { return isAlone_; }

private:
    std::atomic_flag& flag_;
    bool isAlone_;
};

/// Checks the caller's channel count, then returns the result of `block(renderer)`. Audio thread.
template <class Block>
int pull(physvib_renderer name, int channels, int frames, Block block) noexcept PHYSVIB_NONBLOCKING {
    const auto renderer = use(name);
    if (!renderer) return PHYSVIB_ERROR_HANDLE;
    if (channels != renderer->channels || frames < 1) return PHYSVIB_ERROR_ARGUMENT;
    const Pulling pulling{*renderer};
    if (!pulling) return PHYSVIB_ERROR_BUSY;
    if (const int code = block(*renderer); code != PHYSVIB_OK) return code;
    renderer->status.write(renderer->renderer.status());
    return PHYSVIB_OK;
}

} // namespace

int physvib_renderer_create(const physvib_renderer_settings* settings, physvib_renderer* renderer) {
    return guarded([&] {
        if (renderer == nullptr) return nothingThere("renderer: expected a place for it, found NULL");
        *renderer = nullptr;
        physvib_renderer_settings taken;
        RendererSettings wanted;
        if (!take(settings, taken, physvib_renderer_settings_init)) return PHYSVIB_ERROR_ARGUMENT;
        if (const auto fault = convert(taken, wanted); !fault.empty())
            return fail(PHYSVIB_ERROR_ARGUMENT, fault);
        auto made = std::make_unique<Renderer>();
        if (!made->renderer.prepare(wanted))
            return fail(PHYSVIB_ERROR_ARGUMENT, "settings: expected some that can be rendered");
        made->rateHz = wanted.sampleRateHz;
        made->channels = wanted.outputs();
        made->changes.panner = wanted.panner;
        const std::uintptr_t name = renderers().add(std::move(made));
        if (name == 0) return fail(PHYSVIB_ERROR_FULL, "renderers: expected at most 256");
        *renderer = reinterpret_cast<physvib_renderer>(name);
        return PHYSVIB_OK;
    });
}

int physvib_renderer_free(physvib_renderer renderer) {
    return renderers().remove(reinterpret_cast<std::uintptr_t>(renderer)) ? PHYSVIB_OK : unknownHandle();
}

int physvib_renderer_strike(physvib_renderer name, const physvib_event* event) {
    const auto renderer = use(name);
    if (!renderer) return unknownHandle();
    if (event == nullptr) return nothingThere("event: expected one, found NULL");
    CollisionEvent own;
    if (const auto fault = readEvent(*event, own); !fault.empty()) return fail(PHYSVIB_ERROR_ARGUMENT, fault);
    const std::lock_guard lock{renderer->producers};
    return renderer->source.events.push(own)
               ? PHYSVIB_OK
               : fail(PHYSVIB_ERROR_FULL, "events: expected at most 8192 that wait");
}

int physvib_renderer_pull(physvib_renderer name, float* const* channels, int count, int frames) {
    if (channels == nullptr) return PHYSVIB_ERROR_ARGUMENT;
    return pull(name, count, frames, [=](Renderer& renderer) noexcept {
        if (std::any_of(channels, channels + count, [](const float* channel) { return channel == nullptr; }))
            return PHYSVIB_ERROR_ARGUMENT;
        std::array<float*, limits::maxEnchanters> at{};
        for (int done = 0; done < frames;) {
            const int block = std::min(frames - done, limits::maxBlockFrames);
            for (int j = 0; j < count; ++j) at[static_cast<std::size_t>(j)] = channels[j] + done;
            renderer.renderer.render(renderer.source, at.data(), block);
            done += block;
        }
        return PHYSVIB_OK;
    });
}

int physvib_renderer_pull_interleaved(physvib_renderer name, float* samples, int count, int frames) {
    if (samples == nullptr) return PHYSVIB_ERROR_ARGUMENT;
    return pull(name, count, frames, [=](Renderer& renderer) noexcept {
        constexpr int most = 64; // 16 KB on the audio callback's stack
        std::array<std::array<float, most>, limits::maxEnchanters> block;
        std::array<float*, limits::maxEnchanters> at{};
        for (std::size_t j = 0; j < block.size(); ++j) at[j] = block[j].data();
        for (int done = 0; done < frames;) {
            const int part = std::min(frames - done, most);
            renderer.renderer.render(renderer.source, at.data(), part);
            for (int n = 0; n < part; ++n)
                for (int j = 0; j < count; ++j)
                    samples[static_cast<std::ptrdiff_t>(done + n) * count + j] =
                        block[static_cast<std::size_t>(j)][static_cast<std::size_t>(n)];
            done += part;
        }
        return PHYSVIB_OK;
    });
}

int physvib_renderer_set_gain(physvib_renderer renderer, physvib_int64 timeNs, int channel, double gain) {
    return change(renderer, controlOf(RenderControl::Kind::gain, timeNs, channel, gain));
}

int physvib_renderer_set_mute(physvib_renderer renderer, physvib_int64 timeNs, int channel, int isMuted) {
    return change(renderer, controlOf(RenderControl::Kind::mute, timeNs, channel, isMuted != 0 ? 1.0 : 0.0));
}

int physvib_renderer_set_level(physvib_renderer renderer, physvib_int64 timeNs, double gain) {
    return change(renderer, controlOf(RenderControl::Kind::level, timeNs, 0, gain));
}

int physvib_renderer_set_layout(physvib_renderer renderer, physvib_int64 timeNs,
                                const physvib_renderer_settings* settings) {
    physvib_renderer_settings taken;
    RendererSettings wanted;
    if (!take(settings, taken, physvib_renderer_settings_init)) return PHYSVIB_ERROR_ARGUMENT;
    if (const auto fault = convert(taken, wanted); !fault.empty()) return fail(PHYSVIB_ERROR_ARGUMENT, fault);
    RenderControl control = controlOf(RenderControl::Kind::panner, timeNs, 0, 0.0);
    control.panner = &wanted.panner;
    return change(renderer, control);
}

int physvib_renderer_silence(physvib_renderer renderer, physvib_int64 timeNs, physvib_int64 untilNs) {
    if (!isTime(untilNs)) return fail(PHYSVIB_ERROR_ARGUMENT, wrongTime);
    RenderControl control = controlOf(RenderControl::Kind::silence, timeNs, 0, 0.0);
    control.untilNs = untilNs;
    return change(renderer, control);
}

int physvib_renderer_latency_frames(physvib_renderer name) {
    const auto renderer = use(name);
    return renderer ? renderer->renderer.latencyFrames() : unknownHandle();
}

int physvib_renderer_get_status(physvib_renderer name, physvib_renderer_status* status) {
    physvib_renderer_status told;
    if (!take<physvib_renderer_status>(status, told, physvib_renderer_status_init))
        return PHYSVIB_ERROR_ARGUMENT;
    const auto renderer = use(name);
    if (!renderer) return unknownHandle();
    const std::lock_guard lock{renderer->readers};
    const RenderStatus now = renderer->status.read();
    told.size = status->size;
    told.live_modes = now.liveModes;
    told.pending = now.pending;
    told.frames = now.framesRendered;
    told.played = static_cast<physvib_int64>(now.played);
    told.late = static_cast<physvib_int64>(now.late);
    told.rejected = static_cast<physvib_int64>(now.rejected);
    told.refused = static_cast<physvib_int64>(renderer->source.events.overflows());
    std::memcpy(status, &told, told.size);
    return PHYSVIB_OK;
}

physvib_int64 physvib_play_out_ns(int rateHz, int blockFrames, int stepsPerSecond, double longestGapSeconds) {
    const bool isPossible = isSampleRate(rateHz) && blockFrames >= 1 &&
                            blockFrames <= limits::maxBlockFrames && stepsPerSecond >= 1 &&
                            stepsPerSecond <= 1'000'000 && longestGapSeconds >= 0.0 &&
                            longestGapSeconds <= 60.0;
    if (!isPossible)
        return fail(PHYSVIB_ERROR_ARGUMENT, "play-out delay: expected 5000 to 192000 Hz, 1 to 8192 frames, 1 "
                                            "to 10^6 steps/s, a gap of 0 to 60 s");
    ClockLaw law;
    law.sampleRateHz = rateHz;
    law.blockFrames = blockFrames;
    law.stepsPerSecond = stepsPerSecond;
    law.longestGapSeconds = longestGapSeconds;
    law.limiterFrames = HapticRenderer::latencyFramesAt(rateHz);
    constexpr std::int64_t nsPerSecond = 1'000'000'000;
    return (law.outputLatencyFrames() * nsPerSecond + rateHz - 1) / rateHz;
}

using namespace physvib;
using namespace physvib::api;

namespace {

constexpr int maxPads = 64;

int noSuchPad() noexcept { return nothingThere("pad: expected one of those created, from 0 on"); }
bool isFieldSize(double metres) noexcept { return metres > 0.0 && metres <= 1.0e9; } // not NaN

} // namespace

int physvib_pads_create(int count, double fieldWidth, double fieldHeight, const char* profile,
                        physvib_pads* pads) {
    return guarded([&] {
        if (pads == nullptr) return nothingThere("pads: expected a place for them, found NULL");
        *pads = nullptr;
        if (count < 1 || count > maxPads) return nothingThere("pads: expected 1 to 64");
        if (!isFieldSize(fieldWidth) || !isFieldSize(fieldHeight))
            return nothingThere("field: expected more than 0 m, to 10^9 m");
        const auto found = profile == nullptr ? builtInPads().front() : findPad(profile);
        if (!found) return fail(PHYSVIB_ERROR_FILE, found.error);
        auto made = std::make_unique<Pads>();
        made->pads.assign(static_cast<std::size_t>(count), Pad{found.value.law, fieldWidth, fieldHeight});
        const std::uintptr_t name = allPads().add(std::move(made));
        if (name == 0) return fail(PHYSVIB_ERROR_FULL, "pads: expected at most 256 handles");
        *pads = reinterpret_cast<physvib_pads>(name);
        return PHYSVIB_OK;
    });
}

int physvib_pads_free(physvib_pads pads) {
    return allPads().remove(reinterpret_cast<std::uintptr_t>(pads)) ? PHYSVIB_OK : unknownHandle();
}

int physvib_pads_strike(physvib_pads name, int pad, const physvib_event* event) {
    return in(name, [&](Pads& pads) {
        if (!pads.has(pad)) return noSuchPad();
        if (event == nullptr) return nothingThere("event: expected one, found NULL");
        CollisionEvent own;
        if (const auto fault = readEvent(*event, own); !fault.empty()) return nothingThere(fault);
        return pads.at(pad).strike(own)
                   ? PHYSVIB_OK
                   : fail(PHYSVIB_ERROR_FULL, "events: expected at most 256 that wait for a pad");
    });
}

physvib_int64 physvib_pads_send(physvib_pads name, int pad, physvib_world world, physvib_int64 laterNs,
                                int atOnce) {
    return in(name, [&](Pads& pads) -> physvib_int64 {
        if (!pads.has(pad)) return noSuchPad();
        if (laterNs < -limits::maxTimeNs / 4 || laterNs > limits::maxTimeNs / 4)
            return nothingThere("delay: expected at most 2.5 * 10^16 ns from 0");
        std::array<physvib_event, 128> part{};
        part.front().size = sizeof part.front();
        for (physvib_int64 sent = 0;;) {
            const physvib_int64 count = physvib_world_take(world, part.data(), part.size(), atOnce);
            if (count < 0) return count; // its text is that of physvib_world_take
            for (CollisionEvent event;
                 const physvib_event& taken : std::span{part}.first(static_cast<std::size_t>(count))) {
                event = eventOf(taken);
                event.timeNs += laterNs;
                sent += pads.at(pad).strike(event) ? 1 : 0;
            }
            if (count < static_cast<physvib_int64>(part.size())) return sent;
        }
    });
}

int physvib_pads_pull(physvib_pads name, physvib_int64 untilNs, physvib_motors* motors, int capacity) {
    return in(name, [&](Pads& pads) {
        const int count = static_cast<int>(pads.pads.size());
        if (motors == nullptr || capacity < count)
            return nothingThere("motors: expected a place for those of each pad");
        if (untilNs < 0 || untilNs > limits::maxTimeNs) return nothingThere("time: expected 0 to 10^17 ns");
        if (untilNs < pads.pads.front().pulledNs())
            return fail(PHYSVIB_ERROR_ORDER,
                        "time: expected none before the last pull's (physvib_pads_stop begins again)");
        for (int j = 0; j < count; ++j) {
            const PadCommand command = pads.at(j).pull(untilNs, pads.level);
            motors[j] = {command.low, command.high};
        }
        return count;
    });
}

int physvib_pads_stop(physvib_pads name) {
    return in(name, [&](Pads& pads) {
        for (Pad& pad : pads.pads) pad.reset();
        return PHYSVIB_OK;
    });
}

int physvib_pads_set_level(physvib_pads name, double gain) {
    return in(name, [&](Pads& pads) {
        if (!(gain >= 0.0 && gain <= 10000.0)) return nothingThere("gain: expected 0 to 10000");
        pads.level = gain;
        return PHYSVIB_OK;
    });
}
