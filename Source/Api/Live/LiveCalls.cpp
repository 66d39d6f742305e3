// SPDX-License-Identifier: MIT
// The functions of physvib-live.h that act on an open device: events, levels, silence and status.
#include "Api/C/Calls.h"
#include "Api/Live/Lives.h"
#include "Api/Live/physvib-live.h"
#include "Live/Devices/AudioDevice.h"
#include "Live/Devices/SinkTable.h"
#include <algorithm>
#include <array>
#include <cstring>
#include <iterator>
#include <span>
#include <string>

using namespace physvib;
using namespace physvib::api;

namespace {

int post(Live& live, RenderControl control) {
    return live.session().submit({control})
               ? PHYSVIB_OK
               : fail(PHYSVIB_ERROR_FULL, "changes: expected at most 256 that wait");
}

int change(physvib_live name, RenderControl::Kind kind, int channel, double value) noexcept {
    return in(name, [&](Live& live) {
        if (channel < 0 || channel >= live.session().channels())
            return nothingThere("channel: expected one of the device's enchanters");
        if (!(value >= 0.0 && value <= 10000.0)) return nothingThere("gain: expected 0 to 10000");
        return post(live, {0, kind, channel, static_cast<float>(value), {}});
    });
}

int strike(Live& live, const physvib_event* given, std::int64_t count, std::int64_t startNs) {
    std::vector<CollisionEvent> events;
    if (const auto fault = readEvents(given, count, events); !fault.empty()) return nothingThere(fault);
    for (CollisionEvent& event : events) // those before the session's start are late and play at once
        event.timeNs = std::clamp<std::int64_t>(event.timeNs + startNs, 0, limits::maxTimeNs);
    if (live.session().pulse().dropsNow(events.size())) return PHYSVIB_OK; // the status reports them
    return live.session().submit({Strikes{events, true}, 0})
               ? PHYSVIB_OK
               : fail(PHYSVIB_ERROR_FULL, "events: expected fewer that wait for their time");
}

/// Passes all events of a world to `play`, up to 128 at once, final or not: a device sorts them by time.
/// Returns their number, or the first error.
template <class Play>
physvib_int64 takeAll(physvib_world world, Play play) {
    std::array<physvib_event, 128> part{};
    part.front().size = sizeof part.front(); // the other library may know a longer one
    for (physvib_int64 sent = 0;;) {
        const physvib_int64 count = physvib_world_take(world, part.data(), part.size(), 1);
        if (count < 0) return fail(static_cast<int>(count), physvib_error());
        if (const int code = play(std::span{part}.first(static_cast<std::size_t>(count))); code != PHYSVIB_OK)
            return code;
        sent += count;
        if (count < static_cast<physvib_int64>(part.size())) return sent;
    }
}

} // namespace

const char* physvib_live_error() { return lastError().data(); }

int physvib_live_status_init(physvib_live_status* status, size_t size) {
    return begin(status, size, zeroed<physvib_live_status>());
}

int physvib_live_receipt_init(physvib_live_receipt* receipt, size_t size) {
    return begin(receipt, size, zeroed<physvib_live_receipt>());
}

int physvib_live_left(physvib_live name, physvib_int64 fromNs, physvib_int64 toNs, int actuator,
                      physvib_live_receipt* receipt) {
    return in(name, [&](Live& live) {
        physvib_live_receipt told;
        if (!take<physvib_live_receipt>(receipt, told, physvib_live_receipt_init))
            return PHYSVIB_ERROR_ARGUMENT;
        if (actuator < 0 || actuator >= live.session().channels())
            return nothingThere("actuator: expected one of the device's, from 0");
        const Receipt left = live.output().left(fromNs, toNs, actuator);
        told.size = receipt->size;
        told.frames = left.frames;
        told.peak = left.peak;
        told.mean_square = left.meanSquare;
        told.running = left.isRunning ? 1 : 0;
        told.opening = static_cast<int>(left.opening);
        told.over = left.isOver ? 1 : 0;
        told.kept = left.isKept ? 1 : 0;
        std::memcpy(receipt, &told, told.size);
        return PHYSVIB_OK;
    });
}

physvib_int64 physvib_live_now_ns(physvib_live name) {
    return in(name, [](Live& live) -> physvib_int64 { return live.session().timeline().presentNs(); });
}

physvib_int64 physvib_live_latency_ns(physvib_live name) {
    return in(name, [](Live& live) -> physvib_int64 {
        return live.session().timeline().outputLatencyFrames() * 1'000'000'000 /
               std::max(1, live.status().rateHz);
    });
}

int physvib_live_strike(physvib_live name, const physvib_event* events, physvib_int64 count) {
    return in(name, [&](Live& live) {
        if (count < 0 || (events == nullptr && count > 0))
            return nothingThere("events: expected some, found NULL");
        return strike(live, events, count, 0);
    });
}

