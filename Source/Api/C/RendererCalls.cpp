// SPDX-License-Identifier: MIT
// C functions of a renderer (queue events and changes, render samples), and of the motors of controllers.
#include "Api/C/Calls.h"
#include "Api/C/HandleObjects.h"
#include "Core/ClockLaw.h"
#include "Scene/PadFile.h"

using namespace physvib;
using namespace physvib::api;

namespace {

constexpr std::string_view timeError = "time: expected 0 to 10^17 ns";

bool isValidTimeNs(physvib_int64 ns) noexcept { return ns >= 0 && ns <= limits::maxTimeNs; }

int queueControl(physvib_renderer handle, const RenderControl& control) noexcept {
    const auto renderer = borrow(handle);
    if (!renderer) return unknownHandleError();
    if (!isValidTimeNs(control.timeNs)) return argumentError(timeError);
    if (control.channel < 0 || control.channel >= renderer->channels)
        return argumentError("channel: expected one of the renderer");
    if (!(control.value >= 0.0F && control.value <= 10000.0F))
        return argumentError("gain: expected 0 to 10000");
    if (control.panner != nullptr && control.panner->channels() > renderer->channels)
        return argumentError("layout: expected at most as many enchanters as channels");
    const std::lock_guard lock{renderer->producerMutex};
    if (!renderer->source.controls.push(control))
        return fail(PHYSVIB_ERROR_FULL, "changes: expected at most 256 that wait");
    renderer->changes.apply(control);
    return PHYSVIB_OK;
}

RenderControl makeControl(RenderControl::Kind kind, physvib_int64 timeNs, int channel, double value) {
    return {timeNs, kind, channel, static_cast<float>(value), {}};
}

/// Marks a renderer as rendering, so that a second thread is refused. Converts to false if another thread
/// renders. Audio thread.
class PullGuard {
public:
    explicit PullGuard(Renderer& renderer) noexcept
        : flag_(renderer.isRendering)
        , ownsFlag_(!flag_.test_and_set(std::memory_order_acquire)) {}
    ~PullGuard() {
        if (ownsFlag_) flag_.clear(std::memory_order_release);
    }
    PullGuard(const PullGuard&) = delete;
    PullGuard& operator=(const PullGuard&) = delete;
    explicit operator bool() const noexcept { return ownsFlag_; }

private:
    std::atomic_flag& flag_;
    bool ownsFlag_;
};

/// Checks the arguments, calls `render(renderer)` and publishes the status; returns a code. Audio thread.
template <class Render>
int pull(physvib_renderer handle, int channels, int frames, Render render) noexcept PHYSVIB_NONBLOCKING {
    const auto renderer = borrow(handle);
    if (!renderer) return PHYSVIB_ERROR_HANDLE;
    if (channels != renderer->channels || frames < 1) return PHYSVIB_ERROR_ARGUMENT;
    const PullGuard pulling{*renderer};
    if (!pulling) return PHYSVIB_ERROR_BUSY;
    if (const int code = render(*renderer); code != PHYSVIB_OK) return code;
    renderer->status.write(renderer->renderer.status());
    return PHYSVIB_OK;
}

} // namespace

int physvib_renderer_create(const physvib_renderer_settings* settings, physvib_renderer* renderer) {
    return catchExceptions([&] {
        if (renderer == nullptr) return argumentError("renderer: expected a place for it, found NULL");
        *renderer = nullptr;
        RendererSettings checked;
        if (!readRenderer(settings, checked)) return PHYSVIB_ERROR_ARGUMENT;
        auto created = std::make_unique<Renderer>();
        if (!created->renderer.prepare(checked))
            return argumentError("settings: expected some that can be rendered");
        created->rateHz = checked.sampleRateHz;
        created->channels = checked.outputs();
        created->changes.panner = checked.panner;
        const std::uintptr_t handle = renderers().add(std::move(created));
        if (handle == 0) return fail(PHYSVIB_ERROR_FULL, "renderers: expected at most 256");
        *renderer = reinterpret_cast<physvib_renderer>(handle);
        return PHYSVIB_OK;
    });
}

int physvib_renderer_free(physvib_renderer renderer) {
    return renderers().remove(reinterpret_cast<std::uintptr_t>(renderer)) ? PHYSVIB_OK : unknownHandleError();
}

int physvib_renderer_strike(physvib_renderer handle, const physvib_event* event) {
    const auto renderer = borrow(handle);
    if (!renderer) return unknownHandleError();
    if (event == nullptr) return argumentError("event: expected one, found NULL");
    CollisionEvent converted;
    if (const auto error = readEvent(*event, converted); !error.empty()) return argumentError(error);
    const std::lock_guard lock{renderer->producerMutex};
    return renderer->source.events.push(converted)
               ? PHYSVIB_OK
               : fail(PHYSVIB_ERROR_FULL, "events: expected at most 8192 that wait");
}

