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

constexpr int maxPads = 64;

bool isTime(physvib_int64 ns) noexcept { return ns >= 0 && ns <= limits::maxTimeNs; }
bool isFieldSize(double metres) noexcept { return metres > 0.0 && metres <= 1.0e9; } // not NaN
int noSuchPad() noexcept { return nothingThere("pad: expected one of those created, from 0 on"); }

int change(physvib_renderer name, const RenderControl& control) noexcept {
    const auto renderer = use(name);
    if (!renderer) return unknownHandle();
    if (!isTime(control.timeNs)) return nothingThere(wrongTime);
    if (control.channel < 0 || control.channel >= renderer->channels)
        return nothingThere("channel: expected one of the renderer");
    if (!(control.value >= 0.0F && control.value <= 10000.0F))
        return nothingThere("gain: expected 0 to 10000");
    if (control.panner != nullptr && control.panner->channels() > renderer->channels)
        return nothingThere("layout: expected at most as many enchanters as channels");
    const std::lock_guard lock{renderer->producers};
    if (!renderer->source.controls.push(control))
        return fail(PHYSVIB_ERROR_FULL, "changes: expected at most 256 that wait");
    renderer->changes.take(control);
    return PHYSVIB_OK;
}

/// Marks a renderer as rendering, so that a second thread is refused. Audio thread.
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
        RendererSettings wanted;
        if (!takeRenderer(settings, wanted)) return PHYSVIB_ERROR_ARGUMENT;
        auto made = std::make_unique<Renderer>();
        if (!made->renderer.prepare(wanted))
            return nothingThere("settings: expected some that can be rendered");
        made->rateHz = wanted.sampleRateHz;
        made->channels = wanted.outputs();
        made->changes.panner = wanted.panner;
        return Renderers::all().add(std::move(made), renderer, "renderers: expected at most 256");
    });
}

int physvib_renderer_free(physvib_renderer renderer) { return Renderers::all().remove(renderer); }

int physvib_renderer_strike(physvib_renderer name, const physvib_event* event) {
    const auto renderer = use(name);
    if (!renderer) return unknownHandle();
    if (event == nullptr) return nothingThere("event: expected one, found NULL");
    CollisionEvent own;
    if (const auto fault = readEvent(*event, own); !fault.empty()) return nothingThere(fault);
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
    return change(renderer, {timeNs, RenderControl::Kind::gain, channel, static_cast<float>(gain)});
}

int physvib_renderer_set_mute(physvib_renderer renderer, physvib_int64 timeNs, int channel, int isMuted) {
    return change(renderer, {timeNs, RenderControl::Kind::mute, channel, isMuted != 0 ? 1.0F : 0.0F});
}

int physvib_renderer_set_level(physvib_renderer renderer, physvib_int64 timeNs, double gain) {
    return change(renderer, {timeNs, RenderControl::Kind::level, 0, static_cast<float>(gain)});
}

int physvib_renderer_set_layout(physvib_renderer renderer, physvib_int64 timeNs,
                                const physvib_renderer_settings* settings) {
    RendererSettings wanted;
    if (!takeRenderer(settings, wanted)) return PHYSVIB_ERROR_ARGUMENT;
    return change(renderer, {timeNs, RenderControl::Kind::panner, 0, 0.0F, &wanted.panner});
}

int physvib_renderer_silence(physvib_renderer renderer, physvib_int64 timeNs, physvib_int64 untilNs) {
    if (!isTime(untilNs)) return nothingThere(wrongTime);
    return change(renderer, {timeNs, RenderControl::Kind::silence, 0, 0.0F, nullptr, untilNs});
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
    told.live_modes = now.liveModes;
    told.pending = now.pending;
    told.frames = now.framesRendered;
    told.played = static_cast<physvib_int64>(now.played);
    told.late = static_cast<physvib_int64>(now.late);
    told.rejected = static_cast<physvib_int64>(now.rejected);
    told.refused = static_cast<physvib_int64>(renderer->source.events.overflows());
    return begin(status, status->size, told);
}

physvib_int64 physvib_play_out_ns(int rateHz, int blockFrames, int stepsPerSecond, double longestGapSeconds) {
    const bool isPossible = isSampleRate(rateHz) && blockFrames >= 1 &&
                            blockFrames <= limits::maxBlockFrames && stepsPerSecond >= 1 &&
                            stepsPerSecond <= 1'000'000 && longestGapSeconds >= 0.0 &&
                            longestGapSeconds <= 60.0;
    if (!isPossible)
        return nothingThere("play-out delay: expected 5000 to 192000 Hz, 1 to 8192 frames, 1 "
                            "to 10^6 steps/s, a gap of 0 to 60 s");
    const ClockLaw law{rateHz, blockFrames, stepsPerSecond, longestGapSeconds,
                       HapticRenderer::latencyFramesAt(rateHz)};
    constexpr std::int64_t nsPerSecond = 1'000'000'000;
    return (law.outputLatencyFrames() * nsPerSecond + rateHz - 1) / rateHz;
}

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
        return AllPads::all().add(std::move(made), pads, "pads: expected at most 256 handles");
    });
}

int physvib_pads_free(physvib_pads pads) { return AllPads::all().remove(pads); }

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
            for (const physvib_event& taken : std::span{part}.first(static_cast<std::size_t>(count))) {
                CollisionEvent event = eventOf(taken);
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
        if (!isTime(untilNs)) return nothingThere(wrongTime);
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
