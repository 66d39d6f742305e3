// SPDX-License-Identifier: MIT
// C functions for version, errors, defaults, layouts, event lists, WAV files and offline rendering.
#include "Api/C/Calls.h"
#include "Contacts/Grains.h"
#include "Core/HapticRenderer.h"
#include "Io/Disk/AtomicFile.h"
#include "Io/Text/NameList.h"
#include "Io/Wav/WavSink.h"
#include "Scene/EventsCsv.h"
#include "Scene/LayoutFile.h"
#include "Scene/PartNames.h"
#include <algorithm>
#include <cmath>
#include <memory>
#include <physvib/Version.h>
#include <span>
#include <vector>

using namespace physvib;
using namespace physvib::api;

static_assert(PHYSVIB_MAX_ENCHANTERS == limits::maxActuators);

namespace {

int codeFromFileError(const std::string& error) noexcept { return codeFromError(error, PHYSVIB_ERROR_FILE); }

/// A list of events as the source of a renderer.
struct EventListSource {
    std::span<const CollisionEvent> events;
    bool pop(CollisionEvent& event) noexcept {
        if (events.empty()) return false;
        event = events.front();
        events = events.subspan(1);
        return true;
    }
};

/// Writes as many events of `list` as fit; returns the length of the list, or an error.
physvib_int64 writeAndCount(physvib_event* events, physvib_int64 capacity,
                            const std::vector<CollisionEvent>& list) {
    const physvib_int64 written = writeEvents(list, events, capacity);
    return written < 0 ? written : std::ssize(list);
}

int readFieldSize(const char* source, auto readList, int errorCode, double* width, double* height) {
    if (!source || !width || !height)
        return argumentError("events: expected a list and places for its field, found NULL");
    const Result<EventList> list = readList(source);
    if (!list) return fail(errorCode, list.error);
    *width = list.value.field.widthMetres;
    *height = list.value.field.heightMetres;
    return PHYSVIB_OK;
}

} // namespace

const char* physvib_version(void) { return PHYSVIB_VERSION; }
const char* physvib_law_name(int law) {
    return law < 0 || law >= static_cast<int>(panningLaws.size())
               ? nullptr
               : panningLaws[static_cast<std::size_t>(law)].name.data();
}
const char* physvib_error(void) { return errorBuffer().data(); }

int physvib_renderer_settings_init(physvib_renderer_settings* settings, size_t size) {
    auto values = zeroed<physvib_renderer_settings>();
    values.rate_hz = 48000;
    values.law = PHYSVIB_LAW_AUTO;
    values.limiter = 1;
    values.exponent = 1.0;
    values.layout.size = sizeof values.layout;
    physvib_layout_preset("phone4", &values.layout);
    // The layout is the last member, so it may use the rest of the caller's structure.
    constexpr std::size_t layoutOffset = offsetof(physvib_renderer_settings, layout);
    static_assert(layoutOffset + sizeof values.layout == sizeof values);
    values.layout.size = std::min(std::max(size, layoutOffset) - layoutOffset, sizeof values.layout);
    return writeStruct(settings, size, values);
}

int physvib_renderer_status_init(physvib_renderer_status* status, size_t size) {
    return writeStruct(status, size, zeroed<physvib_renderer_status>());
}

int physvib_world_settings_init(physvib_world_settings* settings, size_t size) {
    auto values = zeroed<physvib_world_settings>();
    values.hits_per_step = -1;
    values.field_width_m = values.drive_gain = 1.0;
    values.normalisation_s_per_m = values.hand_mass_kg = PHYSVIB_UNKNOWN;
    values.threshold_m_per_s = 0.15;
    return writeStruct(settings, size, values);
}

int physvib_body_init(physvib_body* body, size_t size) {
    auto values = zeroed<physvib_body>();
    values.gravity_scale = values.gain = 1.0;
    values.hand_mass_kg = PHYSVIB_UNKNOWN;
    for (double& amplitude : values.overtone_amplitude) amplitude = 1.0;
    values.roughness = Texture{}.roughness;
    values.rolling = Texture{}.rolling;
    return writeStruct(body, size, values);
}

