// SPDX-License-Identifier: MIT
#include "Api/Godot/Outputs.h"

#include <algorithm>
#include <dlfcn.h>

namespace physvib::godot {
namespace {
struct Library {
    std::string missing; ///< why it could not be loaded
    void* handle = load();
    decltype(&physvib_live_open) open = find("physvib_live_open");
    decltype(&physvib_live_close) close = find("physvib_live_close");
    decltype(&physvib_live_align) align = find("physvib_live_align");
    decltype(&physvib_live_strike) strike = find("physvib_live_strike");
    decltype(&physvib_live_set_level) setLevel = find("physvib_live_set_level");
    decltype(&physvib_live_now_ns) now = find("physvib_live_now_ns");
    decltype(&physvib_live_latency_ns) latency = find("physvib_live_latency_ns");
    decltype(&physvib_live_receipt_init) beginReceipt = find("physvib_live_receipt_init");
    decltype(&physvib_live_left) left = find("physvib_live_left");
    decltype(&physvib_live_settings_init) initialise = find("physvib_live_settings_init");
    decltype(&physvib_live_error) error = find("physvib_live_error");

    void* load() {
        void* found = dlopen("libphysvib-live.so.1", RTLD_NOW | RTLD_LOCAL);
        const char* reason = found == nullptr ? dlerror() : "";
        missing = reason != nullptr ? reason : "libphysvib-live.so.1: expected beside the addon";
        return found;
    }
    Symbol find(const char* name) {
        const Symbol found{handle == nullptr ? nullptr : dlsym(handle, name)};
        if (handle != nullptr && found.address == nullptr)
            missing = std::string("libphysvib-live.so.1 lacks ") + name;
        return found;
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
    settings.longest_gap_s = 0.026; // a frame makes no tick, one or two of them
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
    constexpr physvib_int64 second = 1'000'000'000, unknown = 10'000'000; // newest bins
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
