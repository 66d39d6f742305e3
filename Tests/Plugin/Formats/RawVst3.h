// SPDX-License-Identifier: GPL-3.0-or-later
// The least a VST3 host can be: one component of a module, its buses, its state, blocks with notes. Does only
// what it is told, so that a plug-in can be met in every order of calls.
#pragma once
#include <algorithm>
#include <array>
#include <cstring>
#include <dlfcn.h>
#include <pluginterfaces/base/funknown.h>
#include <pluginterfaces/base/ibstream.h>
#include <pluginterfaces/base/ipluginbase.h>
#include <pluginterfaces/vst/ivstaudioprocessor.h>
#include <pluginterfaces/vst/ivstcomponent.h>
#include <pluginterfaces/vst/ivsteditcontroller.h>
#include <pluginterfaces/vst/ivstevents.h>
#include <pluginterfaces/vst/ivstmessage.h>
#include <pluginterfaces/vst/ivstmidicontrollers.h>
#include <pluginterfaces/vst/ivstnoteexpression.h>
#include <pluginterfaces/vst/ivstparameterchanges.h>
#include <pluginterfaces/vst/ivstprocesscontext.h>
#include <pluginterfaces/vst/vstspeaker.h>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace physvib::test {

namespace vst = Steinberg::Vst;
using Steinberg::int16, Steinberg::int32, Steinberg::int64, Steinberg::uint32, Steinberg::tresult;
using Steinberg::kResultOk, Steinberg::kResultTrue;

/// On the host's stack: never counted, never freed.
template <class Interface>
struct OnStack : Interface {
    tresult PLUGIN_API queryInterface(const Steinberg::TUID, void** object) override {
        *object = nullptr;
        return Steinberg::kNoInterface;
    }
    uint32 PLUGIN_API addRef() override { return 1; }
    uint32 PLUGIN_API release() override { return 1; }
};

struct Stream final : OnStack<Steinberg::IBStream> {
    std::string bytes;
    std::size_t at = 0;
    tresult PLUGIN_API read(void* to, int32 count, int32* done) override {
        const auto n = std::min(static_cast<std::size_t>(count), bytes.size() - at);
        std::memcpy(to, bytes.data() + at, n);
        at += n;
        if (done) *done = static_cast<int32>(n);
        return kResultOk;
    }
    tresult PLUGIN_API write(void* from, int32 count, int32* done) override {
        bytes.append(static_cast<const char*>(from), static_cast<std::size_t>(count));
        if (done) *done = count;
        return kResultOk;
    }
    tresult PLUGIN_API seek(int64 place, int32 mode, int64* result) override {
        const auto from = mode == kIBSeekSet   ? 0
                          : mode == kIBSeekCur ? static_cast<int64>(at)
                                               : static_cast<int64>(bytes.size());
        at = static_cast<std::size_t>(std::clamp<int64>(from + place, 0, static_cast<int64>(bytes.size())));
        if (result) *result = static_cast<int64>(at);
        return kResultOk;
    }
    tresult PLUGIN_API tell(int64* place) override {
        *place = static_cast<int64>(at);
        return kResultOk;
    }
};

struct Notes final : OnStack<vst::IEventList> {
    std::vector<vst::Event> events;
    int32 PLUGIN_API getEventCount() override { return static_cast<int32>(events.size()); }
    tresult PLUGIN_API getEvent(int32 index, vst::Event& event) override {
        event = events[static_cast<std::size_t>(index)];
        return kResultOk;
    }
    tresult PLUGIN_API addEvent(vst::Event& event) override {
        events.push_back(event);
        return kResultOk;
    }
};

/// Of one parameter within a block.
struct Queue final : OnStack<vst::IParamValueQueue> {
    vst::ParamID id = 0;
    std::vector<std::pair<int32, vst::ParamValue>> points;
    vst::ParamID PLUGIN_API getParameterId() override { return id; }
    int32 PLUGIN_API getPointCount() override { return static_cast<int32>(points.size()); }
    tresult PLUGIN_API getPoint(int32 index, int32& frame, vst::ParamValue& value) override {
        if (index < 0 || index >= getPointCount()) return Steinberg::kResultFalse;
        std::tie(frame, value) = points[static_cast<std::size_t>(index)];
        return kResultTrue;
    }
    tresult PLUGIN_API addPoint(int32 frame, vst::ParamValue value, int32& index) override {
        points.emplace_back(frame, value);
        index = getPointCount() - 1;
        return kResultTrue;
    }
};

struct Changes final : OnStack<vst::IParameterChanges> {
    std::vector<Queue> queues;
    int32 PLUGIN_API getParameterCount() override { return static_cast<int32>(queues.size()); }
    vst::IParamValueQueue* PLUGIN_API getParameterData(int32 index) override {
        return &queues[static_cast<std::size_t>(index)];
    }
    vst::IParamValueQueue* PLUGIN_API addParameterData(const vst::ParamID& id, int32& index) override {
        index = getParameterCount();
        queues.emplace_back().id = id;
        return &queues.back();
    }
};

