// SPDX-License-Identifier: GPL-3.0-or-later
// LV2's entry of the window: JUCE's (which CMake compiles as juceLv2UiDescriptor), and what it leaves out:
// the port of a parameter that something else moved is written, so that the host's own slider follows.
#ifdef PHYSVIB_LV2_ENTRY
#include "Lv2Parts.h"
#include <cstring>
#include <lv2/core/lv2.h>
#include <lv2/instance-access/instance-access.h>
#include <lv2/ui/ui.h>
#include <map>
#include <utility>

extern "C" const LV2UI_Descriptor* juceLv2UiDescriptor(uint32_t index);

namespace physvib {

namespace {

/// Writes what the host does not know yet. Only on the thread of the host's windows, which calls `idle`.
class PortWriter {
public:
    PortWriter(Lv2Parts parts, LV2UI_Write_Function write, LV2UI_Controller host)
        : parts_{std::move(parts)}
        , write_{write}
        , host_{host} {}

    void idle() {
        for (std::size_t p = 0; p < Lv2Controls::portCount; ++p) {
            const auto value = parts_.controls->valueToWrite(p, *parts_.processor);
            const auto port = p == Lv2Controls::enabled ? parts_.firstControl - 1
                                                        : parts_.firstControl + static_cast<std::uint32_t>(p);
            if (value && value != written_[p]) write_(host_, port, sizeof *value, 0, &*value);
            written_[p] = value; // written once, because a host that plays automation refuses it
        }
    }

private:
    Lv2Parts parts_;
    LV2UI_Write_Function write_;
    LV2UI_Controller host_;
    std::array<std::optional<float>, Lv2Controls::portCount> written_{};
};

/// The writers by JUCE's handles; only on the thread of the host's windows.
std::map<LV2UI_Handle, PortWriter>& writers() {
    static std::map<LV2UI_Handle, PortWriter> all;
    return all;
}

LV2UI_Handle openWindow(const LV2UI_Descriptor*, const char* plugin, const char* bundle,
                        LV2UI_Write_Function write, LV2UI_Controller host, LV2UI_Widget* widget,
                        const LV2_Feature* const* features) {
    const auto* const juceDescriptor = juceLv2UiDescriptor(0);
    const LV2UI_Handle window =
        juceDescriptor->instantiate(juceDescriptor, plugin, bundle, write, host, widget, features);
    if (!window || !write) return window;
    for (; *features; ++features)
        if (std::strcmp((*features)->URI, LV2_INSTANCE_ACCESS_URI) == 0)
            writers().try_emplace(window, findLv2Parts((*features)->data), write, host);
    return window;
}

void closeWindow(LV2UI_Handle window) {
    writers().erase(window);
    juceLv2UiDescriptor(0)->cleanup(window);
}

const LV2UI_Idle_Interface& juceIdle() {
    const auto* const idle = juceLv2UiDescriptor(0)->extension_data(LV2_UI__idleInterface);
    return *static_cast<const LV2UI_Idle_Interface*>(idle);
}

int idleWindow(LV2UI_Handle window) {
    const int result = juceIdle().idle(window);
    if (const auto writer = writers().find(window); writer != writers().end()) writer->second.idle();
    return result;
}

const void* windowExtension(const char* uri) {
    static constexpr LV2UI_Idle_Interface idle{idleWindow};
    return std::strcmp(uri, LV2_UI__idleInterface) == 0 ? &idle : juceLv2UiDescriptor(0)->extension_data(uri);
}

LV2UI_Descriptor withPortUpdates(LV2UI_Descriptor juceDescriptor) {
    juceDescriptor.instantiate = openWindow;
    juceDescriptor.cleanup = closeWindow;
    juceDescriptor.extension_data = windowExtension;
    return juceDescriptor;
}

} // namespace

} // namespace physvib

LV2_SYMBOL_EXPORT const LV2UI_Descriptor* lv2ui_descriptor(uint32_t index) {
    static const LV2UI_Descriptor ours = physvib::withPortUpdates(*juceLv2UiDescriptor(0));
    return index == 0 ? &ours : nullptr;
}
#endif