int physvib_renderer_pull(physvib_renderer handle, float* const* channels, int count, int frames) {
    if (channels == nullptr) return PHYSVIB_ERROR_ARGUMENT;
    return pull(handle, count, frames, [=](Renderer& renderer) noexcept {
        if (std::any_of(channels, channels + count, [](const float* channel) { return channel == nullptr; }))
            return PHYSVIB_ERROR_ARGUMENT;
        std::array<float*, limits::maxActuators> outputs{};
        for (int doneFrames = 0; doneFrames < frames;) {
            const int blockFrames = std::min(frames - doneFrames, limits::maxBlockFrames);
            for (int j = 0; j < count; ++j) outputs[static_cast<std::size_t>(j)] = channels[j] + doneFrames;
            renderer.renderer.render(renderer.source, outputs.data(), blockFrames);
            doneFrames += blockFrames;
        }
        return PHYSVIB_OK;
    });
}

int physvib_renderer_pull_interleaved(physvib_renderer handle, float* samples, int count, int frames) {
    if (samples == nullptr) return PHYSVIB_ERROR_ARGUMENT;
    return pull(handle, count, frames, [=](Renderer& renderer) noexcept {
        constexpr int maxChunkFrames = 64; // 16 KB on the audio callback's stack
        std::array<std::array<float, maxChunkFrames>, limits::maxActuators> block;
        std::array<float*, limits::maxActuators> outputs{};
        for (std::size_t j = 0; j < block.size(); ++j) outputs[j] = block[j].data();
        for (int doneFrames = 0; doneFrames < frames;) {
            const int chunkFrames = std::min(frames - doneFrames, maxChunkFrames);
            renderer.renderer.render(renderer.source, outputs.data(), chunkFrames);
            for (int n = 0; n < chunkFrames; ++n)
                for (int j = 0; j < count; ++j)
                    samples[static_cast<std::ptrdiff_t>(doneFrames + n) * count + j] =
                        block[static_cast<std::size_t>(j)][static_cast<std::size_t>(n)];
            doneFrames += chunkFrames;
        }
        return PHYSVIB_OK;
    });
}

int physvib_renderer_set_gain(physvib_renderer renderer, physvib_int64 timeNs, int channel, double gain) {
    return queueControl(renderer, makeControl(RenderControl::Kind::gain, timeNs, channel, gain));
}

int physvib_renderer_set_mute(physvib_renderer renderer, physvib_int64 timeNs, int channel, int isMuted) {
    return queueControl(renderer,
                        makeControl(RenderControl::Kind::mute, timeNs, channel, isMuted != 0 ? 1.0 : 0.0));
}

int physvib_renderer_set_level(physvib_renderer renderer, physvib_int64 timeNs, double gain) {
    return queueControl(renderer, makeControl(RenderControl::Kind::level, timeNs, 0, gain));
}

int physvib_renderer_set_layout(physvib_renderer renderer, physvib_int64 timeNs,
                                const physvib_renderer_settings* settings) {
    RendererSettings checked;
    if (!readRenderer(settings, checked)) return PHYSVIB_ERROR_ARGUMENT;
    RenderControl control = makeControl(RenderControl::Kind::panner, timeNs, 0, 0.0);
    control.panner = &checked.panner;
    return queueControl(renderer, control);
}

int physvib_renderer_silence(physvib_renderer renderer, physvib_int64 timeNs, physvib_int64 untilNs) {
    if (!isValidTimeNs(untilNs)) return argumentError(timeError);
    RenderControl control = makeControl(RenderControl::Kind::silence, timeNs, 0, 0.0);
    control.untilNs = untilNs;
    return queueControl(renderer, control);
}

int physvib_renderer_latency_frames(physvib_renderer handle) {
    const auto renderer = borrow(handle);
    return renderer ? renderer->renderer.latencyFrames() : unknownHandleError();
}

int physvib_renderer_get_status(physvib_renderer handle, physvib_renderer_status* status) {
    physvib_renderer_status result;
    if (!readStruct<physvib_renderer_status>(status, result, physvib_renderer_status_init))
        return PHYSVIB_ERROR_ARGUMENT;
    const auto renderer = borrow(handle);
    if (!renderer) return unknownHandleError();
    const std::lock_guard lock{renderer->readerMutex};
    const RenderStatus current = renderer->status.read();
    result.size = status->size;
    result.live_modes = current.liveModes;
    result.pending = current.pending;
    result.frames = current.framesRendered;
    result.played = toInt64(current.played);
    result.late = toInt64(current.late);
    result.rejected = toInt64(current.rejected);
    result.refused = toInt64(renderer->source.events.overflows());
    std::memcpy(status, &result, result.size);
    return PHYSVIB_OK;
}

