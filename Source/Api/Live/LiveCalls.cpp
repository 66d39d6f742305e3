// SPDX-License-Identifier: MIT
// Functions of physvib-live.h that list devices, and send events, levels, silence and queries to an open one.
#include "Api/C/Calls.h"
#include "Api/Live/LiveRig.h"
#include "Api/Live/physvib-live.h"
#include "Live/Devices/AudioDevice.h"
#include "Live/Devices/SinkTable.h"
#include "Live/Documents/SessionFile.h"
#include <algorithm>
#include <array>
#include <cstring>
#include <iterator>
#include <span>
#include <string>

using namespace physvib;
using namespace physvib::api;

namespace {

template <std::size_t Size>
void copyText(std::string_view text, char (&to)[Size]) {
    const std::size_t length = std::min(text.size(), Size - 1);
    std::copy_n(text.data(), length, to);
    to[length] = '\0';
}

int submitControl(LiveRig& live, RenderControl control) {
    if (live.isSaved())
        if (const auto error = controlError(control, live.session().channels()); !error.empty())
            return argumentError(error);
    return live.session().submit({control})
               ? PHYSVIB_OK
               : fail(PHYSVIB_ERROR_FULL, "changes: expected at most 256 that wait");
}

int queueControl(physvib_live handle, RenderControl::Kind kind, int channel, double value) noexcept {
    return withObject(handle, [&](LiveRig& live) {
        if (channel < 0 || channel >= live.session().channels())
            return argumentError("channel: expected one of the device's enchanters");
        if (!(value >= 0.0 && value <= 10000.0)) return argumentError("gain: expected 0 to 10000");
        return submitControl(live, {0, kind, channel, static_cast<float>(value), {}});
    });
}

int submitEvents(LiveRig& live, const physvib_event* from, std::int64_t count, std::int64_t startNs) {
    std::vector<CollisionEvent> events;
    if (const auto error = readEvents(from, count, events); !error.empty()) return argumentError(error);
    for (CollisionEvent& event : events) // events before the session's start play at once
        event.timeNs = std::clamp<std::int64_t>(event.timeNs + startNs, 0, limits::maxTimeNs);
    if (live.session().pulse().dropIfPaused(events.size())) return PHYSVIB_OK; // the status reports them
    return live.session().submit({Strikes{events, true}, 0})
               ? PHYSVIB_OK
               : fail(PHYSVIB_ERROR_FULL, "events: expected fewer that wait for their time");
}

/// Passes all events of a world to `submit`, up to 128 at once, final or not: a device sorts them by time.
/// Returns their number, or the first error.
template <class Submit>
physvib_int64 forEachBatch(physvib_world world, Submit submit) {
    std::array<physvib_event, 128> batch{};
    batch.front().size = sizeof batch.front(); // the other library may know longer events
    for (physvib_int64 sent = 0;;) {
        const physvib_int64 count = physvib_world_take(world, batch.data(), batch.size(), 1);
        if (count < 0) return fail(static_cast<int>(count), physvib_error());
        if (const int code = submit(std::span{batch}.first(static_cast<std::size_t>(count)));
            code != PHYSVIB_OK)
            return code;
        sent += count;
        if (count < static_cast<physvib_int64>(batch.size())) return sent;
    }
}

} // namespace

const char* physvib_live_error() { return errorBuffer().data(); }

int physvib_live_status_init(physvib_live_status* status, size_t size) {
    return writeStruct(status, size, zeroed<physvib_live_status>());
}

int physvib_live_receipt_init(physvib_live_receipt* receipt, size_t size) {
    return writeStruct(receipt, size, zeroed<physvib_live_receipt>());
}

