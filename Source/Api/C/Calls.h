// SPDX-License-Identifier: MIT
// Shared by all C functions: error codes and the error text, versioned structures, and conversions between
// the structures of physvib.h and the types of the engine.
#pragma once
#include "Api/C/physvib.h"
#include "Core/CollisionEvent.h"
#include "Core/HapticRenderer.h"
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <exception>
#include <new>
#include <optional>
#include <span>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace physvib::api {
/// Buffer of this thread's error text, which physvib_error() returns.
inline std::array<char, 640>& errorBuffer() noexcept {
    thread_local std::array<char, 640> message{};
    return message;
}

/// Sets the error text of this thread and returns `code`. Any thread but R.
inline int fail(int code, std::string_view message) noexcept {
    auto& buffer = errorBuffer();
    const std::size_t length = std::min(message.size(), buffer.size() - 1);
    std::copy_n(message.data(), length, buffer.data());
    buffer[length] = '\0';
    return code;
}

inline int unknownHandleError() noexcept {
    return fail(PHYSVIB_ERROR_HANDLE, "handle: expected one of this kind that has not been freed");
}
inline int argumentError(std::string_view message) noexcept { return fail(PHYSVIB_ERROR_ARGUMENT, message); }

/// PHYSVIB_OK for an empty `error`, otherwise an error with that text.
inline int codeFromError(std::string_view error, int code = PHYSVIB_ERROR_ARGUMENT) noexcept {
    return error.empty() ? PHYSVIB_OK : fail(code, error);
}

/// Returns the result of `call`, a code or a count; an exception becomes an error code.
template <class Call>
auto catchExceptions(Call call) noexcept -> decltype(call()) {
    try {
        return call();
    } catch (const std::bad_alloc&) {
        return fail(PHYSVIB_ERROR_MEMORY, "memory: expected more of it");
    } catch (const std::length_error&) {
        return fail(PHYSVIB_ERROR_MEMORY, "memory: expected more of it");
    } catch (const std::invalid_argument& error) {
        return fail(PHYSVIB_ERROR_ARGUMENT, error.what());
    } catch (const std::exception& error) {
        return fail(PHYSVIB_ERROR_INTERNAL, error.what());
    } catch (...) {
        return fail(PHYSVIB_ERROR_INTERNAL, "unknown");
    }
}

/// A structure of zeros, with zero padding because other languages may read it.
template <class Struct>
Struct zeroed() noexcept {
    Struct values;
    std::memset(&values, 0, sizeof values);
    return values;
}

/// An event with the values of physvib_event_init.
inline physvib_event defaultEvent() noexcept {
    auto event = zeroed<physvib_event>();
    event.size = sizeof event;
    event.fixture = event.other = -1;
    return event;
}

/// Copies as much of `values` as the caller's version of the structure holds; returns PHYSVIB_OK or an error.
template <class Struct>
int writeStruct(Struct* to, std::size_t size, const Struct& values) noexcept {
    if (to == nullptr) return argumentError("structure: expected one, found NULL");
    if (size < sizeof size || size > sizeof values)
        return argumentError("structure: expected its size, and a library that is as new as the header");
    std::memcpy(to, &values, size);
    to->size = size;
    return PHYSVIB_OK;
}

/// Reads the caller's structure. Members that an older version lacks keep the values of its init function.
/// Sets the error and returns false if the size is invalid.
template <class Struct>
bool readStruct(const Struct* from, Struct& to, int (*init)(Struct*, std::size_t)) noexcept {
    init(&to, sizeof to);
    if (from == nullptr) return argumentError("structure: expected one, found NULL"), false;
    std::size_t size = 0;
    std::memcpy(&size, from, sizeof size);
    if (size < sizeof size || size > sizeof to)
        return argumentError("structure: expected one that its _init has filled"), false;
    std::memcpy(&to, from, size);
    to.size = sizeof to;
    return true;
}

/// The size in bytes that a caller's event or layout states, or 0 if this library does not know it. A stated
/// size of 0 is refused: it does not say how far the events of a list are apart.
template <class Struct>
std::size_t validSize(const void* from) noexcept {
    std::size_t size = 0;
    std::memcpy(&size, from, sizeof size);
    return size >= sizeof size && size <= sizeof(Struct) ? size : 0;
}

inline CollisionEvent toCollisionEvent(const physvib_event& e) noexcept {
    const ContactKind kind = e.kind == PHYSVIB_ROLL    ? ContactKind::roll
                             : e.kind == PHYSVIB_SLIDE ? ContactKind::slide
                                                       : ContactKind::hit;
    return {e.time_ns,
            e.frequency_hz,
            e.decay_per_s,
            e.amplitude,
            e.x_m,
            e.y_m,
            e.duration_ns,
            {e.fixture, e.other, e.impulse_n_s, e.mass_kg, kind, e.part},
            {},
            Spread::layout,
            e.sound,
            e.z_m};
}
static_assert(PHYSVIB_HIT == static_cast<int>(ContactKind::hit) &&
              PHYSVIB_ROLL == static_cast<int>(ContactKind::roll) &&
              PHYSVIB_SLIDE == static_cast<int>(ContactKind::slide));

inline physvib_event toPhysvibEvent(const CollisionEvent& e) noexcept {
    physvib_event to = defaultEvent();
    to.time_ns = e.timeNs;
    to.duration_ns = e.durationNs;
    to.frequency_hz = e.frequencyHz;
    to.decay_per_s = e.decayPerSecond;
    to.amplitude = e.amplitude;
    to.x_m = e.x;
    to.y_m = e.y;
    to.impulse_n_s = e.source.impulseNewtonSeconds;
    to.mass_kg = e.source.massKg;
    to.fixture = e.source.fixture;
    to.other = e.source.other;
    to.kind = static_cast<int>(e.source.kind);
    to.sound = e.sound;
    to.z_m = e.z;
    to.part = e.source.part;
    return to;
}

/// Counts are without sign in C++.
inline physvib_int64 toInt64(std::uint64_t count) noexcept { return static_cast<physvib_int64>(count); }

inline std::optional<double> toOptional(double value) noexcept {
    return value == PHYSVIB_UNKNOWN ? std::nullopt : std::optional{value};
}

/// Converts and checks settings; returns empty, or what is wrong and what was expected.
std::string_view convert(const physvib_renderer_settings& from, RendererSettings& to) noexcept;
std::string_view convert(const physvib_layout& from, ActuatorLayout& to) noexcept;

/// Reads the caller's settings of a renderer. Sets the error and returns false if they are invalid.
bool readRenderer(const physvib_renderer_settings* from, RendererSettings& to) noexcept;

/// Writes as much of a layout as the caller's `to` has; returns PHYSVIB_OK, or sets the error.
int writeLayout(const ActuatorLayout& from, physvib_layout& to) noexcept;

// Only these functions access lists of events: the caller's header decides how large its events are.

/// Converts an event; returns empty, or why it cannot be played.
std::string_view readEvent(const physvib_event& from, CollisionEvent& to) noexcept;
/// Converts a list; returns empty, or why an event cannot be played and `to` is unchanged.
std::string_view readEvents(const physvib_event* from, std::int64_t count, std::vector<CollisionEvent>& to);
/// As readEvents(), but also refuses a list that is not sorted by time.
std::string_view readSorted(const physvib_event* from, std::int64_t count, std::vector<CollisionEvent>& to);

/// Writes the first `capacity` events of a list; returns how many, or sets the error and returns it.
std::int64_t writeEvents(std::span<const CollisionEvent> from, physvib_event* to,
                         std::int64_t capacity) noexcept;

} // namespace physvib::api