class RawVst3 {
public:
    explicit RawVst3(const std::string& bundle, const std::string& name) {
        module_ = dlopen((bundle + "/Contents/x86_64-linux/" + name + ".so").c_str(), RTLD_NOW | RTLD_LOCAL);
        if (!module_) return;
        reinterpret_cast<bool (*)(void*)>(dlsym(module_, "ModuleEntry"))(module_);
        factory_ = reinterpret_cast<Steinberg::IPluginFactory* (*)()>(dlsym(module_, "GetPluginFactory"))();
        for (int32 i = 0; i < factory_->countClasses(); ++i) {
            Steinberg::PClassInfo info;
            factory_->getClassInfo(i, &info);
            if (std::strcmp(info.category, kVstAudioEffectClass) == 0)
                factory_->createInstance(info.cid, vst::IComponent_iid, reinterpret_cast<void**>(&component));
        }
        component->initialize(nullptr);
        component->queryInterface(vst::IAudioProcessor_iid, reinterpret_cast<void**>(&processor));
        readParameters();
    }
    ~RawVst3() {
        if (!module_) return;
        component->terminate();
        processor->release();
        component->release();
        factory_->release();
        reinterpret_cast<bool (*)()>(dlsym(module_, "ModuleExit"))();
        dlclose(module_);
    }
    bool isLoaded() const { return component && processor; }

    bool setState(const std::string& state) {
        Stream stream;
        stream.bytes = state;
        return component->setState(&stream) == kResultOk;
    }
    std::string state() {
        Stream stream;
        component->getState(&stream);
        return stream.bytes;
    }
    bool arrange(std::vector<vst::SpeakerArrangement> outputs,
                 std::vector<vst::SpeakerArrangement> inputs = {}) {
        return processor->setBusArrangements(inputs.data(), static_cast<int32>(inputs.size()), outputs.data(),
                                             static_cast<int32>(outputs.size())) == kResultTrue;
    }
    /// A side chain of one channel or two, before start; what comes in by it is `music`.
    bool hear(std::size_t channels, int block) {
        music.assign(channels, std::vector<float>(static_cast<std::size_t>(block)));
        return arrange({}, {channels == 1 ? vst::SpeakerArr::kMono : vst::SpeakerArr::kStereo});
    }
    int channelsOf(int bus) {
        vst::SpeakerArrangement arrangement = 0;
        processor->getBusArrangement(vst::kOutput, bus, arrangement);
        return vst::SpeakerArr::getChannelCount(arrangement);
    }
    int buses() { return component->getBusCount(vst::kAudio, vst::kOutput); }

    /// Buffers for every bus, active or not, as the standard wants.
    void start(int block, bool activateBuses = true, double rate = 48000.0) {
        block_ = block;
        context.sampleRate = rate;
        context.state = vst::ProcessContext::kPlaying;
        if (activateBuses)
            for (int b = 0; b < buses(); ++b) component->activateBus(vst::kAudio, vst::kOutput, b, true);
        if (!music.empty()) component->activateBus(vst::kAudio, vst::kInput, 0, true);
        component->activateBus(vst::kEvent, vst::kInput, 0, true);
        vst::ProcessSetup setup{mode, vst::kSample32, block, rate};
        processor->setupProcessing(setup);
        component->setActive(true);
        processor->setProcessing(true);
        channels.clear();
        for (int b = 0; b < buses(); ++b)
            channels.push_back(
                std::vector<std::vector<float>>(static_cast<std::size_t>(channelsOf(b)),
                                                std::vector<float>(static_cast<std::size_t>(block))));
    }
    void stop() {
        processor->setProcessing(false);
        component->setActive(false);
    }
    void note(int pitch, int frame = 0) {
        vst::Event event{};
        event.type = vst::Event::kNoteOnEvent;
        event.sampleOffset = frame;
        event.noteOn.pitch = static_cast<int16>(pitch);
        event.noteOn.velocity = 1.0f;
        event.noteOn.noteId = -1;
        notes_.events.push_back(event);
    }
    /// Makes it that key's end.
    void letGo(int channel = 0) {
        const auto pitch = event().noteOn.pitch;
        event().type = vst::Event::kNoteOffEvent;
        event().noteOff = {static_cast<int16>(channel), pitch, 0.0f, -1, 0.0f};
    }
    vst::Event& event() { return notes_.events.back(); } ///< what note() made, to become another
    bool process() { return process(block_); }
    bool process(int frames) {
        std::vector<std::vector<float*>> pointers;
        std::vector<vst::AudioBusBuffers> outputs(channels.size());
        for (auto& bus : channels) {
            pointers.emplace_back();
            for (auto& channel : bus) pointers.back().push_back(channel.data());
        }
        for (std::size_t b = 0; b < channels.size(); ++b) {
            outputs[b].numChannels = static_cast<int32>(channels[b].size());
            outputs[b].channelBuffers32 = pointers[b].data();
        }
        std::vector<float*> heard;
        for (auto& channel : music) heard.push_back(channel.data());
        vst::AudioBusBuffers input;
        input.numChannels = static_cast<int32>(heard.size());
        input.channelBuffers32 = heard.data();
        vst::ProcessData data;
        data.processMode = mode;
        data.numSamples = frames;
        data.numInputs = heard.empty() ? 0 : 1;
        data.inputs = &input;
        data.numOutputs = static_cast<int32>(outputs.size());
        data.outputs = outputs.data();
        data.inputEvents = &notes_;
        data.inputParameterChanges = &changes;
        data.processContext = hasContext ? &context : nullptr;
        const bool done = call(*processor, data) == kResultOk;
        notes_.events.clear();
        changes.queues.clear();
        return done;
    }

