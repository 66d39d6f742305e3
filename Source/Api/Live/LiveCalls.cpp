// SPDX-License-Identifier: GPL-3.0-or-later
// The functions of physvib-live.h.
#include "Api/Live/physvib-live.h"
#include "Api/C/Convert.h"
#include "Api/C/Handles.h"
#include "Api/Live/Live.h"
#include <cmath>
#include <cstdlib>

using namespace physvib;
using namespace physvib::api;

namespace {

Handles<Live, 3>& lives() {
    static auto* const all = new Handles<Live, 3>; // never destroyed: threads may outlive main
    return *all;
}

std::uintptr_t nameOf(physvib_live live) noexcept { return reinterpret_cast<std::uintptr_t>(live); }

std::mutex& openMutex() {
    static std::mutex mutex;
    return mutex;
}
std::uintptr_t openName = 0; // under it

int close(std::uintptr_t name) noexcept {
    const std::lock_guard lock{openMutex()};
    if (!lives().remove(name)) return unknownHandle();
    openName = 0;
    return PHYSVIB_OK;
}

// JUCE has statics, which end after what was registered later than they were made.
void closeAtExit() {
    static const int registered = std::atexit([] {
        if (openName != 0) close(openName);
    });
    static_cast<void>(registered);
}

/// `call(live)`, or that there is none.
template <class Call>
auto in(physvib_live name, Call call) noexcept -> decltype(call(std::declval<Live&>())) {
    const auto live = lives().use(nameOf(name));
    if (!live) return unknownHandle();
    return guarded([&] { return call(*live); });
}

bool isLevel(double db) noexcept { return db >= -90.0 && db <= 0.0; } // not NaN

float gainOf(double db) noexcept { return static_cast<float>(std::pow(10.0, db / 20.0)); }

std::string_view faultOf(const physvib_live_settings& s) noexcept {
    if (s.rate_hz != 0 && !isSampleRate(s.rate_hz)) return "rate: expected 0, or 5000 to 192000 Hz";
    if (s.block_frames < 0 || s.block_frames > limits::maxBlockFrames) return "block: expected 0 to 8192 frames";
    if (s.steps_per_s < 20 || s.steps_per_s > 1000) return "steps: expected 20 to 1000 per second";
    if (!(s.longest_gap_s >= 0.0 && s.longest_gap_s <= 1.0)) return "longest gap: expected 0 to 1 s";
    if (!isLevel(s.level_db)) return "level: expected -90 to 0 dB";
    return {};
}

SessionSetup setupOf(const physvib_live_settings& s, const RendererSettings& renderer) {
    SessionSetup setup;
    setup.scene.name = "live"; // empty: the world is the caller's
    setup.scene.fieldWidthMetres = setup.scene.fieldHeightMetres = 1.0;
    setup.stepsPerSecond = s.steps_per_s;
    setup.longestGapSeconds = s.longest_gap_s;
    setup.channels = renderer.outputs();
    setup.panner = renderer.panner;
    setup.limiterEnabled = renderer.limiterEnabled;
    setup.log = LogUse::none;
    return setup;
}

bool takeRenderer(const physvib_renderer_settings* from, RendererSettings& to) {
    physvib_renderer_settings taken;
    if (from == nullptr) physvib_renderer_settings_init(&taken);
    else if (!take(from, taken, physvib_renderer_settings_init)) return false;
    const std::string_view fault = convert(taken, to);
    return fault.empty() || (nothingThere(fault), false);
}

int post(Live& live, RenderControl control) {
    return live.session().post(control) < 0 ? fail(PHYSVIB_ERROR_FULL, "changes: expected at most 256 that wait") : PHYSVIB_OK;
}

int change(physvib_live name, RenderControl::Kind kind, int channel, double value) noexcept {
    return in(name, [&](Live& live) {
        if (channel < 0 || channel >= live.session().channels()) return nothingThere("channel: expected one of the device's enchanters");
        if (!(value >= 0.0 && value <= 10000.0)) return nothingThere("gain: expected 0 to 10000");
        return post(live, {0, kind, channel, static_cast<float>(value), {}});
    });
}

int strike(Live& live, std::span<const physvib_event> told, std::int64_t startNs) {
    std::vector<CollisionEvent> events;
    events.reserve(told.size());
    for (const physvib_event& event : told) {
        events.push_back(eventOf(event));
        events.back().timeNs += startNs;
    }
    return live.session().playAt(events) ? PHYSVIB_OK : nothingThere("event: expected 0 to 20000 Hz, a decay or a duration, numbers, a time from 0 on");
}

} // namespace

const char* physvib_live_error() { return lastError().data(); }

int physvib_live_settings_init(physvib_live_settings* settings) {
    if (settings == nullptr) return nothingThere("settings: expected a place for them, found NULL");
    *settings = {sizeof *settings, 0, 0, 100, messageTimerGapSeconds, safeStartDecibels};
    return PHYSVIB_OK;
}

int physvib_live_status_init(physvib_live_status* status) {
    if (status == nullptr) return nothingThere("status: expected a place for it, found NULL");
    *status = {};
    status->size = sizeof *status;
    return PHYSVIB_OK;
}

