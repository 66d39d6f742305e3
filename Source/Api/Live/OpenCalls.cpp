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
    std::uintptr_t name;
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

int closeNamed(std::uintptr_t name) noexcept {
    return guarded([&] {
        const std::lock_guard lock{openMutex()};
        auto live = lives().take(name);
        if (!live) return unknownHandle();
        {
            const std::lock_guard listed{opened().mutex};
            std::erase_if(opened().all, [name](const Open& open) { return open.name == name; });
        }
        if (!live->isOfThisProcess()) return live.release(), PHYSVIB_OK;
        return resultOf(live->end(), PHYSVIB_ERROR_FILE);
    });
}

// Libraries of devices have static objects. The exit handler is registered after they are created, so it runs
// before they are destroyed.
void closeAtExit() {
    static const int registered = std::atexit([] {
        for (const std::uintptr_t name : openLives()) closeNamed(name);
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

std::vector<std::uintptr_t> api::openLives() {
    const std::lock_guard lock{opened().mutex};
    std::vector<std::uintptr_t> names;
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
        if (settings == nullptr)
            physvib_live_settings_init(&taken, sizeof taken);
        else if (!take(settings, taken, physvib_live_settings_init))
            return PHYSVIB_ERROR_ARGUMENT;
        RendererSettings wanted;
        if (const auto fault = faultOf(taken); !fault.empty()) return nothingThere(fault);
        if (!takeRenderer(renderer, wanted)) return PHYSVIB_ERROR_ARGUMENT;
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
        std::vector<Open> open{{0, live->status().device, taken.first_output, wanted.outputs()}};
        if (taken.sound_output >= 0) open.push_back({0, open[0].device, taken.sound_output, 2});
        if (std::ranges::any_of(open, areOutputsInUse)) {
            live->end();
            return fail(PHYSVIB_ERROR_FULL, open[0].device + ": these outputs are open already; expected "
                                                             "others (first_output, sound_output), or that "
                                                             "device to be closed");
        }
        const std::uintptr_t made = lives().add(std::move(live));
        if (made == 0) return fail(PHYSVIB_ERROR_FULL, "live: expected at most 256 open devices");
        {
            const std::lock_guard listed{opened().mutex};
            for (Open& one : open) opened().all.push_back((one.name = made, one));
        }
        closeAtExit();
        *name = reinterpret_cast<physvib_live>(made);
        return PHYSVIB_OK;
    });
}

int physvib_live_close(physvib_live live) { return closeNamed(nameOf(live)); }

// The message thread of the live library, which owns the device.

namespace physvib::api {
std::string Live::open() {
    std::promise<std::string> opened;
    auto told = opened.get_future();
    messages_ = std::thread{[this, opened = std::move(opened)]() mutable { run(std::move(opened)); }};
    return told.get();
}

std::string Live::end() {
    isEnding_ = true;
    if (messages_.joinable()) messages_.join();
    return unsaved_;
}

LiveStatus Live::status() const {
    const std::lock_guard lock{statusMutex_};
    return status_;
}

void Live::run(std::promise<std::string> opened) {
    rig_.emplace(std::move(settings_), withNoDevice(systemAudioDrivers));
    if (std::string error = rig_->open(); error.empty()) {
        rig_->start();
        watch();
        opened.set_value({});
        repeatEvery(std::chrono::milliseconds{1000 / watchesPerSecond}, [this] { return watch(); });
        rig_->stop([](const PlayedEvent&) {});
        unsaved_ = rig_->finish(false); // before closing the device, which may hang
    } else {
        opened.set_value(std::move(error));
    }
    rig_.reset(); // on the thread that opened the device
}

bool Live::watch() {
    rig_->takePlayed([](const PlayedEvent&) {});
    if (ticks_++ % watchesPerSecond == 0) {
        rig_->maintain();
        trouble_ = rig_->trouble();
    }
    LiveStatus now{rig_->output().status(),
                   rig_->session().status().render,
                   rig_->output().sampleRateHz(),
                   rig_->output().blockFrames(),
                   rig_->output().device(),
                   rig_->sinkStates(),
                   trouble_};
    const std::lock_guard lock{statusMutex_};
    status_ = std::move(now);
    return !isEnding_;
}
} // namespace physvib::api