int physvib_live_align(physvib_live name, physvib_world world, physvib_int64* startNs) {
    return in(name, [&](Live& live) {
        if (startNs == nullptr) return nothingThere("start: expected a place for it, found NULL");
        const physvib_int64 timeNs = physvib_world_time_ns(world);
        if (timeNs < 0) return fail(static_cast<int>(timeNs), physvib_error());
        // The last step of the world begins now. A call may be late by the output latency. A world that runs
        // ahead, as after an xrun, plays later by as much, so it may be ahead by a step less than that.
        const Timeline& session = live.session().timeline();
        const physvib_int64 stepNs = 1'000'000'000 / live.stepsPerSecond(),
                            wanted = session.presentNs() + stepNs - timeNs;
        const auto latencyNs = static_cast<physvib_int64>(session.outputLatencySeconds() * 1.0e9);
        if (*startNs < wanted - latencyNs || *startNs > wanted + latencyNs - stepNs) *startNs = wanted;
        return PHYSVIB_OK;
    });
}

physvib_int64 physvib_live_send(physvib_live name, physvib_world world, physvib_int64 startNs, int) {
    return in(name, [&](Live& live) -> physvib_int64 {
        if (startNs < -limits::maxTimeNs / 4 || startNs > limits::maxTimeNs / 4)
            return nothingThere("start: expected at most 2.5 * 10^16 ns from 0");
        return takeAll(world, [&](std::span<const physvib_event> part) {
            return strike(live, part.data(), std::ssize(part), startNs);
        });
    });
}

physvib_int64 physvib_live_send_each(const physvib_live* names, int count, physvib_world world,
                                     physvib_int64* startsNs) {
    return guarded([&]() -> physvib_int64 {
        if (names == nullptr || startsNs == nullptr || count < 1)
            return nothingThere("devices: expected one or more, found none");
        for (int k = 0; k < count; ++k)
            if (const int code = physvib_live_align(names[k], world, startsNs + k); code != PHYSVIB_OK)
                return code;
        std::vector<physvib_event> own;
        return takeAll(world, [&](std::span<const physvib_event> part) {
            int code = PHYSVIB_OK;
            for (int k = 0; k < count && code == PHYSVIB_OK; ++k) {
                own.clear();
                std::ranges::copy_if(part, std::back_inserter(own), [&](const physvib_event& event) {
                    const int device = physvib_world_device(world, event.fixture);
                    return (device < count ? device : 0) == k;
                });
                if (!own.empty())
                    code = in(names[k], [&](Live& live) {
                        return strike(live, own.data(), std::ssize(own), startsNs[k]);
                    });
            }
            return code;
        });
    });
}

int physvib_live_set_gain(physvib_live live, int channel, double gain) {
    return change(live, RenderControl::Kind::gain, channel, gain);
}

int physvib_live_set_mute(physvib_live live, int channel, int isMuted) {
    return change(live, RenderControl::Kind::mute, channel, isMuted != 0 ? 1.0 : 0.0);
}