physvib_int64 physvib_play_out_ns(int rateHz, int blockFrames, int stepsPerSecond, double longestGapSeconds) {
    const bool isValid = isSampleRate(rateHz) && blockFrames >= 1 && blockFrames <= limits::maxBlockFrames &&
                         stepsPerSecond >= 1 && stepsPerSecond <= 1'000'000 && longestGapSeconds >= 0.0 &&
                         longestGapSeconds <= 60.0;
    if (!isValid)
        return argumentError("play-out delay: expected 5000 to 192000 Hz, 1 to 8192 frames, 1 "
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

namespace {

constexpr int maxPads = 64;

int unknownPadError() noexcept { return argumentError("pad: expected one of those created, from 0 on"); }
bool isValidFieldSize(double metres) noexcept { return metres > 0.0 && metres <= 1.0e9; } // not NaN

} // namespace

int physvib_pads_create(int count, double fieldWidth, double fieldHeight, const char* profile,
                        physvib_pads* pads) {
    return catchExceptions([&] {
        if (pads == nullptr) return argumentError("pads: expected a place for them, found NULL");
        *pads = nullptr;
        if (count < 1 || count > maxPads) return argumentError("pads: expected 1 to 64");
        if (!isValidFieldSize(fieldWidth) || !isValidFieldSize(fieldHeight))
            return argumentError("field: expected more than 0 m, to 10^9 m");
        const auto found = profile == nullptr ? builtInPads().front() : findPad(profile);
        if (!found) return fail(PHYSVIB_ERROR_FILE, found.error);
        auto created = std::make_unique<PadSet>();
        created->pads.assign(static_cast<std::size_t>(count), Pad{found.value.law, fieldWidth, fieldHeight});
        const std::uintptr_t handle = padSets().add(std::move(created));
        if (handle == 0) return fail(PHYSVIB_ERROR_FULL, "pads: expected at most 256 handles");
        *pads = reinterpret_cast<physvib_pads>(handle);
        return PHYSVIB_OK;
    });
}

int physvib_pads_free(physvib_pads pads) {
    return padSets().remove(reinterpret_cast<std::uintptr_t>(pads)) ? PHYSVIB_OK : unknownHandleError();
}

int physvib_pads_strike(physvib_pads handle, int pad, const physvib_event* event) {
    return withObject(handle, [&](PadSet& pads) {
        if (!pads.has(pad)) return unknownPadError();
        if (event == nullptr) return argumentError("event: expected one, found NULL");
        CollisionEvent converted;
        if (const auto error = readEvent(*event, converted); !error.empty()) return argumentError(error);
        return pads.at(pad).strike(converted)
                   ? PHYSVIB_OK
                   : fail(PHYSVIB_ERROR_FULL, "events: expected at most 256 that wait for a pad");
    });
}

physvib_int64 physvib_pads_send(physvib_pads handle, int pad, physvib_world world, physvib_int64 laterNs,
                                int atOnce) {
    return withObject(handle, [&](PadSet& pads) -> physvib_int64 {
        if (!pads.has(pad)) return unknownPadError();
        if (laterNs < -limits::maxTimeNs / 4 || laterNs > limits::maxTimeNs / 4)
            return argumentError("delay: expected at most 2.5 * 10^16 ns from 0");
        std::array<physvib_event, 128> batch{};
        batch.front().size = sizeof batch.front();
        for (physvib_int64 sent = 0;;) {
            const physvib_int64 count = physvib_world_take(world, batch.data(), batch.size(), atOnce);
            if (count < 0) return count; // physvib_world_take() has set the error text
            for (CollisionEvent event;
                 const physvib_event& source : std::span{batch}.first(static_cast<std::size_t>(count))) {
                event = toCollisionEvent(source);
                event.timeNs += laterNs;
                sent += pads.at(pad).strike(event) ? 1 : 0;
            }
            if (count < static_cast<physvib_int64>(batch.size())) return sent;
        }
    });
}

int physvib_pads_pull(physvib_pads handle, physvib_int64 untilNs, physvib_motors* motors, int capacity) {
    return withObject(handle, [&](PadSet& pads) {
        const int count = static_cast<int>(pads.pads.size());
        if (motors == nullptr || capacity < count)
            return argumentError("motors: expected a place for those of each pad");
        if (!isValidTimeNs(untilNs)) return argumentError(timeError);
        if (untilNs < pads.pads.front().lastPullNs())
            return fail(PHYSVIB_ERROR_ORDER,
                        "time: expected none before the last pull's (physvib_pads_stop begins again)");
        for (int j = 0; j < count; ++j) {
            const PadCommand command = pads.at(j).pull(untilNs, pads.levelGain);
            motors[j] = {command.low, command.high};
        }
        return count;
    });
}

int physvib_pads_stop(physvib_pads handle) {
    return withObject(handle, [&](PadSet& pads) {
        for (Pad& pad : pads.pads) pad.reset();
        return PHYSVIB_OK;
    });
}

int physvib_pads_set_level(physvib_pads handle, double gain) {
    return withObject(handle, [&](PadSet& pads) {
        if (!(gain >= 0.0 && gain <= 10000.0)) return argumentError("gain: expected 0 to 10000");
        pads.levelGain = gain;
        return PHYSVIB_OK;
    });
}
