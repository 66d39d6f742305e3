// SPDX-License-Identifier: MIT
#include "Api/Godot/Live.h"

#include <algorithm>
#include <dlfcn.h>

namespace physvib::godot {

namespace {
struct Library {
    decltype(&physvib_live_open) open = nullptr;
    decltype(&physvib_live_close) close = nullptr;
    decltype(&physvib_live_align) align = nullptr;
    decltype(&physvib_live_strike) strike = nullptr;
    decltype(&physvib_live_set_level) setLevel = nullptr;
    decltype(&physvib_live_now_ns) now = nullptr;
    decltype(&physvib_live_latency_ns) latency = nullptr;
    decltype(&physvib_live_receipt_init) beginReceipt = nullptr;
    decltype(&physvib_live_left) left = nullptr;
    decltype(&physvib_live_settings_init) initialise = nullptr;
    decltype(&physvib_live_error) error = nullptr;
    std::string missing; ///< why it could not be loaded

    Library() {
        void* handle = dlopen("libphysvib-live.so.1", RTLD_NOW | RTLD_LOCAL);
        if (handle == nullptr) {
            const char* reason = dlerror();
            missing = reason != nullptr ? reason : "libphysvib-live.so.1: expected beside the addon";
            return;
        }
        find(handle, "physvib_live_open", open), find(handle, "physvib_live_close", close);
        find(handle, "physvib_live_align", align), find(handle, "physvib_live_strike", strike);
        find(handle, "physvib_live_set_level", setLevel);
        find(handle, "physvib_live_now_ns", now), find(handle, "physvib_live_latency_ns", latency);
        find(handle, "physvib_live_receipt_init", beginReceipt), find(handle, "physvib_live_left", left);
        find(handle, "physvib_live_settings_init", initialise), find(handle, "physvib_live_error", error);
    }
    template <class Function>
    void find(void* handle, const char* name, Function& function) {
        function = reinterpret_cast<Function>(dlsym(handle, name));
        if (function == nullptr) missing = std::string("libphysvib-live.so.1 lacks ") + name;
    }
};
const Library& library() {
    static const Library loaded;
    return loaded;
}
} // namespace

Live::~Live() {
    if (live != nullptr) library().close(live);
}

std::string Live::open(const std::string& device, const physvib_layout& layout, double levelDb,
                       double fieldWidthMetres, double fieldHeightMetres, const std::string& sessionFile) {
    if (!library().missing.empty()) return library().missing;
    physvib_renderer_settings renderer;
    physvib_renderer_settings_init(&renderer, sizeof renderer);
    renderer.field_width_m = fieldWidthMetres, renderer.field_height_m = fieldHeightMetres;
    renderer.layout = layout;
    physvib_live_settings settings;
    library().initialise(&settings, sizeof settings);
    settings.level_db = levelDb;
    if (sessionFile.size() >= sizeof settings.save) return "session_file: its name is too long";
    std::copy(sessionFile.begin(), sessionFile.end(), settings.save);
    return library().open(device.c_str(), &renderer, &settings, &live) == PHYSVIB_OK ? "" : library().error();
}

void Live::setLevel(double levelDb) {
    if (live != nullptr) library().setLevel(live, levelDb);
}

void Live::play(physvib_world world, const physvib_event& event) {
    if (live == nullptr || library().align(live, world, &startNs) != PHYSVIB_OK) return;
    physvib_event later = event;
    later.time_ns += startNs;
    library().strike(live, &later, 1);
}

std::vector<double> Live::left(int actuators) const {
    if (live == nullptr) return {};
    constexpr physvib_int64 second = 1'000'000'000, unknown = 10'000'000; // the newest bins are not complete
    const physvib_int64 until = library().now(live) - library().latency(live) - unknown;
    std::vector<double> peaks;
    physvib_live_receipt receipt;
    library().beginReceipt(&receipt, sizeof receipt);
    for (int j = 0; j < actuators; ++j) {
        if (library().left(live, until - second, until, j, &receipt) != PHYSVIB_OK || receipt.running == 0)
            return {};
        peaks.push_back(receipt.peak);
    }
    return peaks;
}

} // namespace physvib::godot
