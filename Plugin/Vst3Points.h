// SPDX-License-Identifier: GPL-3.0-or-later
// A VST3 block's parameter points (Vst3Points), its notes with ids, tuning and expression (Vst3Notes), and
// the list of expressions for the host (Vst3Expressions): JUCE's wrapper has only a block's last point, and
// of notes only what MIDI has. The wrapper's header, which vst3-header.cmake writes, includes this one.
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

namespace physvib {

namespace vst = Steinberg::Vst;
using Steinberg::int16, Steinberg::int32, Steinberg::tresult;

/// JUCE's numbers of the parameters: a hash of the id without its highest bit.
inline const std::array<vst::ParamID, parameterCount> vst3ParameterIds = [] {
    std::array<vst::ParamID, parameterCount> ids{};
    for (std::size_t p = 0; p < parameterCount; ++p)
        ids[p] = static_cast<vst::ParamID>(fromUtf8(allParameters()[p].id).hashCode()) & 0x7fffffffu;
    return ids;
}();

/// The note expressions that hosts may offer. JUCE's controller inherits from it. Any thread.
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
        return Steinberg::kNotImplemented; // hosts have their own text for these standard kinds
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

/// The note events of a block, sorted by frame if the host did not. R, wait-free as the host's own list is.
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
        static_cast<PluginProcessor*>(const_cast<juce::AudioProcessor*>(instance))->setNoteSource(*this);
    }
    Vst3Notes(const Vst3Notes&) = delete;
    Vst3Notes& operator=(const Vst3Notes&) = delete;

    bool next(NoteEvent& note) noexcept override {
        for (vst::Event event{}; readNext(event);) {
            note = {};
            note.frame = event.sampleOffset;
            if (read(event, note)) return true;
        }
        return false;
    }

private:
    struct EventPosition {
        int32 frame = std::numeric_limits<int32>::min(), index = -1;
        auto operator<=>(const EventPosition&) const = default;
    };
    bool readNext(vst::Event& event) noexcept {
        if (isSorted_) {
            while (++lastPosition_.index < count_)
                if (events_->getEvent(lastPosition_.index, event) == Steinberg::kResultOk) return true;
            return false;
        }
        if (nextSorted_ == sortedCount_) sortNext();
        if (nextSorted_ == sortedCount_) return false;
        lastPosition_ = sorted_[nextSorted_++];
        return events_->getEvent(lastPosition_.index, event) == Steinberg::kResultOk;
    }
    // Sorts the next events after the last one by frame, as many as the array has room for.
    void sortNext() noexcept {
        nextSorted_ = sortedCount_ = 0;
        vst::Event event{};
        for (int32 i = 0; i < count_; ++i) {
            if (events_->getEvent(i, event) != Steinberg::kResultOk) continue;
            const EventPosition position{event.sampleOffset, i};
            if (position <= lastPosition_) continue;
            if (sortedCount_ == sorted_.size()) {
                if (position >= sorted_.front()) continue;
                std::pop_heap(sorted_.begin(), sorted_.end());
                --sortedCount_;
            }
            sorted_[sortedCount_++] = position;
            std::push_heap(sorted_.begin(), sorted_.begin() + static_cast<std::ptrdiff_t>(sortedCount_));
        }
        std::sort_heap(sorted_.begin(), sorted_.begin() + static_cast<std::ptrdiff_t>(sortedCount_));
    }
    static std::uint8_t byte(double value, double maximum) noexcept {
        return static_cast<std::uint8_t>(std::clamp(value, 0.0, maximum) + 0.5);
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
        return event.type == Event::kNoteExpressionValueEvent &&
               readExpression(event.noteExpressionValue, note);
    }
    static bool readExpression(const vst::NoteExpressionValueEvent& event, NoteEvent& note) noexcept {
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
    EventPosition lastPosition_;
    std::array<EventPosition, 512> sorted_; // used if the host's events are not sorted
    std::size_t nextSorted_ = 0, sortedCount_ = 0;
};

/// The parameter points of a block. R, wait-free as the host's own queues are.
class Vst3Points final : public PointSource {
public:
    /// `instance` must be a PluginProcessor, as this module creates no other processor.
    Vst3Points(const juce::AudioProcessor* instance, vst::IParameterChanges* changes) noexcept {
        if (!instance || !changes) return;
        for (int32 i = 0, count = changes->getParameterCount(); i < count; ++i)
            if (auto* const queue = changes->getParameterData(i)) addQueue(*queue);
        static_cast<PluginProcessor*>(const_cast<juce::AudioProcessor*>(instance))->setPointSource(*this);
    }
    Vst3Points(const Vst3Points&) = delete;
    Vst3Points& operator=(const Vst3Points&) = delete;

    bool next(std::size_t parameter, ParameterPoint& point) noexcept override {
        auto& reader = points_[parameter];
        while (reader.queue && reader.nextIndex < reader.queue->getPointCount())
            if (read(*reader.queue, reader.nextIndex++, point)) return true;
        return false;
    }

    int lastPointFrame(std::size_t parameter) noexcept override {
        ParameterPoint last;
        auto* const queue = points_[parameter].queue;
        return queue && queue->getPointCount() > 0 && read(*queue, queue->getPointCount() - 1, last)
                   ? last.frame
                   : -1;
    }

private:
    struct QueueReader {
        vst::IParamValueQueue* queue = nullptr;
        int32 nextIndex = 0;
    };
    void addQueue(vst::IParamValueQueue& queue) noexcept {
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
    std::array<QueueReader, parameterCount> points_{};
};

} // namespace physvib