int physvib_live_left(physvib_live handle, physvib_int64 fromNs, physvib_int64 toNs, int actuator,
                      physvib_live_receipt* receipt) {
    return withObject(handle, [&](LiveRig& live) {
        physvib_live_receipt result;
        if (!readStruct<physvib_live_receipt>(receipt, result, physvib_live_receipt_init))
            return PHYSVIB_ERROR_ARGUMENT;
        if (actuator < 0 || actuator >= live.session().channels())
            return argumentError("actuator: expected one of the device's, from 0");
        const Receipt measured = live.output().receiptFor(fromNs, toNs, actuator);
        result.size = receipt->size;
        result.frames = measured.frames;
        result.peak = measured.peak;
        result.mean_square = measured.meanSquare;
        result.running = measured.isRunning ? 1 : 0;
        result.opening = static_cast<int>(measured.opening);
        result.over = measured.hasEnded ? 1 : 0;
        result.kept = measured.isInMemory ? 1 : 0;
        std::memcpy(receipt, &result, result.size);
        return PHYSVIB_OK;
    });
}

physvib_int64 physvib_live_now_ns(physvib_live handle) {
    return withObject(handle,
                      [](LiveRig& live) -> physvib_int64 { return live.session().timeline().presentNs(); });
}

physvib_int64 physvib_live_latency_ns(physvib_live handle) {
    return withObject(handle, [](LiveRig& live) -> physvib_int64 {
        return live.session().timeline().outputLatencyFrames() * 1'000'000'000 /
               std::max(1, live.status().rateHz);
    });
}

int physvib_live_strike(physvib_live handle, const physvib_event* events, physvib_int64 count) {
    return withObject(handle, [&](LiveRig& live) {
        if (count < 0 || (events == nullptr && count > 0))
            return argumentError("events: expected some, found NULL");
        return submitEvents(live, events, count, 0);
    });
}

int physvib_live_align(physvib_live handle, physvib_world world, physvib_int64* startNs) {
    return withObject(handle, [&](LiveRig& live) {
        if (startNs == nullptr) return argumentError("start: expected a place for it, found NULL");
        const physvib_int64 timeNs = physvib_world_time_ns(world);
        if (timeNs < 0) return fail(static_cast<int>(timeNs), physvib_error());
        // The last step of the world begins now. A call may be late by the output latency. A world that runs
        // ahead, as after an xrun, plays later by as much, so it may be ahead by a step less than that.
        const Timeline& session = live.session().timeline();
        const physvib_int64 stepNs = 1'000'000'000 / live.stepsPerSecond(),
                            expectedNs = session.presentNs() + stepNs - timeNs;
        const auto latencyNs = static_cast<physvib_int64>(session.outputLatencySeconds() * 1.0e9);
        if (*startNs < expectedNs - latencyNs || *startNs > expectedNs + latencyNs - stepNs)
            *startNs = expectedNs;
        return PHYSVIB_OK;
    });
}

physvib_int64 physvib_live_send(physvib_live handle, physvib_world world, physvib_int64 startNs, int) {
    return withObject(handle, [&](LiveRig& live) -> physvib_int64 {
        if (startNs < -limits::maxTimeNs / 4 || startNs > limits::maxTimeNs / 4)
            return argumentError("start: expected at most 2.5 * 10^16 ns from 0");
        return forEachBatch(world, [&](std::span<const physvib_event> batch) {
            return submitEvents(live, batch.data(), std::ssize(batch), startNs);
        });
    });
}

physvib_int64 physvib_live_send_each(const physvib_live* lives, int count, physvib_world world,
                                     physvib_int64* startsNs) {
    return catchExceptions([&]() -> physvib_int64 {
        if (lives == nullptr || startsNs == nullptr || count < 1)
            return argumentError("devices: expected one or more, found none");
        for (int k = 0; k < count; ++k)
            if (const int code = physvib_live_align(lives[k], world, startsNs + k); code != PHYSVIB_OK)
                return code;
        std::vector<physvib_event> deviceEvents;
        return forEachBatch(world, [&](std::span<const physvib_event> batch) {
            int code = PHYSVIB_OK;
            for (int k = 0; k < count && code == PHYSVIB_OK; ++k) {
                deviceEvents.clear();
                std::ranges::copy_if(batch, std::back_inserter(deviceEvents),
                                     [&](const physvib_event& event) {
                                         const int device = physvib_world_device(world, event.fixture);
                                         return (device < count ? device : 0) == k;
                                     });
                if (!deviceEvents.empty())
                    code = withObject(lives[k], [&](LiveRig& live) {
                        return submitEvents(live, deviceEvents.data(), std::ssize(deviceEvents), startsNs[k]);
                    });
            }
            return code;
        });
    });
}

