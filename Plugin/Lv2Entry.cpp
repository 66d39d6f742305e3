// SPDX-License-Identifier: GPL-3.0-or-later
// LV2's entry: JUCE's (which CMake compiles as juceLv2Descriptor; the Projucer cannot, and does without this file), and the
// two things that it leaves out. It prepares for the largest block a host can ever send, not for the usual one, and takes
// no notice of deactivate and activate.
#ifdef PHYSVIB_LV2_ENTRY
#include "Entry.h"
#include "PluginProcessor.h"
#include <cstring>
#include <lv2/atom/atom.h>
#include <lv2/buf-size/buf-size.h>
#include <lv2/core/lv2.h>
#include <lv2/options/options.h>
#include <lv2/urid/urid.h>
#include <map>
#include <mutex>
#include <utility>

extern "C" const LV2_Descriptor* juceLv2Descriptor(uint32_t index);

namespace physvib {

namespace {

struct Instance {
    PluginProcessor* processor = nullptr;
    bool wasDeactivated = false;
};

/// All that live, by JUCE's handles; a host may make and end them on several threads. Never asked by run.
class Instances {
public:
    void add(LV2_Handle handle, PluginProcessor* processor) {
        const std::lock_guard lock{mutex_};
        byHandle_[handle] = {processor, false};
    }
    Instance& operator[](LV2_Handle handle) { // stays where it is, and is its caller's: LV2 has one thread at a time for each
        const std::lock_guard lock{mutex_};
        return byHandle_.at(handle);
    }
    void remove(LV2_Handle handle) {
        const std::lock_guard lock{mutex_};
        byHandle_.erase(handle);
    }

private:
    std::mutex mutex_;
    std::map<LV2_Handle, Instance> byHandle_;
};
Instances& instances() {
    static Instances all;
    return all;
}

const void* feature(const LV2_Feature* const* features, const char* uri) {
    for (; features && *features; ++features)
        if (std::strcmp((*features)->URI, uri) == 0) return (*features)->data;
    return nullptr;
}

int usualBlockOf(const LV2_Feature* const* features) {
    const auto* const map = static_cast<const LV2_URID_Map*>(feature(features, LV2_URID__map));
    const auto* option = static_cast<const LV2_Options_Option*>(feature(features, LV2_OPTIONS__options));
    if (!map || !option) return 0;
    const auto wanted = map->map(map->handle, LV2_BUF_SIZE__nominalBlockLength), whole = map->map(map->handle, LV2_ATOM__Int);
    for (; option->key != 0 || option->value != nullptr; ++option)
        if (option->key == wanted && option->type == whole && option->size == sizeof(std::int32_t)) return *static_cast<const std::int32_t*>(option->value);
    return 0;
}

LV2_Handle instantiate(const LV2_Descriptor*, double rate, const char* bundle, const LV2_Feature* const* features) {
    making() = {usualBlockOf(features), nullptr};
    const auto* const juces = juceLv2Descriptor(0);
    const LV2_Handle handle = juces->instantiate(juces, rate, bundle, features);
    if (handle) instances().add(handle, making().instance);
    return handle;
}

// What is active is prepared: the scene starts at its seed, as in the other formats. The first time JUCE has done so.
void activate(LV2_Handle handle) {
    auto& [processor, wasDeactivated] = instances()[handle];
    if (std::exchange(wasDeactivated, false)) processor->prepareToPlay(processor->getSampleRate(), processor->getBlockSize());
}

void deactivate(LV2_Handle handle) {
    auto& [processor, wasDeactivated] = instances()[handle];
    wasDeactivated = true;
    processor->releaseResources();
}

void cleanup(LV2_Handle handle) {
    instances().remove(handle);
    juceLv2Descriptor(0)->cleanup(handle);
}

LV2_Descriptor completed(LV2_Descriptor juces) {
    juces.instantiate = instantiate;
    juces.activate = activate;
    juces.deactivate = deactivate;
    juces.cleanup = cleanup;
    return juces;
}

} // namespace

} // namespace physvib

extern "C" LV2_SYMBOL_EXPORT const LV2_Descriptor* lv2_descriptor(uint32_t index) {
    static const LV2_Descriptor ours = physvib::completed(*juceLv2Descriptor(0));
    return index == 0 ? &ours : nullptr;
}
#endif
