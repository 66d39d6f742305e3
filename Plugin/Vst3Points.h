// SPDX-License-Identifier: GPL-3.0-or-later
// Every point that a VST3 host sends of a parameter: JUCE's wrapper reads the last of a block alone. Included
// by the header of that wrapper which vst3-header.cmake writes, where the host's block is made into ours;
// VST3's own headers come before it.
#pragma once
#undef Complex // X11's: as of JUCE 9 its headers come before this one
#include "PluginProcessor.h"
#include <array>
#include <cstdint>

namespace physvib {

/// As JUCE's wrapper numbers parameters: a hash of the id without its highest bit.
inline const std::array<Steinberg::Vst::ParamID, parameterCount> vst3ParameterIds = [] {
    std::array<Steinberg::Vst::ParamID, parameterCount> ids{};
    for (std::size_t p = 0; p < parameterCount; ++p) {
        const auto& id = allParameters()[p].id;
        ids[p] = static_cast<Steinberg::Vst::ParamID>(
                     juce::String::fromUTF8(id.data(), static_cast<int>(id.size())).hashCode()) &
                 0x7fffffffu;
    }
    return ids;
}();

/// Lives as long as the host's block. R, wait-free as the host's own queues are.
class Vst3Points final : public PointSource {
public:
    /// `instance` is a PluginProcessor: this module makes no other.
    Vst3Points(const juce::AudioProcessor* instance, Steinberg::Vst::IParameterChanges* changes) noexcept {
        if (!instance || !changes) return;
        for (Steinberg::int32 i = 0, count = changes->getParameterCount(); i < count; ++i)
            if (auto* const queue = changes->getParameterData(i)) take(*queue);
        static_cast<PluginProcessor*>(const_cast<juce::AudioProcessor*>(instance))->expectPoints(*this);
    }
    Vst3Points(const Vst3Points&) = delete;
    Vst3Points& operator=(const Vst3Points&) = delete;

    bool next(std::size_t parameter, ParameterPoint& point) noexcept override {
        auto& queued = points_[parameter];
        while (queued.queue && queued.at < queued.queue->getPointCount())
            if (read(*queued.queue, queued.at++, point)) return true;
        return false;
    }

    int lastOfLine(std::size_t parameter) noexcept override {
        ParameterPoint last;
        auto* const queue = points_[parameter].queue;
        return queue && queue->getPointCount() > 0 && read(*queue, queue->getPointCount() - 1, last)
                   ? last.frame
                   : -1;
    }

private:
    struct Queued {
        Steinberg::Vst::IParamValueQueue* queue = nullptr;
        Steinberg::int32 at = 0;
    };
    void take(Steinberg::Vst::IParamValueQueue& queue) noexcept {
        const auto id = queue.getParameterId();
        for (std::size_t p = 0; p < parameterCount; ++p)
            if (vst3ParameterIds[p] == id) points_[p].queue = &queue;
    }
    static bool read(Steinberg::Vst::IParamValueQueue& queue, Steinberg::int32 index,
                     ParameterPoint& point) noexcept {
        Steinberg::int32 frame = 0;
        if (queue.getPoint(index, frame, point.normal) != Steinberg::kResultTrue) return false;
        point.frame = frame;
        return true;
    }
    std::array<Queued, parameterCount> points_{};
};

} // namespace physvib
