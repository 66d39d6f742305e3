// SPDX-License-Identifier: MIT
// Opens and closes a device and its sinks: physvib_live_open, physvib_live_close.
#include "Api/Live/Lives.h"
#include "Live/Devices/AudioDevice.h"
#include "Live/Rig/Rig.h"
#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <numeric>
#include <physvib/Version.h>
#include <utility>

using namespace physvib;
using namespace physvib::api;

namespace {

/// One device is opened or closed at a time. Opening may wait for a driver.
std::mutex& openMutex() {
    static auto* const mutex = new std::mutex; // never destroyed, as the next: they are needed at exit
    return *mutex;
}

/// A device that is open, and which of its outputs are in use.
struct Open {
    physvib_live name;
    std::string device;
    int firstOutput, outputs;

    bool overlaps(const Open& other) const {
        return device == other.device && firstOutput < other.firstOutput + other.outputs &&
               other.firstOutput < firstOutput + outputs;
    }
};
struct Opened {
    std::mutex mutex; // never held for long: silence needs the list at once
    std::vector<Open> all;
};
Opened& opened() {
    static auto* const one = new Opened;
    return *one;
}

// Libraries of devices have static objects. The exit handler is registered after they are created, so it runs
// before they are destroyed.
void closeAtExit() {
    static const int registered = std::atexit([] {
        for (const physvib_live name : openLives()) physvib_live_close(name);
    });
    static_cast<void>(registered);
}

/// Two sessions on one output are refused: they would add up behind their limiters.
bool areOutputsInUse(const Open& wanted) {
    if (wanted.device == std::string(noDeviceType) + ":" + noDeviceName) return false;
    const std::lock_guard lock{opened().mutex};
    return std::ranges::any_of(opened().all, [&](const Open& other) { return other.overlaps(wanted); });
}

std::string_view faultOf(const physvib_live_settings& s) noexcept {
    if (s.rate_hz != 0 && !isSampleRate(s.rate_hz)) return "rate: expected 0, or 5000 to 192000 Hz";
    if (s.block_frames < 0 || s.block_frames > limits::maxBlockFrames)
        return "block: expected 0 to 8192 frames";
    if (s.steps_per_s < 20 || s.steps_per_s > 1000) return "steps: expected 20 to 1000 per second";
    if (!(s.longest_gap_s >= 0.0 && s.longest_gap_s <= 1.0)) return "longest gap: expected 0 to 1 s";
    if (s.first_output < 0 || s.first_output >= 65536) return "first output: expected 0 to 65535";
    if (s.sound_output < -1 || s.sound_output >= 65535) return "sound output: expected -1, or 0 to 65534";
    if (!isLevel(s.level_db) || !isLevel(s.sound_db)) return "level: expected -90 to 0 dB";
    if (std::memchr(s.save, '\0', sizeof s.save) == nullptr)
        return "save: expected a path of at most 1023 bytes";
    return {};
}

SessionSetup setupOf(const physvib_live_settings& s, const RendererSettings& renderer) {
    SessionSetup setup;
    setup.scene.name = "live"; // empty: the caller simulates the world
    setup.scene.fieldWidthMetres = setup.scene.fieldHeightMetres = 1.0;
    setup.stepsPerSecond = s.steps_per_s;
    setup.longestGapSeconds = threadGapSeconds(s.steps_per_s, s.longest_gap_s);
    setup.channels = renderer.outputs();
    setup.panner = renderer.panner;
    setup.limiterEnabled = renderer.limiterEnabled;
    setup.log = LogUse::none;
    if (s.sound_output >= 0) setup.contactSound.emplace(), setup.ears = 2;
    return setup;
}

} // namespace

std::vector<physvib_live> api::openLives() {
    const std::lock_guard lock{opened().mutex};
    std::vector<physvib_live> names;
    for (const Open& open : opened().all) names.push_back(open.name);
    return names;
}

int physvib_live_settings_init(physvib_live_settings* settings, size_t size) {
    auto values = zeroed<physvib_live_settings>();
    values.steps_per_s = 100;
    values.longest_gap_s = driverThreadGapSeconds;
    values.level_db = safeStartDecibels;
    values.sound_output = -1;
    values.sound_db = safeContactDb;
    return begin(settings, size, values);
}

int physvib_live_open(const char* device, const physvib_renderer_settings* renderer,
                      const physvib_live_settings* settings, physvib_live* name) {
    return guarded([&] {
        if (name == nullptr || device == nullptr)
            return nothingThere("live: expected a device and a place for it, found NULL");
        physvib_live_settings taken;
        if (!takeOrBegin(settings, taken, physvib_live_settings_init)) return PHYSVIB_ERROR_ARGUMENT;
        RendererSettings wanted;
        if (const auto fault = faultOf(taken); !fault.empty()) return nothingThere(fault);
        if (!takeRendererOrUsual(renderer, wanted)) return PHYSVIB_ERROR_ARGUMENT;
        const OutputNames outputs{device};
        if (const auto fault = channelFault(outputs.sinks, wanted.outputs()); !fault.empty())
            return nothingThere(fault);

        const std::lock_guard lock{openMutex()};
        RigSettings all; // gcc 14 takes one of which only some members are named for uninitialised
        all.setup = setupOf(taken, wanted);
        all.sinks = outputs.sinks;
        all.savePath = taken.save;
        all.provenance = {PHYSVIB_VERSION, {{"session", all.savePath}}};
        all.output.device = outputs.device;
        all.output.sampleRateHz = taken.rate_hz;
        all.output.blockFrames = taken.block_frames;
        all.output.level = gainOf(taken.level_db);
        all.output.enchanters = wanted.panner.channels();
        all.output.channelMap.resize(static_cast<std::size_t>(wanted.outputs()));
        std::iota(all.output.channelMap.begin(), all.output.channelMap.end(), taken.first_output);
        all.output.listening.contactDb = taken.sound_db;
        if (taken.sound_output >= 0)
            all.output.listening.contacts = {taken.sound_output, taken.sound_output + 1};
        auto live = std::make_unique<Live>(std::move(all));
        if (const std::string error = live->open(); !error.empty()) return fail(PHYSVIB_ERROR_DEVICE, error);
        std::vector<Open> open{{nullptr, live->status().device, taken.first_output, wanted.outputs()}};
        if (taken.sound_output >= 0) open.push_back({nullptr, open[0].device, taken.sound_output, 2});
        if (std::ranges::any_of(open, areOutputsInUse)) {
            live->end();
            return fail(PHYSVIB_ERROR_FULL, open[0].device + ": these outputs are open already; expected "
                                                             "others (first_output, sound_output), or that "
                                                             "device to be closed");
        }
        const int code = Lives::all().add(std::move(live), name, "live: expected at most 256 open devices");
        if (code != PHYSVIB_OK) return code;
        {
            const std::lock_guard listed{opened().mutex};
            for (Open& one : open) opened().all.push_back((one.name = *name, one));
        }
        closeAtExit();
        return PHYSVIB_OK;
    });
}

int physvib_live_close(physvib_live name) {
    return guarded([&] {
        const std::lock_guard lock{openMutex()};
        auto live = Lives::all().take(name);
        if (!live) return unknownHandle();
        {
            const std::lock_guard listed{opened().mutex};
            std::erase_if(opened().all, [name](const Open& open) { return open.name == name; });
        }
        if (!live->isOfThisProcess()) return live.release(), PHYSVIB_OK;
        return resultOf(live->end(), PHYSVIB_ERROR_FILE);
    });
}
