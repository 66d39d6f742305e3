// SPDX-License-Identifier: MIT
// physvib_live_open and physvib_live_close, the list of outputs in use, and the message thread of LiveRig.
#include "Api/Live/LiveRig.h"
#include "Live/Devices/AudioDevice.h"
#include "Live/Documents/SessionFile.h"
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

/// Held while a device is opened or closed, one at a time. Opening may wait for a driver.
std::mutex& openMutex() {
    static auto* const mutex = new std::mutex; // never destroyed, because the exit handler locks it
    return *mutex;
}

/// Outputs of an open device that are in use: `handle` owns them.
struct OutputRange {
    std::uintptr_t handle;
    std::string device;
    int firstOutput, outputCount;

    bool overlaps(const OutputRange& other) const {
        return device == other.device && firstOutput < other.firstOutput + other.outputCount &&
               other.firstOutput < firstOutput + outputCount;
    }
};
struct OutputRangeList {
    std::mutex mutex; // held briefly: physvib_live_silence() reads the list
    std::vector<OutputRange> ranges;
};
OutputRangeList& openOutputs() {
    static auto* const list = new OutputRangeList; // likewise
    return *list;
}

int closeHandle(std::uintptr_t handle) noexcept {
    return catchExceptions([&] {
        const std::lock_guard lock{openMutex()};
        auto live = liveRigs().extract(handle);
        if (!live) return unknownHandleError();
        {
            const std::lock_guard listed{openOutputs().mutex};
            std::erase_if(openOutputs().ranges,
                          [handle](const OutputRange& range) { return range.handle == handle; });
        }
        if (!live->isOfThisProcess()) return live.release(), PHYSVIB_OK;
        return codeFromError(live->close(), PHYSVIB_ERROR_FILE);
    });
}

// Registered after the static objects of device libraries are created, so it runs before their destruction.
void registerCloseAtExit() {
    static const int registered = std::atexit([] {
        for (const std::uintptr_t handle : openLiveHandles()) closeHandle(handle);
    });
    static_cast<void>(registered);
}

/// Two sessions on one output are refused, because their sum would bypass the limiters.
bool areOutputsInUse(const OutputRange& requested) {
    if (requested.device == std::string(nullDeviceType) + ":" + nullDeviceName) return false;
    const std::lock_guard lock{openOutputs().mutex};
    return std::ranges::any_of(openOutputs().ranges,
                               [&](const OutputRange& other) { return other.overlaps(requested); });
}

std::string_view settingsError(const physvib_live_settings& s) noexcept {
    if (s.rate_hz != 0 && !isSampleRate(s.rate_hz)) return "rate: expected 0, or 5000 to 192000 Hz";
    if (s.block_frames < 0 || s.block_frames > limits::maxBlockFrames)
        return "block: expected 0 to 8192 frames";
    if (s.steps_per_s < 20 || s.steps_per_s > 1000) return "steps: expected 20 to 1000 per second";
    if (!(s.longest_gap_s >= 0.0 && s.longest_gap_s <= 1.0)) return "longest gap: expected 0 to 1 s";
    if (s.first_output < 0 || s.first_output >= 65536) return "first output: expected 0 to 65535";
    if (s.sound_output < -1 || s.sound_output >= 65535) return "sound output: expected -1, or 0 to 65534";
    if (!isValidLevelDb(s.level_db) || !isValidLevelDb(s.sound_db)) return "level: expected -90 to 0 dB";
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
    if (s.sound_output >= 0) setup.contactSound.emplace(), setup.contactChannels = 2;
    return setup;
}

} // namespace

std::vector<std::uintptr_t> api::openLiveHandles() {
    const std::lock_guard lock{openOutputs().mutex};
    std::vector<std::uintptr_t> handles;
    for (const OutputRange& range : openOutputs().ranges) handles.push_back(range.handle);
    return handles;
}

int physvib_live_settings_init(physvib_live_settings* settings, size_t size) {
    auto values = zeroed<physvib_live_settings>();
    values.steps_per_s = 100;
    values.longest_gap_s = driverThreadGapSeconds;
    values.level_db = defaultLevelDb;
    values.sound_output = -1;
    values.sound_db = defaultContactDb;
    return writeStruct(settings, size, values);
}