int physvib_contact_init(physvib_contact* contact, size_t size) {
    auto values = zeroed<physvib_contact>();
    values.a = values.b = -1;
    values.normal_y = 1.0;
    values.impulse_n_s = values.approach_m_per_s = values.effective_mass_kg = values.fraction =
        values.along_a_m_per_s = values.along_b_m_per_s = PHYSVIB_UNKNOWN;
    values.point_id = PHYSVIB_POINT_NONE;
    return writeStruct(contact, size, values);
}

int physvib_world_counts_init(physvib_world_counts* counts, size_t size) {
    return writeStruct(counts, size, zeroed<physvib_world_counts>());
}

int physvib_event_init(physvib_event* event, size_t size) { return writeStruct(event, size, defaultEvent()); }

int physvib_layout_init(physvib_layout* layout, size_t size) {
    return writeStruct(layout, size, zeroed<physvib_layout>());
}

int physvib_layout_preset(const char* name, physvib_layout* layout) {
    ActuatorLayout preset;
    if (name == nullptr || layout == nullptr)
        return argumentError("layout: expected a name and a place for it, found NULL");
    return catchExceptions([&] {
        if (!layoutPreset(name, preset))
            return argumentError("layout: expected " + rangeList(layoutPresetNames, " to ", " or "));
        return writeLayout(preset, *layout);
    });
}

int physvib_part(const char* name) {
    if (name == nullptr || *name == '\0') return argumentError("part: expected a name");
    return toPartNumber(name);
}

int physvib_layout_load(const char* path, physvib_layout* layout) {
    return catchExceptions([&] {
        if (path == nullptr || layout == nullptr)
            return argumentError("layout: expected a path and a place for it, found NULL");
        const auto loaded = loadLayout(path);
        if (!loaded) return fail(PHYSVIB_ERROR_FILE, loaded.error);
        return writeLayout(loaded.value.geometry, *layout);
    });
}

int physvib_layout_parse(const char* text, physvib_layout* layout) {
    return catchExceptions([&] {
        if (text == nullptr || layout == nullptr)
            return argumentError("layout: expected a text and a place for it, found NULL");
        const auto read = readLayout(text, "layout");
        if (!read) return argumentError(read.error);
        return writeLayout(read.value.geometry, *layout);
    });
}

int physvib_layout_save(const char* path, const char* name, const physvib_layout* layout) {
    return catchExceptions([&] {
        if (path == nullptr || name == nullptr || layout == nullptr)
            return argumentError("layout: expected a path, a name and a layout, found NULL");
        ActuatorLayout geometry;
        if (const auto error = convert(*layout, geometry); !error.empty()) return argumentError(error);
        const std::string text = layoutJson(describeLayout(name, geometry));
        // refuses to write a file that could not be loaded
        if (const auto reread = readLayout(text, "layout"); !reread) return argumentError(reread.error);
        return codeFromFileError(writeFile(path, text));
    });
}

physvib_int64 physvib_events_load(const char* path, physvib_event* events, physvib_int64 capacity) {
    return catchExceptions([&]() -> physvib_int64 {
        if (path == nullptr || capacity < 0 || (capacity > 0 && events == nullptr))
            return argumentError("events: expected a path and a place for them");
        const auto loaded = loadEventsCsv(path);
        if (!loaded) return fail(PHYSVIB_ERROR_FILE, loaded.error);
        return writeAndCount(events, capacity, loaded.value.events);
    });
}

physvib_int64 physvib_events_parse(const char* text, physvib_event* events, physvib_int64 capacity) {
    return catchExceptions([&]() -> physvib_int64 {
        if (text == nullptr || capacity < 0 || (capacity > 0 && events == nullptr))
            return argumentError("events: expected a text and a place for them");
        const auto read = readEventsCsv(text, "events");
        if (!read) return argumentError(read.error);
        return writeAndCount(events, capacity, read.value.events);
    });
}

int physvib_events_load_field(const char* path, double* width, double* height) {
    return catchExceptions(
        [&] { return readFieldSize(path, loadEventsCsv, PHYSVIB_ERROR_FILE, width, height); });
}

