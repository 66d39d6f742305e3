// SPDX-License-Identifier: MIT
// LiveDevice where libphysvib-live exists: loads the library at run time and calls it.
#include "Api/Godot/Outputs.h"

#include <algorithm>
#include <dlfcn.h>

namespace physvib::godot {
namespace {
struct Library {
    std::string loadError; ///< why it could not be loaded
    void* handle = load();
    decltype(&physvib_live_open) open = find("physvib_live_open");
    decltype(&physvib_live_close) close = find("physvib_live_close");
    decltype(&physvib_live_align) align = find("physvib_live_align");
    decltype(&physvib_live_strike) strike = find("physvib_live_strike");
    decltype(&physvib_live_set_level) setLevel = find("physvib_live_set_level");
    decltype(&physvib_live_now_ns) nowNs = find("physvib_live_now_ns");
    decltype(&physvib_live_latency_ns) latencyNs = find("physvib_live_latency_ns");
    decltype(&physvib_live_receipt_init) initReceipt = find("physvib_live_receipt_init");
    decltype(&physvib_live_left) query = find("physvib_live_left");
    decltype(&physvib_live_settings_init) initSettings = find("physvib_live_settings_init");
    decltype(&physvib_live_error) error = find("physvib_live_error");

    void* load() {
        void* opened = dlopen("libphysvib-live.so.1", RTLD_NOW | RTLD_LOCAL);
        const char* reason = opened == nullptr ? dlerror() : "";
        loadError = reason != nullptr ? reason : "libphysvib-live.so.1: expected beside the addon";
        return opened;
    }
    AnyFunction find(const char* name) {
        const AnyFunction found{handle == nullptr ? nullptr : dlsym(handle, name)};
        if (handle != nullptr && found.address == nullptr)
            loadError = std::string("libphysvib-live.so.1 lacks ") + name;
        return found;
    }
};
const Library& library() {
    static const Library loaded;
    return loaded;
}
} // namespace

LiveDevice::~LiveDevice() {
    if (live != nullptr) library().close(live);
}

std::string LiveDevice::open(const std::string& device, const physvib_layout& layout, double levelDb,
                             double fieldWidthMetres, double fieldHeightMetres,
                             const std::string& sessionFile) {
    if (!library().loadError.empty()) return library().loadError;
    physvib_renderer_settings renderer;
    physvib_renderer_settings_init(&renderer, sizeof renderer);
    renderer.field_width_m = fieldWidthMetres, renderer.field_height_m = fieldHeightMetres;
    renderer.layout = layout;
    physvib_live_settings settings;
    library().initSettings(&settings, sizeof settings);
    settings.level_db = levelDb;
    settings.longest_gap_s = 0.026; // a frame has up to two physics ticks
    if (sessionFile.size() >= sizeof settings.save) return "session_file: its name is too long";
    std::copy(sessionFile.begin(), sessionFile.end(), settings.save);
    return library().open(device.c_str(), &renderer, &settings, &live) == PHYSVIB_OK ? "" : library().error();
}

void LiveDevice::setLevel(double levelDb) {
    if (live != nullptr) library().setLevel(live, levelDb);
}

void LiveDevice::play(physvib_world world, const physvib_event& event) {
    if (live == nullptr || library().align(live, world, &startNs) != PHYSVIB_OK) return;
    physvib_event aligned = event;
    aligned.time_ns += startNs;
    library().strike(live, &aligned, 1);
}

std::vector<double> LiveDevice::recentPeaks(int actuators) const {
    if (live == nullptr) return {};
    constexpr physvib_int64 secondNs = 1'000'000'000, unmeasuredNs = 10'000'000; // of the newest bin
    const physvib_int64 endNs = library().nowNs(live) - library().latencyNs(live) - unmeasuredNs;
    std::vector<double> peaks;
    physvib_live_receipt receipt;
    library().initReceipt(&receipt, sizeof receipt);
    for (int j = 0; j < actuators; ++j) {
        if (library().query(live, endNs - secondNs, endNs, j, &receipt) != PHYSVIB_OK || receipt.running == 0)
            return {};
        peaks.push_back(receipt.peak);
    }
    return peaks;
}

} // namespace physvib::godot