int physvib_live_open(const char* device, const physvib_renderer_settings* renderer,
                      const physvib_live_settings* settings, physvib_live* handle) {
    return catchExceptions([&] {
        if (handle == nullptr || device == nullptr)
            return argumentError("live: expected a device and a place for it, found NULL");
        physvib_live_settings copy;
        if (settings == nullptr)
            physvib_live_settings_init(&copy, sizeof copy);
        else if (!readStruct(settings, copy, physvib_live_settings_init))
            return PHYSVIB_ERROR_ARGUMENT;
        RendererSettings checked;
        if (const auto error = settingsError(copy); !error.empty()) return argumentError(error);
        if (!readLiveRenderer(renderer, checked)) return PHYSVIB_ERROR_ARGUMENT;
        if (*copy.save != '\0')
            if (const auto error = controlError({0, RenderControl::Kind::panner, 0, 0.0f, &checked.panner},
                                                checked.outputs());
                !error.empty())
                return argumentError(error);
        const OutputNames outputs{device};
        if (const auto error = channelCountError(outputs.sinks, checked.outputs()); !error.empty())
            return argumentError(error);

        const std::lock_guard lock{openMutex()};
        RigSettings rig; // not by designators: gcc 14 warns of the other members
        rig.setup = setupOf(copy, checked);
        rig.sinks = outputs.sinks;
        rig.savePath = copy.save;
        rig.provenance = {PHYSVIB_VERSION, {{"session", rig.savePath}}};
        rig.output.device = outputs.device;
        rig.output.sampleRateHz = copy.rate_hz;
        rig.output.blockFrames = copy.block_frames;
        rig.output.level = gainFromDb(copy.level_db);
        rig.output.actuatorCount = checked.panner.channels();
        rig.output.channelMap.resize(static_cast<std::size_t>(checked.outputs()));
        std::iota(rig.output.channelMap.begin(), rig.output.channelMap.end(), copy.first_output);
        rig.output.listening.contactDb = copy.sound_db;
        if (copy.sound_output >= 0)
            rig.output.listening.contacts = {copy.sound_output, copy.sound_output + 1};
        auto live = std::make_unique<LiveRig>(std::move(rig));
        if (const std::string error = live->open(); !error.empty()) return fail(PHYSVIB_ERROR_DEVICE, error);
        std::vector<OutputRange> ranges{{0, live->status().device, copy.first_output, checked.outputs()}};
        if (copy.sound_output >= 0) ranges.push_back({0, ranges[0].device, copy.sound_output, 2});
        if (std::ranges::any_of(ranges, areOutputsInUse)) {
            live->close();
            return fail(PHYSVIB_ERROR_FULL, ranges[0].device + ": these outputs are open already; expected "
                                                               "others (first_output, sound_output), or that "
                                                               "device to be closed");
        }
        const std::uintptr_t number = liveRigs().add(std::move(live));
        if (number == 0) return fail(PHYSVIB_ERROR_FULL, "live: expected at most 256 open devices");
        {
            const std::lock_guard listed{openOutputs().mutex};
            for (OutputRange& range : ranges) {
                range.handle = number;
                openOutputs().ranges.push_back(range);
            }
        }
        registerCloseAtExit();
        *handle = reinterpret_cast<physvib_live>(number);
        return PHYSVIB_OK;
    });
}

int physvib_live_close(physvib_live live) { return closeHandle(handleNumber(live)); }

namespace physvib::api {
std::string LiveRig::open() {
    std::promise<std::string> opened;
    auto openError = opened.get_future();
    messageThread_ = std::thread{[this, opened = std::move(opened)]() mutable { serve(std::move(opened)); }};
    return openError.get();
}

std::string LiveRig::close() {
    isClosing_ = true;
    if (messageThread_.joinable()) messageThread_.join();
    return saveError_;
}

LiveRigStatus LiveRig::status() const {
    const std::lock_guard lock{statusMutex_};
    return status_;
}

void LiveRig::serve(std::promise<std::string> opened) {
    rig_.emplace(std::move(settings_), withNullDevice(systemAudioDrivers));
    if (std::string error = rig_->open(); error.empty()) {
        rig_->start();
        updateStatus();
        opened.set_value({});
        repeatEvery(std::chrono::milliseconds{1000 / updatesPerSecond}, [this] { return updateStatus(); });
        rig_->stop([](const PlayedEvent&) {});
        saveError_ = rig_->finish(false); // before closing the device, which may hang
    } else {
        opened.set_value(std::move(error));
    }
    rig_.reset(); // on the thread that opened the device
}

bool LiveRig::updateStatus() {
    rig_->drainPlayed([](const PlayedEvent&) {});
    if (updateCount_++ % updatesPerSecond == 0) {
        rig_->maintain();
        problem_ = rig_->errorText();
    }
    LiveRigStatus current{rig_->output().status(),
                          rig_->session().status().render,
                          rig_->output().sampleRateHz(),
                          rig_->output().blockFrames(),
                          rig_->output().device(),
                          rig_->sinkStates(),
                          problem_};
    const std::lock_guard lock{statusMutex_};
    status_ = std::move(current);
    return !isClosing_;
}
} // namespace physvib::api
