// SPDX-License-Identifier: GPL-3.0-or-later
// Every point that a VST3 host sends of a parameter, and its notes with their ids, tuning and expression:
// JUCE's wrapper reads the last point of a block alone, and of notes what MIDI has. Included by the header of
// that wrapper which vst3-header.cmake writes, where the host's block is made into ours.
#pragma once
#undef Complex // X11's: as of JUCE 9 its headers come before this one
#include "PluginProcessor.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <cstdint>
#include <limits>
#include <pluginterfaces/vst/ivstnoteexpression.h>
#include <string_view>

namespace physvib {

namespace vst = Steinberg::Vst;
using Steinberg::int16, Steinberg::int32, Steinberg::tresult;

/// As JUCE's wrapper numbers parameters: a hash of the id without its highest bit.
inline const std::array<vst::ParamID, parameterCount> vst3ParameterIds = [] {
    std::array<vst::ParamID, parameterCount> ids{};
    for (std::size_t p = 0; p < parameterCount; ++p) {
        const auto& id = allParameters()[p].id;
        ids[p] = static_cast<vst::ParamID>(
                     juce::String::fromUTF8(id.data(), static_cast<int>(id.size())).hashCode()) &
                 0x7fffffffu;
    }
    return ids;
}();

/// What hosts may draw for each note: they offer what they know. The wrapper's controller is one. Any thread.
class Vst3Expressions : public vst::INoteExpressionController {
public:
    int32 PLUGIN_API getNoteExpressionCount(int32 bus, int16) override {
        return bus == 0 ? static_cast<int32>(kinds.size()) : 0;
    }
    tresult PLUGIN_API getNoteExpressionInfo(int32 bus, int16, int32 index,
                                             vst::NoteExpressionTypeInfo& info) override {
        if (bus != 0 || index < 0 || index >= static_cast<int32>(kinds.size()))
            return Steinberg::kInvalidArgument;
        const auto& kind = kinds[static_cast<std::size_t>(index)];
        info = {};
        info.typeId = kind.id;
        for (auto* const title : {info.title, info.shortTitle})
            std::copy_n(kind.title.data(), kind.title.size(), title);
        info.unitId = -1;
        info.valueDesc = {kind.initial, 0.0, 1.0, 0};
        info.flags = kind.initial == 0.5 ? vst::NoteExpressionTypeInfo::kIsBipolar : 0;
        return Steinberg::kResultOk;
    }
    tresult PLUGIN_API getNoteExpressionStringByValue(int32, int16, vst::NoteExpressionTypeID,
                                                      vst::NoteExpressionValue, vst::String128) override {
        return Steinberg::kNotImplemented; // hosts write these kinds as they do everywhere
    }
    tresult PLUGIN_API getNoteExpressionValueByString(int32, int16, vst::NoteExpressionTypeID,
                                                      const vst::TChar*, vst::NoteExpressionValue&) override {
        return Steinberg::kNotImplemented;
    }

protected:
    ~Vst3Expressions() = default;

private:
    struct Kind {
        vst::NoteExpressionTypeID id;
        std::u16string_view title;
        double initial;
    };
    static constexpr std::array<Kind, 4> kinds{{{vst::kVolumeTypeID, u"Volume", 0.25},
                                                {vst::kPanTypeID, u"Pan", 0.5},
                                                {vst::kTuningTypeID, u"Tuning", 0.5},
                                                {vst::kBrightnessTypeID, u"Brightness", 0.5}}};
};

/// A block's events, in the order of frames also where the host's are not. As above.
class Vst3Notes final : public NoteSource {
public:
    Vst3Notes(const juce::AudioProcessor* instance, vst::IEventList* events) noexcept
        : events_{events} {
        if (!instance || !events) return;
        count_ = events->getEventCount();
        vst::Event event{};
        for (int32 i = 0, before = 0; i < count_ && isSorted_; ++i, before = event.sampleOffset)
            isSorted_ =
                events->getEvent(i, event) != Steinberg::kResultOk || i == 0 || event.sampleOffset >= before;
        static_cast<PluginProcessor*>(const_cast<juce::AudioProcessor*>(instance))->expectNotes(*this);
    }
    Vst3Notes(const Vst3Notes&) = delete;
    Vst3Notes& operator=(const Vst3Notes&) = delete;

