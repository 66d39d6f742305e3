// SPDX-License-Identifier: GPL-3.0-or-later
// The LV2 entry: JUCE's (which CMake compiles as juceLv2Descriptor; Projucer builds have only that), and what
// it lacks: the nominal block length (it prepares for the largest), deactivation and activation, the frames
// of parameter changes within a block, control ports, and defaults for hosts that lack features.
#ifdef PHYSVIB_LV2_ENTRY
#include "Core/Limits.h"
#include "Lv2Parts.h"
#include "PluginProcessor.h"
#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <lv2/atom/atom.h>
#include <lv2/atom/util.h>
#include <lv2/buf-size/buf-size.h>
#include <lv2/core/lv2.h>
#include <lv2/midi/midi.h>
#include <lv2/options/options.h>
#include <lv2/patch/patch.h>
#include <lv2/state/state.h>
#include <lv2/urid/urid.h>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

extern "C" const LV2_Descriptor* juceLv2Descriptor(uint32_t index);

namespace physvib {

namespace {

// Defaults for hosts that support only the core specification. They lack what JUCE's LV2 wrapper requires: a
// map of URIs to numbers, the largest block length, and a buffer for the events that the plug-in sends.

/// The data of a host's feature; null: the host has none. Any thread.
const void* feature(const LV2_Feature* const* features, const char* uri) noexcept {
    for (; features && *features; ++features)
        if (std::strcmp((*features)->URI, uri) == 0) return (*features)->data;
    return nullptr;
}

/// A map of URIs to numbers from 1, common to all instances, for hosts that have none. Any thread.
LV2_URID_Map& fallbackUridMap() {
    static LV2_URID_Map map{nullptr, [](LV2_URID_Map_Handle, const char* uri) {
                                static std::mutex mutex;
                                static std::vector<std::string> uris;
                                const std::lock_guard lock{mutex};
                                auto found = std::ranges::find(uris, uri);
                                if (found == uris.end()) found = uris.insert(uris.end(), uri);
                                return static_cast<LV2_URID>(found - uris.begin() + 1);
                            }};
    return map;
}

/// A host's features, with ours in place of those that it lacks. Valid while the host's list and this object
/// exist; instantiate copies what it keeps.
class Lv2Features {
public:
    explicit Lv2Features(const LV2_Feature* const* hostFeatures) {
        for (auto host = hostFeatures; host && *host; ++host) features_.push_back(*host);
        if (!feature(hostFeatures, LV2_URID__map)) features_.push_back(&map_);
        features_.push_back(&bounded_); // the processor takes longer blocks in parts
        if (!feature(hostFeatures, LV2_OPTIONS__options)) features_.push_back(&options_);
        features_.push_back(nullptr);
        const auto& map = *static_cast<const LV2_URID_Map*>(feature(features_.data(), LV2_URID__map));
        option_[0] = {LV2_OPTIONS_INSTANCE,
                      0,
                      map.map(map.handle, LV2_BUF_SIZE__maxBlockLength),
                      sizeof maxBlockFrames_,
                      map.map(map.handle, LV2_ATOM__Int),
                      &maxBlockFrames_};
    }
    Lv2Features(const Lv2Features&) = delete;
    Lv2Features& operator=(const Lv2Features&) = delete;
    const LV2_Feature* const* all() const noexcept { return features_.data(); }

private:
    const std::int32_t maxBlockFrames_ = limits::maxBlockFrames;
    std::array<LV2_Options_Option, 2> option_{};
    LV2_Feature map_{LV2_URID__map, &fallbackUridMap()}, bounded_{LV2_BUF_SIZE__boundedBlockLength, nullptr},
        options_{LV2_OPTIONS__options, option_.data()};
    std::vector<const LV2_Feature*> features_;
};

/// Buffer for the events that the plug-in sends, for a host that does not connect their port.
class UnconnectedEvents {
public:
    /// The buffer, emptied; to be called before each block. R, wait-free.
    LV2_Atom_Sequence* empty() noexcept {
        sequence_.atom.size = sizeof room_;
        return &sequence_;
    }

private:
    LV2_Atom_Sequence sequence_{};
    [[maybe_unused]] std::array<std::uint64_t, 1024> room_{}; // for events, right behind the sequence's head
};

/// The host's numbers of the URIs in a block's events and in a state.
struct Lv2Uris {
    LV2_URID object = 0, set = 0, subject = 0, property = 0, value = 0, urid = 0, number = 0, plugin = 0;
    LV2_URID text = 0, ports = 0, midi = 0; // the first two in a state, `midi` in an event
    std::array<LV2_URID, parameterCount> parameters{};
};

Lv2Uris mapUris(const LV2_URID_Map& map) {
    const auto idOf = [&map](const std::string& uri) { return map.map(map.handle, uri.c_str()); };
    const std::string plugin = moduleIdentity.lv2Uri;
    Lv2Uris uris{
        idOf(LV2_ATOM__Object), idOf(LV2_PATCH__Set),    idOf(LV2_PATCH__subject),  idOf(LV2_PATCH__property),
        idOf(LV2_PATCH__value), idOf(LV2_ATOM__URID),    idOf(LV2_ATOM__Float),     idOf(plugin),
        idOf(LV2_ATOM__String), idOf(plugin + ":Ports"), idOf(LV2_MIDI__MidiEvent), {}};
    for (std::size_t p = 0; p < parameterCount; ++p)
        uris.parameters[p] = idOf(plugin + ":" + std::string{allParameters()[p].id});
    return uris;
}

/// The events of a block: those that set parameters, and MIDI. R, wait-free.
class Lv2Points final : public PointSource, public NoteSource {
public:
    Lv2Points(const LV2_Atom_Sequence& events, const Lv2Uris& uris, PluginProcessor& processor) noexcept
        : events_{events}
        , uris_{uris}
        , processor_{processor} {
        cursor_.fill(lv2_atom_sequence_begin(&events.body));
        processor.setPointSource(*this);
        processor.setNoteSource(*this);
    }
    bool next(NoteEvent& note) noexcept override {
        while (!lv2_atom_sequence_is_end(&events_.body, events_.atom.size, midiCursor_)) {
            const auto* const event = std::exchange(midiCursor_, lv2_atom_sequence_next(midiCursor_));
            if (event->body.type != uris_.midi || event->body.size < 1 || event->body.size > 3) continue;
            note = {};
            note.frame = static_cast<int>(event->time.frames);
            std::memcpy(note.midi.data(), event + 1, event->body.size);
            note.midi[1] &= 127, note.midi[2] &= 127;
            return true;
        }
        return false;
    }
    bool next(std::size_t parameter, ParameterPoint& point) noexcept override {
        for (auto*& at = cursor_[parameter];
             !lv2_atom_sequence_is_end(&events_.body, events_.atom.size, at);) {
            const auto* const event = std::exchange(at, lv2_atom_sequence_next(at));
            if (readPoint(*event, parameter, point)) return true;
        }
        return false;
    }
    int lastPointFrame(std::size_t) noexcept override { return -1; }

private:
    bool readPoint(const LV2_Atom_Event& event, std::size_t parameter, ParameterPoint& point) noexcept {
        const auto& object = reinterpret_cast<const LV2_Atom_Object&>(event.body);
        if (event.body.type != uris_.object || object.body.otype != uris_.set) return false;
        const LV2_Atom *subject = nullptr, *property = nullptr, *value = nullptr;
        LV2_Atom_Object_Query query[]{{uris_.subject, &subject},
                                      {uris_.property, &property},
                                      {uris_.value, &value},
                                      LV2_ATOM_OBJECT_QUERY_END};
        lv2_atom_object_query(&object, query);
        const auto idOf = [this](const LV2_Atom* atom) {
            return atom && atom->type == uris_.urid ? reinterpret_cast<const LV2_Atom_URID*>(atom)->body : 0;
        };
        if (subject && idOf(subject) != uris_.plugin) return false;
        if (idOf(property) != uris_.parameters[parameter] || !value || value->type != uris_.number)
            return false;
        point.frame = static_cast<int>(event.time.frames);
        point.normal = processor_.parameter(static_cast<Parameter>(parameter))
                           .convertTo0to1(reinterpret_cast<const LV2_Atom_Float*>(value)->body);
        return true;
    }
    const LV2_Atom_Sequence& events_;
    const Lv2Uris& uris_;
    PluginProcessor& processor_;
    std::array<const LV2_Atom_Event*, parameterCount> cursor_{};
    const LV2_Atom_Event* midiCursor_ = lv2_atom_sequence_begin(&events_.body);
};

// Ports in order: music, channels; JUCE's for events in and out, latency, free-wheeling and enabled; then one
// for each parameter (Lv2Ports.cpp).
const auto eventPort = static_cast<std::uint32_t>(moduleIdentity.musicPorts + moduleIdentity.channels),
           firstControl = eventPort + 5, enabledPort = firstControl - 1;

/// Removes JUCE's notifications of properties, which hosts would warn of. R, wait-free.
void dropProperties(LV2_Atom_Sequence& outputEvents, const Lv2Uris& uris) noexcept {
    auto* to = lv2_atom_sequence_begin(&outputEvents.body);
    for (auto* at = to; !lv2_atom_sequence_is_end(&outputEvents.body, outputEvents.atom.size, at);) {
        auto* const event = std::exchange(at, lv2_atom_sequence_next(at));
        const auto& object = reinterpret_cast<const LV2_Atom_Object&>(event->body);
        if (event->body.type == uris.object && object.body.otype == uris.set) continue;
        const auto bytes = reinterpret_cast<std::byte*>(at) - reinterpret_cast<std::byte*>(event);
        std::memmove(to, event, static_cast<std::size_t>(bytes));
        to = reinterpret_cast<LV2_Atom_Event*>(reinterpret_cast<std::byte*>(to) + bytes);
    }
    const auto bytes = reinterpret_cast<std::byte*>(to) - reinterpret_cast<std::byte*>(&outputEvents.body);
    outputEvents.atom.size = static_cast<std::uint32_t>(bytes);
}

struct Instance {
    PluginProcessor* processor = nullptr;
    bool wasDeactivated = false;
    Lv2Uris uris{};
    const LV2_Atom_Sequence* events = nullptr; // the input port's, as connected for this block
    std::shared_ptr<Lv2Controls> controls{};
    LV2_Atom_Sequence* outputEvents = nullptr; // the output port's, likewise
    std::shared_ptr<UnconnectedEvents> sink{}; // for a host that does not connect the output port
};

/// All instances by JUCE's handles. A host may create and delete them on several threads while it runs
/// others, so an entry of the list is reused, but never freed.
class Instances {
public:
    void add(LV2_Handle handle, const Instance& instance) {
        const std::lock_guard lock{mutex_};
        Slot* slot = firstSlot_;
        while (slot && slot->handle != nullptr) slot = slot->next;
        const bool isNew = !slot;
        if (isNew) {
            slot = new Slot;
            slot->next = firstSlot_;
        }
        slot->instance = instance;
        slot->handle = handle;
        if (isNew) firstSlot_ = slot; // publishes it
    }
    /// The existing instance of that handle; LV2 calls each from one thread at a time. Wait-free.
    Instance& operator[](LV2_Handle handle) noexcept {
        Slot* slot = firstSlot_;
        while (slot->handle != handle) slot = slot->next;
        return slot->instance;
    }
    void remove(LV2_Handle handle) {
        const std::lock_guard lock{mutex_};
        for (Slot* slot = firstSlot_; slot; slot = slot->next)
            if (slot->handle == handle) slot->handle = nullptr;
    }

private:
    struct Slot {
        std::atomic<LV2_Handle> handle{nullptr};
        Instance instance;
        Slot* next = nullptr;
    };
    std::mutex mutex_; // locked to add or remove
    std::atomic<Slot*> firstSlot_{nullptr};
};
Instances& instances() {
    static Instances all;
    return all;
}

int readNominalFrames(const LV2_Feature* const* features) {
    const auto* const map = static_cast<const LV2_URID_Map*>(feature(features, LV2_URID__map));
    const auto* option = static_cast<const LV2_Options_Option*>(feature(features, LV2_OPTIONS__options));
    if (!map || !option) return 0;
    const auto lengthKey = map->map(map->handle, LV2_BUF_SIZE__nominalBlockLength),
               intType = map->map(map->handle, LV2_ATOM__Int);
    for (; option->key != 0 || option->value != nullptr; ++option)
        if (option->key == lengthKey && option->type == intType && option->size == sizeof(std::int32_t))
            return *static_cast<const std::int32_t*>(option->value);
    return 0;
}

LV2_Handle instantiate(const LV2_Descriptor*, double rate, const char* bundle,
                       const LV2_Feature* const* hostFeatures) {
    const Lv2Features features{hostFeatures};
    instanceCreation() = {readNominalFrames(features.all()), nullptr};
    const auto* const juceDescriptor = juceLv2Descriptor(0);
    const LV2_Handle handle = juceDescriptor->instantiate(juceDescriptor, rate, bundle, features.all());
    const auto uris = mapUris(*static_cast<const LV2_URID_Map*>(feature(features.all(), LV2_URID__map)));
    auto controls = std::make_shared<Lv2Controls>();
    if (handle)
        instances().add(handle, {instanceCreation().instance, false, uris, nullptr, std::move(controls),
                                 nullptr, std::make_shared<UnconnectedEvents>()});
    return handle;
}

void connect(LV2_Handle handle, std::uint32_t port, void* data) {
    if (port >= firstControl) {
        const auto parameter = port - firstControl;
        if (parameter < parameterCount) instances()[handle].controls->connect(parameter, data);
        return;
    }
    if (port == enabledPort) { // not for JUCE's own bypass, so that there is only ours
        static float isOn = 1.0f;
        instances()[handle].controls->connect(Lv2Controls::enabled, data);
        data = &isOn;
    }
    if (port == eventPort) instances()[handle].events = static_cast<const LV2_Atom_Sequence*>(data);
    if (port == eventPort + 1) instances()[handle].outputEvents = static_cast<LV2_Atom_Sequence*>(data);
    juceLv2Descriptor(0)->connect_port(handle, port, data);
}

void run(LV2_Handle handle, std::uint32_t frames) {
    auto& instance = instances()[handle];
    const auto* const juceDescriptor = juceLv2Descriptor(0);
    instance.controls->read(*instance.processor);
    if (!instance.outputEvents) juceDescriptor->connect_port(handle, eventPort + 1, instance.sink->empty());
    if (!instance.events) return juceDescriptor->run(handle, frames);
    Lv2Points points{*instance.events, instance.uris, *instance.processor};
    juceDescriptor->run(handle, frames);
    if (instance.outputEvents) dropProperties(*instance.outputEvents, instance.uris);
}

// Prepares again, which JUCE does only once, so that the scene begins at its seed as in other formats.
void activate(LV2_Handle handle) {
    auto& instance = instances()[handle];
    auto* const processor = instance.processor;
    if (std::exchange(instance.wasDeactivated, false))
        processor->prepareToPlay(processor->getSampleRate(), processor->getBlockSize());
}

void deactivate(LV2_Handle handle) {
    auto& instance = instances()[handle];
    instance.wasDeactivated = true;
    instance.processor->releaseResources();
}

void cleanup(LV2_Handle handle) {
    instances().remove(handle);
    juceLv2Descriptor(0)->cleanup(handle);
}

const LV2_State_Interface& juceState() {
    const auto* const state = juceLv2Descriptor(0)->extension_data(LV2_STATE__interface);
    return *static_cast<const LV2_State_Interface*>(state);
}

LV2_State_Status save(LV2_Handle handle, LV2_State_Store_Function store, LV2_State_Handle host,
                      std::uint32_t flags, const LV2_Feature* const* features) {
    const auto& instance = instances()[handle];
    const auto& uris = instance.uris;
    const std::string ports = instance.controls->text();
    constexpr auto kind = LV2_STATE_IS_POD | LV2_STATE_IS_PORTABLE;
    store(host, uris.ports, ports.c_str(), ports.size() + 1, uris.text, kind);
    return juceState().save(handle, store, host, flags, features);
}

LV2_State_Status restore(LV2_Handle handle, LV2_State_Retrieve_Function retrieve, LV2_State_Handle host,
                         std::uint32_t flags, const LV2_Feature* const* features) {
    const auto status = juceState().restore(handle, retrieve, host, flags, features);
    const auto& instance = instances()[handle];
    std::size_t size = 0;
    std::uint32_t type = 0, kind = 0;
    const void* const ports = retrieve(host, instance.uris.ports, &size, &type, &kind);
    if (!ports || type != instance.uris.text) return status;
    instance.controls->restore({static_cast<const char*>(ports), size});
    return status;
}

const void* extension(const char* uri) {
    static constexpr LV2_State_Interface state{save, restore};
    return std::strcmp(uri, LV2_STATE__interface) == 0 ? &state : juceLv2Descriptor(0)->extension_data(uri);
}

LV2_Descriptor completed(LV2_Descriptor juceDescriptor) {
    juceDescriptor.instantiate = instantiate;
    juceDescriptor.connect_port = connect;
    juceDescriptor.run = run;
    juceDescriptor.activate = activate;
    juceDescriptor.deactivate = deactivate;
    juceDescriptor.cleanup = cleanup;
    juceDescriptor.extension_data = extension;
    return juceDescriptor;
}

} // namespace

Lv2Parts findLv2Parts(void* instance) noexcept {
    const auto& found = instances()[instance];
    return {found.processor, found.controls, firstControl};
}

} // namespace physvib

LV2_SYMBOL_EXPORT const LV2_Descriptor* lv2_descriptor(uint32_t index) {
    static const LV2_Descriptor ours = physvib::completed(*juceLv2Descriptor(0));
    return index == 0 ? &ours : nullptr;
}
#endif
