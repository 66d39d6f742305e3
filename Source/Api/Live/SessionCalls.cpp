// SPDX-License-Identifier: MIT
// The session functions of physvib-live.h: load, create from events, query, save, render.
#include "Api/Live/LiveRig.h"
#include "Io/Disk/AtomicFile.h"
#include "Live/Documents/SessionFile.h"
#include "Live/Recordings/LoadRecordings.h"
#include "Live/Session/SessionRender.h"
#include <algorithm>
#include <cstring>

using namespace physvib;
using namespace physvib::api;

namespace {

HandleTable<const SavedSession, sessionKind>& sessions() {
    static auto* const table = new HandleTable<const SavedSession, sessionKind>; // threads may outlive main
    return *table;
}

/// Calls `call(session)`, or returns the error for an unknown handle.
template <class Call>
auto withSession(physvib_session handle, Call call) noexcept
    -> decltype(call(std::declval<const SavedSession&>())) {
    return catchExceptions([&]() -> decltype(call(std::declval<const SavedSession&>())) {
        const auto session = sessions().borrow(reinterpret_cast<std::uintptr_t>(handle));
        if (!session) return unknownHandleError();
        return call(*session);
    });
}

int addSession(SavedSession created, physvib_session* session) {
    const std::uintptr_t number = sessions().add(std::make_unique<const SavedSession>(std::move(created)));
    if (number == 0) return fail(PHYSVIB_ERROR_FULL, "sessions: expected at most 256");
    *session = reinterpret_cast<physvib_session>(number);
    return PHYSVIB_OK;
}

// The limit is a day, because the session's worlds have to be simulated.
bool isAtMostADay(physvib_int64 ns) noexcept { return ns >= 0 && ns <= 86'400'000'000'000; }

/// A session needs a scene; this one has no bodies.
SceneRun emptySceneRun() {
    Scene scene;
    scene.name = "strikes";
    scene.fieldWidthMetres = scene.fieldHeightMetres = 1.0;
    SceneRun run;
    run.scene = std::make_shared<const Scene>(std::move(scene));
    return run;
}

} // namespace

int physvib_session_load(const char* path, physvib_session* session) {
    return catchExceptions([&] {
        if (path == nullptr || session == nullptr)
            return argumentError("session: expected a path and a place for it, found NULL");
        *session = nullptr;
        auto loaded = loadSession(path);
        return loaded ? addSession(std::move(loaded.value), session) : fail(PHYSVIB_ERROR_FILE, loaded.error);
    });
}

int physvib_session_create(const physvib_renderer_settings* renderer, const physvib_event* events,
                           physvib_int64 count, physvib_int64 lengthNs, physvib_session* session) {
    return catchExceptions([&] {
        if (session == nullptr || count < 0 || (count > 0 && events == nullptr))
            return argumentError("session: expected events and a place for it, found NULL");
        *session = nullptr;
        RendererSettings checked;
        if (!readLiveRenderer(renderer, checked)) return PHYSVIB_ERROR_ARGUMENT;
        std::vector<CollisionEvent> converted;
        if (const auto error = readSorted(events, count, converted); !error.empty())
            return argumentError(error);
        if (!isAtMostADay(lengthNs)) return argumentError("length: expected nothing to a day");
        SavedSession created;
        created.panner = checked.panner;
        created.channels = checked.outputs();
        created.limiterEnabled = checked.limiterEnabled;
        created.lengthNs = lengthNs;
        created.log.runs.push_back(emptySceneRun());
        created.log.strikes.assign(converted.begin(), converted.end());
        return addSession(std::move(created), session);
    });
}

int physvib_session_free(physvib_session session) {
    return sessions().remove(reinterpret_cast<std::uintptr_t>(session)) ? PHYSVIB_OK : unknownHandleError();
}

int physvib_session_save(physvib_session handle, const char* path) {
    return withSession(handle, [&](const SavedSession& session) {
        if (path == nullptr) return argumentError("session: expected a path, found NULL");
        const std::string text = sessionJson(session, std::filesystem::path{path}.parent_path());
        // refuses to write a file that could not be loaded
        if (const auto reread = readSession(text, path); !reread) return argumentError(reread.error);
        return codeFromError(writeFile(path, text), PHYSVIB_ERROR_FILE);
    });
}

physvib_int64 physvib_session_length_ns(physvib_session handle) {
    return withSession(handle, [](const SavedSession& session) -> physvib_int64 { return session.lengthNs; });
}

int physvib_session_get_renderer(physvib_session handle, physvib_renderer_settings* renderer) {
    return withSession(handle, [&](const SavedSession& session) {
        physvib_renderer_settings result;
        if (!readStruct<physvib_renderer_settings>(renderer, result, physvib_renderer_settings_init))
            return PHYSVIB_ERROR_ARGUMENT;
        result.size = renderer->size;
        result.channels = session.channels;
        result.limiter = session.limiterEnabled ? 1 : 0;
        if (const int code = writePanner(session.panner, result); code != PHYSVIB_OK) return code;
        std::memcpy(renderer, &result, result.size);
        return PHYSVIB_OK;
    });
}

physvib_int64 physvib_session_events(physvib_session handle, physvib_int64 endNs, physvib_event* events,
                                     physvib_int64 capacity) {
    return withSession(handle, [&](const SavedSession& session) -> physvib_int64 {
        if (capacity < 0 || (capacity > 0 && events == nullptr))
            return argumentError("events: expected a place for them");
        if (!isAtMostADay(endNs)) return argumentError("end: expected nothing to a day");
        auto shaped = sessionEvents(session, endNs).events;
        EventShaper{session.shaping}.shape(shaped);
        const std::int64_t written = writeEvents(shaped, events, capacity);
        return written < 0 ? written : std::ssize(shaped);
    });
}

int physvib_session_render(physvib_session handle, int rateHz, physvib_int64 frames, float* samples) {
    return withSession(handle, [&](const SavedSession& session) {
        if (!isSampleRate(rateHz)) return argumentError("rate: expected 5000 to 192000 Hz");
        if (frames < 0 || frames > rateHz * std::int64_t{86400} || (frames > 0 && samples == nullptr))
            return argumentError("render: expected a place for at most a day of samples");
        const auto recordings = loadRecordings(session.log);
        if (!recordings) return fail(PHYSVIB_ERROR_FILE, recordings.error);
        std::int64_t done = 0;
        const auto writeBlock = [&](const float* const* block, int n) {
            for (int j = 0; j < session.channels; ++j) std::copy_n(block[j], n, samples + j * frames + done);
            done += n;
            return true;
        };
        const SessionExtent extent{rateHz, static_cast<double>(frames) / rateHz, [](double) { return true; }};
        renderSession(session, recordings.value, extent, writeBlock);
        return PHYSVIB_OK;
    });
}