int physvib_live_set_gain(physvib_live live, int channel, double gain) {
    return queueControl(live, RenderControl::Kind::gain, channel, gain);
}

int physvib_live_set_mute(physvib_live live, int channel, int isMuted) {
    return queueControl(live, RenderControl::Kind::mute, channel, isMuted != 0 ? 1.0 : 0.0);
}

int physvib_live_set_layout(physvib_live handle, const physvib_renderer_settings* renderer) {
    return withObject(handle, [&](LiveRig& live) {
        RendererSettings checked;
        if (!readLiveRenderer(renderer, checked)) return PHYSVIB_ERROR_ARGUMENT;
        if (checked.panner.channels() > live.session().channels())
            return argumentError("layout: expected at most as many enchanters as channels");
        return submitControl(live, {0, RenderControl::Kind::panner, 0, 0.0f, &checked.panner});
    });
}

int physvib_live_set_level(physvib_live handle, double levelDb) {
    return withObject(handle, [&](LiveRig& live) {
        if (!isValidLevelDb(levelDb)) return argumentError("level: expected -90 to 0 dB");
        live.output().setLevel(gainFromDb(levelDb));
        return PHYSVIB_OK;
    });
}

int physvib_live_silence(physvib_live handle, int isSilent) {
    const auto setSilent = [&](LiveRig& live) {
        live.output().setSilent(isSilent != 0);
        return PHYSVIB_OK;
    };
    const int code = withObject(handle, setSilent);
    if (code != PHYSVIB_OK && isSilent != 0) // without its handle, the caller may mean any of them
        for (const std::uintptr_t open : openLiveHandles())
            withObject(reinterpret_cast<physvib_live>(open), setSilent);
    return code;
}

int physvib_live_get_status(physvib_live handle, physvib_live_status* status) {
    return withObject(handle, [&](LiveRig& live) {
        physvib_live_status result;
        if (!readStruct<physvib_live_status>(status, result, physvib_live_status_init))
            return PHYSVIB_ERROR_ARGUMENT;
        const LiveRigStatus current = live.status();
        result.size = status->size;
        result.is_running = live.output().isPlaying() ? 1 : 0;
        result.is_silent = live.output().isSilent() ? 1 : 0;
        result.rate_hz = current.rateHz;
        result.block_frames = current.blockFrames;
        result.live_modes = current.render.liveModes;
        result.losses = current.output.losses;
        result.xruns = current.output.deviceXruns;
        result.load = static_cast<double>(current.output.load);
        result.worst_load = static_cast<double>(current.output.worstLoad);
        result.played = toInt64(current.render.played);
        result.late = toInt64(current.render.late);
        result.rejected = toInt64(current.render.rejected);
        result.dropped = toInt64(live.session().pulse().dropped());
        for (const SinkState& sink : current.sinks) { // several sinks are reported as one
            if (result.board != PHYSVIB_BOARD_SOUGHT)
                result.board = sink.isReady ? PHYSVIB_BOARD_PLAYS : PHYSVIB_BOARD_SOUGHT;
            result.board_sent += toInt64(sink.sent);
            result.board_lost += toInt64(sink.lost);
        }
        copyText(current.problem, result.trouble);
        std::memcpy(status, &result, result.size);
        return PHYSVIB_OK;
    });
}

int physvib_live_impact(physvib_live live, double x, double y, double strength) {
    return physvib_live_impact_of(live, nullptr, x, y, strength);
}