int physvib_live_set_layout(physvib_live name, const physvib_renderer_settings* renderer) {
    return in(name, [&](Live& live) {
        RendererSettings wanted;
        if (!takeRenderer(renderer, wanted)) return PHYSVIB_ERROR_ARGUMENT;
        if (wanted.panner.channels() > live.session().channels())
            return nothingThere("layout: expected at most as many enchanters as channels");
        return post(live, {0, RenderControl::Kind::panner, 0, 0.0f, &wanted.panner});
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
    const auto act = [&](Live& live) {
        live.output().setSilent(isSilent != 0);
        return PHYSVIB_OK;
    };
    const int code = in(name, act);
    if (code != PHYSVIB_OK && isSilent != 0) // without its handle, the caller may mean any of them
        for (const std::uintptr_t open : openLives()) in(reinterpret_cast<physvib_live>(open), act);
    return code;
}

int physvib_live_get_status(physvib_live name, physvib_live_status* status) {
    return in(name, [&](Live& live) {
        physvib_live_status told;
        if (!take<physvib_live_status>(status, told, physvib_live_status_init)) return PHYSVIB_ERROR_ARGUMENT;
        const LiveStatus now = live.status();
        told.size = status->size;
        told.is_running = live.output().isPlaying() ? 1 : 0;
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
        told.dropped = static_cast<physvib_int64>(live.session().pulse().dropped());
        for (const SinkState& sink : now.sinks) { // several sinks are reported as one
            if (told.board != PHYSVIB_BOARD_SOUGHT)
                told.board = sink.isReady ? PHYSVIB_BOARD_PLAYS : PHYSVIB_BOARD_SOUGHT;
            told.board_sent += static_cast<physvib_int64>(sink.sent);
            told.board_lost += static_cast<physvib_int64>(sink.lost);
        }
        const std::size_t length = std::min(now.trouble.size(), sizeof told.trouble - 1);
        std::copy_n(now.trouble.data(), length, told.trouble);
        told.trouble[length] = '\0';
        std::memcpy(status, &told, told.size);
        return PHYSVIB_OK;
    });
}

using namespace physvib::api;

int physvib_live_impact(physvib_live live, double x, double y, double strength) {
    return physvib_live_impact_of(live, nullptr, x, y, strength);
}

int physvib_live_impact_of(physvib_live live, const char* material, double x, double y, double strength) {
    return guarded([&] {
        physvib_event event = noEvent();
        if (const int code = physvib_event_of(material, x, y, strength, &event); code != PHYSVIB_OK)
            return fail(code, std::string{physvib_error()}); // the other library's text
        event.time_ns = physvib_live_now_ns(live);
        if (event.time_ns < 0) return static_cast<int>(event.time_ns); // an error
        return physvib_live_strike(live, &event, 1);
    });
}

using namespace physvib;
using namespace physvib::api;

namespace {

template <std::size_t Size>
void copy(std::string_view text, char (&to)[Size]) {
    const std::size_t length = std::min(text.size(), Size - 1);
    std::copy_n(text.data(), length, to);
    to[length] = '\0';
}

physvib_device deviceOf(std::string_view name, std::string_view about, int kind, int channels) {
    auto device = zeroed<physvib_device>();
    copy(name, device.name);
    copy(about, device.about);
    device.kind = kind;
    device.channels = channels;
    return device;
}

std::vector<physvib_device> allDevices() {
    std::vector<physvib_device> all;
    for (const AudioDeviceName& one : listAudioDevices(systemAudioDrivers))
        all.push_back(deviceOf(one.type + ":" + one.name, {}, PHYSVIB_DEVICE_SOUND, one.channels));
    for (const SinkKind& kind : sinkKinds())
        for (const SinkPlace& place : kind.places())
            all.push_back(deviceOf(std::string{kind.name} + ":" + place.where, place.about,
                                   kind.name == "BOARD" ? PHYSVIB_DEVICE_BOARD : PHYSVIB_DEVICE_PAD,
                                   kind.actuators));
    return all;
}

} // namespace

int physvib_live_devices(physvib_device* devices, int capacity, size_t size) {
    return guarded([&] {
        constexpr std::size_t least = offsetof(physvib_device, channels) + sizeof(int), most = 1 << 16;
        if (capacity < 0 || (capacity > 0 && (devices == nullptr || size < least || size > most)))
            return nothingThere("devices: expected a place for them, and the size of one");
        const auto all = allDevices();
        const std::size_t written = std::min(size, sizeof(physvib_device));
        auto* at = reinterpret_cast<std::byte*>(devices); // the caller's structures may be longer
        for (std::size_t i = 0; i < std::min(all.size(), static_cast<std::size_t>(capacity));
             ++i, at += size) {
            std::memcpy(at, &all[i], written);
            std::memcpy(at, &size, sizeof size);
        }
        return static_cast<int>(all.size());
    });
}

using namespace physvib;
using namespace physvib::api;

namespace {

const char* holderOf(const MuteRequests& silence) noexcept {
    if (silence.isHeldBy(MuteRequester::osc)) return "OSC (/physvib/silence)";
    if (silence.isHeldBy(MuteRequester::standardInput)) return "a line of standard input";
    return "physvib_live_silence";
}

physvib_renderer_settings settingsOf(const PhantomPanner& panner) {
    physvib_renderer_settings settings;
    physvib_renderer_settings_init(&settings, sizeof settings);
    settings.law = static_cast<int>(panner.requestedLaw());
    settings.exponent = panner.exponent();
    settings.field_width_m = panner.fieldWidthMetres();
    settings.field_height_m = panner.fieldHeightMetres();
    writeLayout(panner.layout(), settings.layout);
    return settings;
}

} // namespace

int physvib_live_explain(physvib_live name, physvib_world world, char* text, size_t size) {
    return in(name, [&](Live& live) {
        const LiveStatus now = live.status();
        const physvib_renderer_settings settings = settingsOf(live.session().panner());
        physvib_output_facts facts;
        physvib_output_facts_init(&facts, sizeof facts);
        facts.is_missing = live.output().isPlaying() ? 0 : 1;
        facts.is_silent = live.output().isSilent() ? 1 : 0;
        facts.silent_by = holderOf(live.output().silence());
        const std::string dropped = droppedWords(live.session().pulse().dropped());
        facts.trouble = now.trouble.empty() ? dropped.c_str() : now.trouble.c_str();
        facts.level = static_cast<double>(live.output().level());
        facts.muted_channels = static_cast<physvib_int64>(live.session().rendered().mutedChannels());
        facts.late = static_cast<physvib_int64>(now.render.late);
        facts.rejected = static_cast<physvib_int64>(now.render.rejected);
        facts.without_part = static_cast<physvib_int64>(now.render.withoutPart);
        facts.renderer = &settings;
        const int length = physvib_world_explain_output(world, &facts, text, size);
        return length < 0 ? fail(length, physvib_error()) : length;
    });
}
