// SPDX-License-Identifier: GPL-3.0-or-later
// LV2's entry: JUCE's (which CMake compiles as juceLv2Descriptor; the Projucer does without this file), and
// four things that it leaves out. It prepares for the largest block, not the usual one, takes no notice of
// deactivate and activate, of what sets a parameter within a block it knows no frame, has no control ports.
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
                                static std::vector<std::string> known;
                                const std::lock_guard lock{mutex};
                                auto found = std::ranges::find(known, uri);
                                if (found == known.end()) found = known.insert(known.end(), uri);
                                return static_cast<LV2_URID>(found - known.begin() + 1);
                            }};
    return map;
}

/// A host's features, with ours in place of those that it lacks. Valid while the host's list and this object
/// exist; instantiate copies what it keeps.
class Lv2Features {
public:
    explicit Lv2Features(const LV2_Feature* const* hosts) {
        for (auto one = hosts; one && *one; ++one) all_.push_back(*one);
        if (!feature(hosts, LV2_URID__map)) all_.push_back(&map_);
        all_.push_back(&bounded_); // the processor takes longer blocks in parts
        if (!feature(hosts, LV2_OPTIONS__options)) all_.push_back(&options_);
        all_.push_back(nullptr);
        const auto& map = *static_cast<const LV2_URID_Map*>(feature(all_.data(), LV2_URID__map));
        option_[0] = {LV2_OPTIONS_INSTANCE,
                      0,
                      map.map(map.handle, LV2_BUF_SIZE__maxBlockLength),
                      sizeof longest_,
                      map.map(map.handle, LV2_ATOM__Int),
                      &longest_};
    }
    Lv2Features(const Lv2Features&) = delete;
    Lv2Features& operator=(const Lv2Features&) = delete;
    const LV2_Feature* const* all() const noexcept { return all_.data(); }

private:
    const std::int32_t longest_ = limits::maxBlockFrames;
    std::array<LV2_Options_Option, 2> option_{};
    LV2_Feature map_{LV2_URID__map, &fallbackUridMap()}, bounded_{LV2_BUF_SIZE__boundedBlockLength, nullptr},
        options_{LV2_OPTIONS__options, option_.data()};
    std::vector<const LV2_Feature*> all_;
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

/// What names a parameter's value in a block's events, as the host numbers it.
struct Names {
    LV2_URID object = 0, set = 0, subject = 0, property = 0, value = 0, urid = 0, number = 0, plugin = 0;
    LV2_URID text = 0, ports = 0, midi = 0; // of a state; of an event
    std::array<LV2_URID, parameterCount> parameters{};
};

Names namesOf(const LV2_URID_Map& map) {
    const auto idOf = [&map](const std::string& uri) { return map.map(map.handle, uri.c_str()); };
    Names names{idOf(LV2_ATOM__Object),    idOf(LV2_PATCH__Set),
                idOf(LV2_PATCH__subject),  idOf(LV2_PATCH__property),
                idOf(LV2_PATCH__value),    idOf(LV2_ATOM__URID),
                idOf(LV2_ATOM__Float),     idOf(JucePlugin_LV2URI),
                idOf(LV2_ATOM__String),    idOf(JucePlugin_LV2URI ":Ports"),
                idOf(LV2_MIDI__MidiEvent), {}};
    for (std::size_t p = 0; p < parameterCount; ++p)
        names.parameters[p] = idOf(JucePlugin_LV2URI ":" + std::string{allParameters()[p].id});
    return names;
}

/// The events of a block: those that set parameters, and MIDI. R, wait-free.
class Lv2Points final : public PointSource, public NoteSource {
public:
    Lv2Points(const LV2_Atom_Sequence& events, const Names& names, PluginProcessor& processor) noexcept
        : events_{events}
        , names_{names}
        , processor_{processor} {
        at_.fill(lv2_atom_sequence_begin(&events.body));
        processor.expectPoints(*this);
        processor.expectNotes(*this);
    }
    bool next(NoteEvent& note) noexcept override {
        while (!lv2_atom_sequence_is_end(&events_.body, events_.atom.size, midiAt_)) {
            const auto* const event = std::exchange(midiAt_, lv2_atom_sequence_next(midiAt_));
            if (event->body.type != names_.midi || event->body.size < 1 || event->body.size > 3) continue;
            note = {};
            note.frame = static_cast<int>(event->time.frames);
            std::memcpy(note.midi.data(), event + 1, event->body.size);
            note.midi[1] &= 127, note.midi[2] &= 127;
            return true;
        }
        return false;
    }
    bool next(std::size_t parameter, ParameterPoint& point) noexcept override {
        for (auto*& at = at_[parameter]; !lv2_atom_sequence_is_end(&events_.body, events_.atom.size, at);) {
            const auto* const event = std::exchange(at, lv2_atom_sequence_next(at));
            if (sets(*event, parameter, point)) return true;
        }
        return false;
    }
    int lastOfLine(std::size_t) noexcept override { return -1; }

private:
    bool sets(const LV2_Atom_Event& event, std::size_t parameter, ParameterPoint& point) noexcept {
        const auto& object = reinterpret_cast<const LV2_Atom_Object&>(event.body);
        if (event.body.type != names_.object || object.body.otype != names_.set) return false;
        const LV2_Atom *subject = nullptr, *property = nullptr, *value = nullptr;
        LV2_Atom_Object_Query query[]{{names_.subject, &subject},
                                      {names_.property, &property},
                                      {names_.value, &value},
                                      LV2_ATOM_OBJECT_QUERY_END};
        lv2_atom_object_query(&object, query);
        const auto idOf = [this](const LV2_Atom* atom) {
            return atom && atom->type == names_.urid ? reinterpret_cast<const LV2_Atom_URID*>(atom)->body : 0;
        };
        if (subject && idOf(subject) != names_.plugin) return false;
        if (idOf(property) != names_.parameters[parameter] || !value || value->type != names_.number)
            return false;
        point.frame = static_cast<int>(event.time.frames);
        point.normal = processor_.parameter(static_cast<Parameter>(parameter))
                           .convertTo0to1(reinterpret_cast<const LV2_Atom_Float*>(value)->body);
        return true;
    }
    const LV2_Atom_Sequence& events_;
    const Names& names_;
    PluginProcessor& processor_;
    std::array<const LV2_Atom_Event*, parameterCount> at_{};
    const LV2_Atom_Event* midiAt_ = lv2_atom_sequence_begin(&events_.body);
};

// Ports in order: music, channels, and of JUCE's wrapper events, what is told, latency, free-wheeling,
// enabled; then one for each parameter (Lv2Ports.cpp).
constexpr std::uint32_t eventPort = PHYSVIB_MUSIC_PORTS + PHYSVIB_CHANNELS, firstControl = eventPort + 5,
                        enabledPort = firstControl - 1;

/// JUCE tells hosts of parameters as properties, which they would warn of: none is described. R, wait-free.
void dropProperties(LV2_Atom_Sequence& told, const Names& names) noexcept {
    auto* to = lv2_atom_sequence_begin(&told.body);
    for (auto* at = to; !lv2_atom_sequence_is_end(&told.body, told.atom.size, at);) {
        auto* const event = std::exchange(at, lv2_atom_sequence_next(at));
        const auto& object = reinterpret_cast<const LV2_Atom_Object&>(event->body);
        if (event->body.type == names.object && object.body.otype == names.set) continue;
        const auto bytes = reinterpret_cast<std::byte*>(at) - reinterpret_cast<std::byte*>(event);
        std::memmove(to, event, static_cast<std::size_t>(bytes));
        to = reinterpret_cast<LV2_Atom_Event*>(reinterpret_cast<std::byte*>(to) + bytes);
    }
    const auto bytes = reinterpret_cast<std::byte*>(to) - reinterpret_cast<std::byte*>(&told.body);
    told.atom.size = static_cast<std::uint32_t>(bytes);
}

struct Instance {
    PluginProcessor* processor = nullptr;
    bool wasDeactivated = false;
    Names names{};
    const LV2_Atom_Sequence* events = nullptr; // of the port, as connected for this block
    std::shared_ptr<Lv2Controls> controls{};
    LV2_Atom_Sequence* told = nullptr;         // as events
    std::shared_ptr<UnconnectedEvents> sink{}; // for a host that does not connect that
};

/// All that live, by JUCE's handles; a host may make and end them on several threads, and runs them on
/// others. A place is used again, and never freed.
class Instances {
public:
    void add(LV2_Handle handle, const Instance& instance) {
        const std::lock_guard lock{mutex_};
        Place* place = first_;
        while (place && place->handle != nullptr) place = place->next;
        const bool isNew = !place;
        if (isNew) {
            place = new Place;
            place->next = first_;
        }
        place->instance = instance;
        place->handle = handle;
        if (isNew) first_ = place; // from here on it is found
    }
    /// Of one that lives; it stays, and is its caller's: LV2 has one thread at a time for each. Wait-free.
    Instance& operator[](LV2_Handle handle) noexcept {
        Place* place = first_;
        while (place->handle != handle) place = place->next;
        return place->instance;
    }
    void remove(LV2_Handle handle) {
        const std::lock_guard lock{mutex_};
        for (Place* place = first_; place; place = place->next)
            if (place->handle == handle) place->handle = nullptr;
    }

private:
    struct Place {
        std::atomic<LV2_Handle> handle{nullptr};
        Instance instance;
        Place* next = nullptr;
    };
    std::mutex mutex_; // who adds or removes
    std::atomic<Place*> first_{nullptr};
};
Instances& instances() {
    static Instances all;
    return all;
}

int usualBlockOf(const LV2_Feature* const* features) {
    const auto* const map = static_cast<const LV2_URID_Map*>(feature(features, LV2_URID__map));
    const auto* option = static_cast<const LV2_Options_Option*>(feature(features, LV2_OPTIONS__options));
    if (!map || !option) return 0;
    const auto wanted = map->map(map->handle, LV2_BUF_SIZE__nominalBlockLength),
               whole = map->map(map->handle, LV2_ATOM__Int);
    for (; option->key != 0 || option->value != nullptr; ++option)
        if (option->key == wanted && option->type == whole && option->size == sizeof(std::int32_t))
            return *static_cast<const std::int32_t*>(option->value);
    return 0;
}

LV2_Handle instantiate(const LV2_Descriptor*, double rate, const char* bundle,
                       const LV2_Feature* const* hosts) {
    const Lv2Features features{hosts};
    making() = {usualBlockOf(features.all()), nullptr};
    const auto* const juces = juceLv2Descriptor(0);
    const LV2_Handle handle = juces->instantiate(juces, rate, bundle, features.all());
    const auto names = namesOf(*static_cast<const LV2_URID_Map*>(feature(features.all(), LV2_URID__map)));
    auto controls = std::make_shared<Lv2Controls>();
    if (handle)
        instances().add(handle, {making().instance, false, names, nullptr, std::move(controls), nullptr,
                                 std::make_shared<UnconnectedEvents>()});
    return handle;
}

void connect(LV2_Handle handle, std::uint32_t port, void* data) {
    if (port >= firstControl) {
        const auto parameter = port - firstControl;
        if (parameter < parameterCount) instances()[handle].controls->connect(parameter, data);
        return;
    }
    if (port == enabledPort) { // JUCE's own bypass stays open: ours is the only one
        static float isOn = 1.0f;
        instances()[handle].controls->connect(Lv2Controls::enabled, data);
        data = &isOn;
    }
    if (port == eventPort) instances()[handle].events = static_cast<const LV2_Atom_Sequence*>(data);
    if (port == eventPort + 1) instances()[handle].told = static_cast<LV2_Atom_Sequence*>(data);
    juceLv2Descriptor(0)->connect_port(handle, port, data);
}

void run(LV2_Handle handle, std::uint32_t frames) {
    auto& instance = instances()[handle];
    const auto* const juces = juceLv2Descriptor(0);
    instance.controls->read(*instance.processor);
    if (!instance.told) juces->connect_port(handle, eventPort + 1, instance.sink->empty());
    if (!instance.events) return juces->run(handle, frames);
    Lv2Points points{*instance.events, instance.names, *instance.processor};
    juces->run(handle, frames);
    if (instance.told) dropProperties(*instance.told, instance.names);
}

// What is active is prepared, at first by JUCE: the scene starts at its seed, as in the other formats.
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
    const auto& names = instance.names;
    const std::string ports = instance.controls->text();
    constexpr auto kind = LV2_STATE_IS_POD | LV2_STATE_IS_PORTABLE;
    store(host, names.ports, ports.c_str(), ports.size() + 1, names.text, kind);
    return juceState().save(handle, store, host, flags, features);
}