int physvib_live_open(const char* device, const physvib_renderer_settings* renderer, const physvib_live_settings* settings, physvib_live* name) {
    return guarded([&] {
        if (name == nullptr || device == nullptr) return nothingThere("live: expected a device and a place for it, found NULL");
        *name = nullptr;
        physvib_live_settings taken;
        if (settings == nullptr) physvib_live_settings_init(&taken);
        else if (!take(settings, taken, physvib_live_settings_init)) return PHYSVIB_ERROR_ARGUMENT;
        RendererSettings wanted;
        if (const auto fault = faultOf(taken); !fault.empty()) return nothingThere(fault);
        if (!takeRenderer(renderer, wanted)) return PHYSVIB_ERROR_ARGUMENT;

        const std::lock_guard lock{openMutex()};
        if (openName != 0) return fail(PHYSVIB_ERROR_FULL, "live: expected the one that is open to be closed before");
        AudioOutputSettings output;
        output.device = device;
        output.sampleRateHz = taken.rate_hz;
        output.blockFrames = taken.block_frames;
        output.level = gainOf(taken.level_db);
        output.enchanters = wanted.panner.channels();
        auto live = std::make_unique<Live>(setupOf(taken, wanted), output);
        if (const std::string error = live->open(); !error.empty()) return fail(PHYSVIB_ERROR_DEVICE, error);
        openName = lives().add(std::move(live));
        closeAtExit();
        *name = reinterpret_cast<physvib_live>(openName);
        return PHYSVIB_OK;
    });
}

int physvib_live_close(physvib_live live) { return close(nameOf(live)); }

physvib_int64 physvib_live_now_ns(physvib_live name) {
    return in(name, [](Live& live) -> physvib_int64 { return live.session().presentNs(); });
}

physvib_int64 physvib_live_latency_ns(physvib_live name) {
    return in(name, [](Live& live) -> physvib_int64 { return live.session().playOutFrames() * 1'000'000'000 / std::max(1, live.status().rateHz); });
}

int physvib_live_strike(physvib_live name, const physvib_event* events, physvib_int64 count) {
    return in(name, [&](Live& live) {
        if (count < 0 || (events == nullptr && count > 0)) return nothingThere("events: expected some, found NULL");
        return strike(live, {events, static_cast<std::size_t>(count)}, 0);
    });
}

physvib_int64 physvib_live_send(physvib_live name, physvib_world world, physvib_int64 startNs, int atOnce) {
    return in(name, [&](Live& live) -> physvib_int64 {
        if (startNs < 0 || startNs > limits::maxTimeNs / 4) return nothingThere("start: expected 0 to 2.5 * 10^16 ns");
        std::array<physvib_event, 128> part;
        for (physvib_int64 sent = 0;;) {
            const physvib_int64 count = physvib_world_take(world, part.data(), part.size(), atOnce);
            if (count < 0) return fail(static_cast<int>(count), physvib_error());
            if (const int code = strike(live, {part.data(), static_cast<std::size_t>(count)}, startNs); code != PHYSVIB_OK) return code;
            sent += count;
            if (count < static_cast<physvib_int64>(part.size())) return sent;
        }
    });
}

int physvib_live_set_gain(physvib_live live, int channel, double gain) { return change(live, RenderControl::Kind::gain, channel, gain); }

int physvib_live_set_mute(physvib_live live, int channel, int isMuted) {
    return change(live, RenderControl::Kind::mute, channel, isMuted != 0 ? 1.0 : 0.0);
}

int physvib_live_set_layout(physvib_live name, const physvib_renderer_settings* renderer) {
    return in(name, [&](Live& live) {
        RendererSettings wanted;
        if (!takeRenderer(renderer, wanted)) return PHYSVIB_ERROR_ARGUMENT;
        if (wanted.panner.channels() > live.session().channels()) return nothingThere("layout: expected at most as many enchanters as channels");
        return post(live, {0, RenderControl::Kind::panner, 0, 0.0f, wanted.panner});
    });
}

int physvib_live_set_level(physvib_live name, double levelDb) {
    return in(name, [&](Live& live) {
        if (!isLevel(levelDb)) return nothingThere("level: expected -90 to 0 dB");
        live.output().setLevel(gainOf(levelDb));
        return PHYSVIB_OK;
    });
}

int physvib_live_silence(physvib_live name, int isSilent) {
    return in(name, [&](Live& live) {
        live.output().setSilent(isSilent != 0);
        return PHYSVIB_OK;
    });
}

int physvib_live_get_status(physvib_live name, physvib_live_status* status) {
    return in(name, [&](Live& live) {
        physvib_live_status told;
        if (!take<physvib_live_status>(status, told, physvib_live_status_init)) return PHYSVIB_ERROR_ARGUMENT;
        const LiveStatus now = live.status();
        told.size = status->size;
        told.is_running = now.output.isRunning ? 1 : 0;
        told.is_silent = live.output().isSilent() ? 1 : 0;
        told.rate_hz = now.rateHz;
        told.block_frames = now.blockFrames;
        told.live_modes = now.render.liveModes;
        told.losses = now.output.losses;
        told.xruns = now.output.deviceXruns;
        told.load = static_cast<double>(now.output.load);
        told.worst_load = static_cast<double>(now.output.worstLoad);
        told.played = static_cast<physvib_int64>(now.render.played);
        told.late = static_cast<physvib_int64>(now.render.late);
        told.rejected = static_cast<physvib_int64>(now.render.rejected);
        const std::size_t length = std::min(now.trouble.size(), sizeof told.trouble - 1);
        std::copy_n(now.trouble.data(), length, told.trouble);
        told.trouble[length] = '\0';
        std::memcpy(status, &told, told.size);
        return PHYSVIB_OK;
    });
}
