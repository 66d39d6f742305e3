// SPDX-License-Identifier: MIT
// The session functions of physvib-live.h: load, create from events, save, render.
#include "Api/Live/Lives.h"
#include "Io/Disk/AtomicFile.h"
#include "Live/Documents/SessionFile.h"
#include "Live/Recordings/LoadRecordings.h"
#include "Live/Session/SessionRender.h"
#include <algorithm>
#include <cstring>

using namespace physvib;
using namespace physvib::api;

namespace {

Handles<const SavedSession, 4>& sessions() {
    static auto* const all = new Handles<const SavedSession, 4>; // never destroyed: threads may outlive main
    return *all;
}

/// Calls `call(session)`, or returns the error for an unknown handle.
template <class Call>
auto of(physvib_session name, Call call) noexcept -> decltype(call(std::declval<const SavedSession&>())) {
    return guarded([&]() -> decltype(call(std::declval<const SavedSession&>())) {
        const auto session = sessions().use(reinterpret_cast<std::uintptr_t>(name));
        if (!session) return unknownHandle();
        return call(*session);
    });
}

int keep(SavedSession made, physvib_session* session) {
    const std::uintptr_t name = sessions().add(std::make_unique<const SavedSession>(std::move(made)));
    if (name == 0) return fail(PHYSVIB_ERROR_FULL, "sessions: expected at most 256");
    *session = reinterpret_cast<physvib_session>(name);
    return PHYSVIB_OK;
}

// The limit is a day, because the session's worlds have to be simulated.
bool isWithinADay(physvib_int64 ns) noexcept { return ns >= 0 && ns <= 86'400'000'000'000; }

/// A scene run of an empty world, because a session needs one.
SceneRun emptyTake() {
    Scene scene;
    scene.name = "strikes";
    scene.fieldWidthMetres = scene.fieldHeightMetres = 1.0;
    SceneRun take;
    take.scene = std::make_shared<const Scene>(std::move(scene));
    return take;
}

} // namespace

int physvib_session_load(const char* path, physvib_session* session) {
    return guarded([&] {
        if (path == nullptr || session == nullptr)
            return nothingThere("session: expected a path and a place for it, found NULL");
        *session = nullptr;
        auto loaded = loadSession(path);
        return loaded ? keep(std::move(loaded.value), session) : fail(PHYSVIB_ERROR_FILE, loaded.error);
    });
}

int physvib_session_create(const physvib_renderer_settings* renderer, const physvib_event* events,
                           physvib_int64 count, physvib_int64 lengthNs, physvib_session* session) {
    return guarded([&] {
        if (session == nullptr || count < 0 || (count > 0 && events == nullptr))
            return nothingThere("session: expected events and a place for it, found NULL");
        *session = nullptr;
        RendererSettings wanted;
        if (!takeRenderer(renderer, wanted)) return PHYSVIB_ERROR_ARGUMENT;
        std::vector<CollisionEvent> own;
        if (const auto fault = readSorted(events, count, own); !fault.empty()) return nothingThere(fault);
        if (!isWithinADay(lengthNs)) return nothingThere("length: expected nothing to a day");
        SavedSession made;
        made.panner = wanted.panner;
        made.channels = wanted.outputs();
        made.limiterEnabled = wanted.limiterEnabled;
        made.lengthNs = lengthNs;
        made.log.takes.push_back(emptyTake());
        made.log.strikes.assign(own.begin(), own.end());
        return keep(std::move(made), session);
    });
}

int physvib_session_free(physvib_session session) {
    return sessions().remove(reinterpret_cast<std::uintptr_t>(session)) ? PHYSVIB_OK : unknownHandle();
}

int physvib_session_save(physvib_session name, const char* path) {
    return of(name, [&](const SavedSession& session) {
        if (path == nullptr) return nothingThere("session: expected a path, found NULL");
        const std::string text = sessionJson(session, std::filesystem::path{path}.parent_path());
        // refuses to write a file that could not be loaded
        if (const auto again = readSession(text, path); !again)
            return fail(PHYSVIB_ERROR_ARGUMENT, again.error);
        return resultOf(writeFile(path, text), PHYSVIB_ERROR_FILE);
    });
}

physvib_int64 physvib_session_length_ns(physvib_session name) {
    return of(name, [](const SavedSession& session) -> physvib_int64 { return session.lengthNs; });
}

int physvib_session_get_renderer(physvib_session name, physvib_renderer_settings* renderer) {
    return of(name, [&](const SavedSession& session) {
        physvib_renderer_settings told;
        if (!take<physvib_renderer_settings>(renderer, told, physvib_renderer_settings_init))
            return PHYSVIB_ERROR_ARGUMENT;
        told.size = renderer->size;
        told.channels = session.channels;
        told.limiter = session.limiterEnabled ? 1 : 0;
        told.law = static_cast<int>(session.panner.requestedLaw()); // which is the law, unless parts choose
        told.exponent = session.panner.exponent();
        told.field_width_m = session.panner.fieldWidthMetres();
        told.field_height_m = session.panner.fieldHeightMetres();
        if (const int code = writeLayout(session.panner.layout(), told.layout); code != PHYSVIB_OK)
            return code;
        std::memcpy(renderer, &told, told.size);
        return PHYSVIB_OK;
    });
}

physvib_int64 physvib_session_events(physvib_session name, physvib_int64 endNs, physvib_event* events,
                                     physvib_int64 capacity) {
    return of(name, [&](const SavedSession& session) -> physvib_int64 {
        if (capacity < 0 || (capacity > 0 && events == nullptr))
            return nothingThere("events: expected a place for them");
        if (!isWithinADay(endNs)) return nothingThere("end: expected nothing to a day");
        auto all = sessionEvents(session, endNs).events;
        EventShaper{session.shaping}.shape(all);
        const std::int64_t written = writeEvents(all, events, capacity);
        return written < 0 ? written : std::ssize(all);
    });
}

int physvib_session_render(physvib_session name, int rateHz, physvib_int64 frames, float* samples) {
    return of(name, [&](const SavedSession& session) {
        if (!isSampleRate(rateHz)) return nothingThere("rate: expected 5000 to 192000 Hz");
        if (frames < 0 || frames > rateHz * std::int64_t{86400} || (frames > 0 && samples == nullptr))
            return nothingThere("render: expected a place for at most a day of samples");
        const auto recordings = loadRecordings(session.log);
        if (!recordings) return fail(PHYSVIB_ERROR_FILE, recordings.error);
        std::int64_t done = 0;
        const auto take = [&](const float* const* block, int n) {
            for (int j = 0; j < session.channels; ++j) std::copy_n(block[j], n, samples + j * frames + done);
            done += n;
            return true;
        };
        const SessionExtent extent{rateHz, static_cast<double>(frames) / rateHz, [](double) { return true; }};
        renderSession(session, recordings.value, extent, take);
        return PHYSVIB_OK;
    });
}
