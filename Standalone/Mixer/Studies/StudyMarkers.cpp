// SPDX-License-Identifier: GPL-3.0-or-later
// Loads liblsl at run time: the six functions of its C interface (1.14 and newer) that markers need.
#include "Mixer/Studies/StudyMarkers.h"
#include "Io/Text/CleanText.h"
#include <cstdint>

namespace physvib {
namespace {

constexpr std::int32_t textFormat = 3; // cft_string
constexpr double noRate = 0.0;         // LSL_IRREGULAR_RATE
constexpr std::int32_t keptSeconds = 360;

/// Usual library names per system; PHYSVIB_LSL names another.
juce::StringArray libraryNames() {
    if (const auto own = juce::SystemStats::getEnvironmentVariable("PHYSVIB_LSL", {}); own.isNotEmpty())
        return {own};
    return {"liblsl.so.2", "liblsl.so", "liblsl.2.dylib", "liblsl.dylib", "lsl.dll"};
}

} // namespace

struct StudyMarkers::Outlet {
    juce::DynamicLibrary library;
    void* (*createInfo)(const char* name, const char* type, std::int32_t channels, double rateHz,
                        std::int32_t format, const char* source) = nullptr;
    void* (*createOutlet)(void* info, std::int32_t chunk, std::int32_t mostSeconds) = nullptr;
    std::int32_t (*pushText)(void* outlet, const char** text, double timestamp) = nullptr;
    double (*clock)() = nullptr;
    void (*destroyOutlet)(void* outlet) = nullptr;
    void (*destroyInfo)(void* info) = nullptr;
    void* info = nullptr;
    void* outlet = nullptr;

    template <class Function>
    bool find(Function& function, const char* name) {
        function = reinterpret_cast<Function>(library.getFunction(name));
        return function != nullptr;
    }
    bool load() {
        for (const auto& name : libraryNames())
            if (library.open(name)) break;
        return find(createInfo, "lsl_create_streaminfo") && find(createOutlet, "lsl_create_outlet") &&
               find(pushText, "lsl_push_sample_strt") && find(clock, "lsl_local_clock") &&
               find(destroyOutlet, "lsl_destroy_outlet") && find(destroyInfo, "lsl_destroy_streaminfo");
    }
    ~Outlet() {
        if (outlet != nullptr) destroyOutlet(outlet);
        if (info != nullptr) destroyInfo(info);
    }
};

StudyMarkers::StudyMarkers(const std::string& protocol) {
    auto outlet = std::make_unique<Outlet>();
    if (!outlet->load()) return;
    const std::string name = "physvib-" + protocol;
    outlet->info = outlet->createInfo(name.c_str(), "Markers", 1, noRate, textFormat, name.c_str());
    if (outlet->info != nullptr) outlet->outlet = outlet->createOutlet(outlet->info, 0, keptSeconds);
    if (outlet->outlet != nullptr) outlet_ = std::move(outlet);
}

StudyMarkers::~StudyMarkers() = default;

bool StudyMarkers::isOpen() const noexcept { return outlet_ != nullptr; }

void StudyMarkers::push(const std::string& words, double secondsFromNow) {
    if (!isOpen()) return;
    const std::string line = cleanLine(words);
    const char* text = line.c_str();
    outlet_->pushText(outlet_->outlet, &text, outlet_->clock() + secondsFromNow);
}

} // namespace physvib
