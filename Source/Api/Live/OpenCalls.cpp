// SPDX-License-Identifier: GPL-3.0-or-later
// Opens and closes a device and its sinks: physvib_live_open, physvib_live_close.
#include "Api/Live/Lives.h"
#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <physvib/Version.h>

using namespace physvib;
using namespace physvib::api;

namespace {

std::mutex& openMutex() {
    static std::mutex mutex;
    return mutex;
}
std::atomic<std::uintptr_t> openName{0}; // written under openMutex()

int closeNamed(std::uintptr_t name) noexcept {
    return guarded([&] {
        const std::lock_guard lock{openMutex()};
        const auto live = lives().take(name);
        if (!live) return unknownHandle();
        openName = 0;
        return resultOf(live->end(), PHYSVIB_ERROR_FILE);
    });
}

// JUCE has static objects. The exit handler is registered after they are created, so it runs before they are
// destroyed.
void closeAtExit() {
    static const int registered = std::atexit([] {
        if (openName != 0) closeNamed(openName);
    });
    static_cast<void>(registered);
}

std::string_view faultOf(const physvib_live_settings& s) noexcept {
    if (s.rate_hz != 0 && !isSampleRate(s.rate_hz)) return "rate: expected 0, or 5000 to 192000 Hz";
    if (s.block_frames < 0 || s.block_frames > limits::maxBlockFrames)
        return "block: expected 0 to 8192 frames";
    if (s.steps_per_s < 20 || s.steps_per_s > 1000) return "steps: expected 20 to 1000 per second";
    if (!(s.longest_gap_s >= 0.0 && s.longest_gap_s <= 1.0)) return "longest gap: expected 0 to 1 s";
    if (!isLevel(s.level_db)) return "level: expected -90 to 0 dB";
    if (std::memchr(s.save, '\0', sizeof s.save) == nullptr)
        return "save: expected a path of at most 1023 bytes";
    return {};
}

SessionSetup setupOf(const physvib_live_settings& s, const RendererSettings& renderer) {
    SessionSetup setup;
    setup.scene.name = "live"; // empty: the caller simulates the world
    setup.scene.fieldWidthMetres = setup.scene.fieldHeightMetres = 1.0;
    setup.stepsPerSecond = s.steps_per_s;
    setup.longestGapSeconds = s.longest_gap_s;
    setup.channels = renderer.outputs();
    setup.panner = renderer.panner;
    setup.limiterEnabled = renderer.limiterEnabled;
    setup.log = LogUse::none;
    return setup;
}

} // namespace

physvib_live api::openLive() noexcept { return reinterpret_cast<physvib_live>(openName.load()); }

int physvib_live_settings_init(physvib_live_settings* settings, size_t size) {
    auto values = zeroed<physvib_live_settings>();
    values.steps_per_s = 100;
    values.longest_gap_s = messageTimerGapSeconds;
    values.level_db = safeStartDecibels;
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
        if (openName != 0)
            return fail(PHYSVIB_ERROR_FULL, "live: expected the one that is open to be closed before");
        RigSettings all{.setup = setupOf(taken, wanted), .sinks = outputs.sinks, .savePath = taken.save};
        all.provenance = {PHYSVIB_VERSION, {{"session", all.savePath}}};
        all.output.device = outputs.device;
        all.output.sampleRateHz = taken.rate_hz;
        all.output.blockFrames = taken.block_frames;
        all.output.level = gainOf(taken.level_db);
        all.output.enchanters = wanted.panner.channels();
        auto live = std::make_unique<Live>(std::move(all));
        if (const std::string error = live->open(); !error.empty()) return fail(PHYSVIB_ERROR_DEVICE, error);
        openName = lives().add(std::move(live));
        closeAtExit();
        *name = openLive();
        return PHYSVIB_OK;
    });
}

int physvib_live_close(physvib_live live) { return closeNamed(nameOf(live)); }