int physvib_events_parse_field(const char* text, double* width, double* height) {
    const auto read = [](const char* from) { return readEventsCsv(from, "events"); };
    return catchExceptions([&] { return readFieldSize(text, read, PHYSVIB_ERROR_ARGUMENT, width, height); });
}

int physvib_events_save(const char* path, const physvib_event* events, physvib_int64 count) {
    return physvib_events_save_field(path, events, count, 0.0, 0.0);
}

int physvib_events_save_field(const char* path, const physvib_event* events, physvib_int64 count,
                              double width, double height) {
    return catchExceptions([&] {
        if (path == nullptr || events == nullptr || count < 1)
            return argumentError("events: expected a path and at least one event");
        if (count > std::int64_t{limits::maxEventRows})
            return argumentError("events: expected at most " + std::to_string(limits::maxEventRows));
        const FieldSize field{width, height};
        if (!(field == FieldSize{}) && !isValidField(field))
            return argumentError("field: expected 0.001 to 1e6 m, or 0 and 0");
        std::vector<CollisionEvent> converted;
        if (const auto error = readSorted(events, count, converted); !error.empty())
            return argumentError(error);
        return codeFromFileError(writeFile(path, eventsCsv(converted, field, {PHYSVIB_VERSION, {}})));
    });
}

int physvib_wav_save(const char* path, const float* samples, int channels, physvib_int64 frames, int rateHz) {
    return catchExceptions([&] {
        if (path == nullptr || samples == nullptr)
            return argumentError("sound: expected a path and samples, found NULL");
        if (channels < 1 || channels > limits::maxActuators || !isSampleRate(rateHz) || frames < 1 ||
            !fitsWav(channels, frames))
            return argumentError("sound: expected 1 to 64 channels, 5000 to 192000 Hz, and a frame or "
                                 "more, of less than 4 GB");
        const std::span all{samples, static_cast<std::size_t>(channels * frames)};
        if (const auto nonFinite = std::ranges::find_if_not(all, [](float x) { return std::isfinite(x); });
            nonFinite != all.end())
            return argumentError("sound: expected finite samples, found NaN or infinity in frame " +
                                 std::to_string((nonFinite - all.begin()) % frames) + " of channel " +
                                 std::to_string((nonFinite - all.begin()) / frames));
        WavSink file{path, channels, rateHz};
        std::vector<const float*> block(static_cast<std::size_t>(channels));
        for (physvib_int64 from = 0; from < frames && file.error().empty(); from += limits::maxBlockFrames) {
            for (int j = 0; j < channels; ++j)
                block[static_cast<std::size_t>(j)] = samples + j * frames + from;
            file.write(block.data(),
                       static_cast<int>(std::min<physvib_int64>(frames - from, limits::maxBlockFrames)));
        }
        return codeFromFileError(file.finish());
    });
}

int physvib_render(const physvib_renderer_settings* settings, const physvib_event* events,
                   physvib_int64 count, physvib_int64 frames, float* samples) {
    return catchExceptions([&] {
        RendererSettings checked;
        if (!readRenderer(settings, checked)) return PHYSVIB_ERROR_ARGUMENT;
        if (count < 0 || (count > 0 && events == nullptr) || frames < 0 || (frames > 0 && samples == nullptr))
            return argumentError("render: expected events and a place for samples");
        std::vector<CollisionEvent> converted;
        if (const auto error = readSorted(events, count, converted); !error.empty())
            return argumentError(error);
        EventListSource source{converted};
        const auto renderer = std::make_unique<HapticRenderer>();
        if (!renderer->prepare(checked)) return argumentError("settings: expected some that can be rendered");
        constexpr int blockFrames = 256;
        const int channels = checked.outputs();
        std::vector<float> buffer(static_cast<std::size_t>(channels * blockFrames));
        std::vector<float*> out;
        for (int j = 0; j < channels; ++j) out.push_back(buffer.data() + j * blockFrames);
        std::int64_t doneFrames = 0;
        renderFromStart(*renderer, source, out.data(), channels, frames, blockFrames,
                        [&](const float* const* block, int n) {
                            for (int j = 0; j < channels; ++j)
                                std::copy_n(block[j], n, samples + j * frames + doneFrames);
                            doneFrames += n;
                            return true;
                        });
        return PHYSVIB_OK;
    });
}