    bool next(NoteEvent& note) noexcept override {
        for (vst::Event event{}; take(event);) {
            note = {};
            note.frame = event.sampleOffset;
            if (read(event, note)) return true;
        }
        return false;
    }

private:
    struct Place {
        int32 frame = std::numeric_limits<int32>::min(), index = -1;
        auto operator<=>(const Place&) const = default;
    };
    bool take(vst::Event& event) noexcept {
        if (isSorted_) {
            while (++last_.index < count_)
                if (events_->getEvent(last_.index, event) == Steinberg::kResultOk) return true;
            return false;
        }
        if (at_ == ordered_) order();
        if (at_ == ordered_) return false;
        last_ = order_[at_++];
        return events_->getEvent(last_.index, event) == Steinberg::kResultOk;
    }
    // The next ones after the last, as many as there is room for.
    void order() noexcept {
        at_ = ordered_ = 0;
        vst::Event event{};
        for (int32 i = 0; i < count_; ++i) {
            if (events_->getEvent(i, event) != Steinberg::kResultOk) continue;
            const Place place{event.sampleOffset, i};
            if (place <= last_) continue;
            if (ordered_ == order_.size()) {
                if (place >= order_.front()) continue;
                std::pop_heap(order_.begin(), order_.end());
                --ordered_;
            }
            order_[ordered_++] = place;
            std::push_heap(order_.begin(), order_.begin() + static_cast<std::ptrdiff_t>(ordered_));
        }
        std::sort_heap(order_.begin(), order_.begin() + static_cast<std::ptrdiff_t>(ordered_));
    }
    static std::uint8_t byte(double value, double most) noexcept {
        return static_cast<std::uint8_t>(std::clamp(value, 0.0, most) + 0.5);
    }
    static bool read(const vst::Event& event, NoteEvent& note) noexcept {
        using namespace vst;
        const auto message = [&note](int kind, int channel, int pitch, double value, int id) {
            note.midi = {static_cast<std::uint8_t>(kind | byte(channel, 15.0)), byte(pitch, 127.0),
                         byte(value > 0.0 ? 127.0 * value : 0.0, 127.0)};
            note.id = id;
            return true;
        };
        if (event.type == Event::kNoteOnEvent) {
            const auto& on = event.noteOn;
            if (std::isfinite(on.tuning)) note.value = 0.01 * static_cast<double>(on.tuning);
            return message(0x90, on.channel, on.pitch, static_cast<double>(on.velocity), on.noteId);
        }
        if (event.type == Event::kNoteOffEvent)
            return message(0x80, event.noteOff.channel, event.noteOff.pitch, 0.0, event.noteOff.noteId);
        if (event.type == Event::kPolyPressureEvent) {
            const auto& press = event.polyPressure;
            return message(0xa0, press.channel, press.pitch, static_cast<double>(press.pressure),
                           press.noteId);
        }
        return event.type == Event::kNoteExpressionValueEvent && express(event.noteExpressionValue, note);
    }
    static bool express(const vst::NoteExpressionValueEvent& event, NoteEvent& note) noexcept {
        using Kind = NoteEvent::Kind;
        note.id = event.noteId;
        if (note.id < 0) return false; // of no note
        switch (event.typeId) {
        case vst::kVolumeTypeID: note.kind = Kind::volume, note.value = 4.0 * event.value; break;
        case vst::kPanTypeID: note.kind = Kind::pan, note.value = 2.0 * event.value - 1.0; break;
        case vst::kTuningTypeID: note.kind = Kind::tuning, note.value = 240.0 * event.value - 120.0; break;
        case vst::kBrightnessTypeID: note.kind = Kind::brightness, note.value = event.value - 0.5; break;
        default: return false;
        }
        return true;
    }
    vst::IEventList* const events_;
    int32 count_ = 0;
    bool isSorted_ = true;
    Place last_;
    std::array<Place, 512> order_; // of a host that does not keep it
    std::size_t at_ = 0, ordered_ = 0;
};

/// Lives as long as the host's block. R, wait-free as the host's own queues are.
class Vst3Points final : public PointSource {
public:
    /// `instance` is a PluginProcessor: this module makes no other.
    Vst3Points(const juce::AudioProcessor* instance, vst::IParameterChanges* changes) noexcept {
        if (!instance || !changes) return;
        for (int32 i = 0, count = changes->getParameterCount(); i < count; ++i)
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
        vst::IParamValueQueue* queue = nullptr;
        int32 at = 0;
    };
    void take(vst::IParamValueQueue& queue) noexcept {
        const auto id = queue.getParameterId();
        for (std::size_t p = 0; p < parameterCount; ++p)
            if (vst3ParameterIds[p] == id) points_[p].queue = &queue;
    }
    static bool read(vst::IParamValueQueue& queue, int32 index, ParameterPoint& point) noexcept {
        int32 frame = 0;
        if (queue.getPoint(index, frame, point.normal) != Steinberg::kResultTrue) return false;
        point.frame = frame;
        return true;
    }
    std::array<Queued, parameterCount> points_{};
};

} // namespace physvib