int physvib_live_impact_of(physvib_live live, const char* material, double x, double y, double strength) {
    return catchExceptions([&] {
        physvib_event event = defaultEvent();
        if (const int code = physvib_event_of(material, x, y, strength, &event); code != PHYSVIB_OK)
            return fail(code, std::string{physvib_error()}); // the other library's text
        event.time_ns = physvib_live_now_ns(live);
        if (event.time_ns < 0) return static_cast<int>(event.time_ns); // an error
        return physvib_live_strike(live, &event, 1);
    });
}

namespace {

physvib_device makeDevice(std::string_view name, std::string_view about, int kind, int channels) {
    auto device = zeroed<physvib_device>();
    copyText(name, device.name);
    copyText(about, device.about);
    device.kind = kind;
    device.channels = channels;
    return device;
}

std::vector<physvib_device> allDevices() {
    std::vector<physvib_device> all;
    for (const AudioDeviceName& device : listAudioDevices(systemAudioDrivers))
        all.push_back(makeDevice(device.type + ":" + device.name, {}, PHYSVIB_DEVICE_SOUND, device.channels));
    for (const SinkKind& kind : sinkKinds())
        for (const SinkUnit& place : kind.listUnits())
            all.push_back(makeDevice(std::string{kind.name} + ":" + place.address, place.label,
                                     kind.name == "BOARD" ? PHYSVIB_DEVICE_BOARD : PHYSVIB_DEVICE_PAD,
                                     kind.actuators));
    return all;
}

} // namespace

int physvib_live_devices(physvib_device* devices, int capacity, size_t size) {
    return catchExceptions([&] {
        constexpr std::size_t minSize = offsetof(physvib_device, channels) + sizeof(int), maxSize = 1 << 16;
        if (capacity < 0 || (capacity > 0 && (devices == nullptr || size < minSize || size > maxSize)))
            return argumentError("devices: expected a place for them, and the size of one");
        const auto found = allDevices();
        const std::size_t writtenBytes = std::min(size, sizeof(physvib_device));
        auto* raw = reinterpret_cast<std::byte*>(devices); // the caller's structures may be longer
        for (std::size_t i = 0; i < std::min(found.size(), static_cast<std::size_t>(capacity));
             ++i, raw += size) {
            std::memcpy(raw, &found[i], writtenBytes);
            std::memcpy(raw, &size, sizeof size);
        }
        return static_cast<int>(found.size());
    });
}

namespace {

const char* muteHolderName(const MuteRequests& requests) noexcept {
    if (requests.isRequestedBy(MuteRequester::osc)) return "OSC (/physvib/silence)";
    if (requests.isRequestedBy(MuteRequester::standardInput)) return "a line of standard input";
    return "physvib_live_silence";
}

} // namespace

int physvib_live_explain(physvib_live handle, physvib_world world, char* text, size_t size) {
    return withObject(handle, [&](LiveRig& live) {
        const LiveRigStatus current = live.status();
        physvib_renderer_settings settings;
        physvib_renderer_settings_init(&settings, sizeof settings);
        writePanner(live.session().panner(), settings);
        physvib_output_facts facts;
        physvib_output_facts_init(&facts, sizeof facts);
        facts.is_missing = live.output().isPlaying() ? 0 : 1;
        facts.is_silent = live.output().isSilent() ? 1 : 0;
        facts.silent_by = muteHolderName(live.output().silence());
        const std::string dropped = droppedEventsText(live.session().pulse().dropped());
        facts.trouble = current.problem.empty() ? dropped.c_str() : current.problem.c_str();
        facts.level = static_cast<double>(live.output().level());
        facts.muted_channels = toInt64(live.session().rendered().mutedChannels());
        facts.late = toInt64(current.render.late);
        facts.rejected = toInt64(current.render.rejected);
        facts.without_part = toInt64(current.render.withoutPart);
        facts.renderer = &settings;
        const int length = physvib_world_explain_output(world, &facts, text, size);
        return length < 0 ? fail(length, physvib_error()) : length;
    });
}