    /// Of the next block, in the order in which the module lists its parameters.
    void point(std::size_t parameter, int frame, double value) {
        const auto id = ids_[parameter];
        const auto found = std::find_if(changes.queues.begin(), changes.queues.end(),
                                        [id](const Queue& queue) { return queue.id == id; });
        int32 index = 0;
        auto* const queue = found == changes.queues.end() ? changes.addParameterData(id, index) : &*found;
        queue->addPoint(frame, value, index);
    }

    Changes changes;               ///< of the next block
    vst::ProcessContext context{}; ///< of all that follow
    bool hasContext = true;
    std::vector<std::u16string> names, shortNames;      ///< of the parameters
    std::array<std::vector<vst::ParamID>, 16> standIns; ///< [MIDI channel][controller], bends and pressure as
                                                        ///< VST3 numbers them; 0: none that is listed
    std::vector<vst::NoteExpressionTypeID> expressions;
    vst::IComponent* component = nullptr;
    vst::IAudioProcessor* processor = nullptr;
    int32 mode = vst::kOffline;
    tresult (*call)(vst::IAudioProcessor&, vst::ProcessData&) =
        [](vst::IAudioProcessor& to, vst::ProcessData& data) { return to.process(data); };
    std::vector<std::vector<float>> music; ///< [channel][frame] of the next block; none: the side chain is
                                           ///< off
    std::vector<std::vector<std::vector<float>>> channels; ///< [bus][channel][frame] of the last block

private:
    void readParameters() {
        Steinberg::TUID id;
        vst::IEditController* controller = nullptr;
        component->getControllerClassId(id);
        factory_->createInstance(id, vst::IEditController_iid, reinterpret_cast<void**>(&controller));
        controller->initialize(nullptr);
        vst::IConnectionPoint *one = nullptr, *other = nullptr;
        component->queryInterface(vst::IConnectionPoint_iid, reinterpret_cast<void**>(&one));
        controller->queryInterface(vst::IConnectionPoint_iid, reinterpret_cast<void**>(&other));
        one->connect(other);
        other->connect(one);
        for (int32 i = 0; i < controller->getParameterCount(); ++i) {
            vst::ParameterInfo info;
            controller->getParameterInfo(i, info);
            ids_.push_back(info.id);
            names.emplace_back(info.title);
            shortNames.emplace_back(info.shortTitle);
        }
        vst::IMidiMapping* mapping = nullptr;
        controller->queryInterface(vst::IMidiMapping_iid, reinterpret_cast<void**>(&mapping));
        for (int16 c = 0; mapping && c < 16; ++c)
            for (int16 number = 0; number < vst::kCountCtrlNumber; ++number) {
                auto& id = standIns[static_cast<std::size_t>(c)].emplace_back();
                if (mapping->getMidiControllerAssignment(0, c, number, id) != kResultTrue ||
                    std::find(ids_.begin(), ids_.end(), id) == ids_.end())
                    id = 0;
            }
        if (mapping) mapping->release();
        vst::INoteExpressionController* expression = nullptr;
        controller->queryInterface(vst::INoteExpressionController_iid, reinterpret_cast<void**>(&expression));
        for (int32 i = 0; expression && i < expression->getNoteExpressionCount(0, 0); ++i) {
            vst::NoteExpressionTypeInfo info{};
            expression->getNoteExpressionInfo(0, 0, i, info);
            expressions.push_back(info.typeId);
        }
        if (expression) expression->release();
        one->disconnect(other);
        other->disconnect(one);
        one->release();
        other->release();
        controller->terminate();
        controller->release();
    }
    std::vector<vst::ParamID> ids_;
    void* module_ = nullptr;
    Steinberg::IPluginFactory* factory_ = nullptr;
    Notes notes_;
    int block_ = 0;
};

} // namespace physvib::test