LV2_State_Status restore(LV2_Handle handle, LV2_State_Retrieve_Function retrieve, LV2_State_Handle host,
                         std::uint32_t flags, const LV2_Feature* const* features) {
    const auto status = juceState().restore(handle, retrieve, host, flags, features);
    const auto& instance = instances()[handle];
    std::size_t size = 0;
    std::uint32_t type = 0, kind = 0;
    const void* const ports = retrieve(host, instance.names.ports, &size, &type, &kind);
    if (!ports || type != instance.names.text) return status;
    instance.controls->restore({static_cast<const char*>(ports), size});
    return status;
}

const void* extension(const char* uri) {
    static constexpr LV2_State_Interface state{save, restore};
    return std::strcmp(uri, LV2_STATE__interface) == 0 ? &state : juceLv2Descriptor(0)->extension_data(uri);
}

LV2_Descriptor completed(LV2_Descriptor juces) {
    juces.instantiate = instantiate;
    juces.connect_port = connect;
    juces.run = run;
    juces.activate = activate;
    juces.deactivate = deactivate;
    juces.cleanup = cleanup;
    juces.extension_data = extension;
    return juces;
}

} // namespace

Lv2Parts lv2PartsOf(void* instance) noexcept {
    const auto& one = instances()[instance];
    return {one.processor, one.controls, firstControl};
}

} // namespace physvib

LV2_SYMBOL_EXPORT const LV2_Descriptor* lv2_descriptor(uint32_t index) {
    static const LV2_Descriptor ours = physvib::completed(*juceLv2Descriptor(0));
    return index == 0 ? &ours : nullptr;
}
#endif
