// SPDX-License-Identifier: MIT
// Passes all motions and contacts of a step to the world in one call, as the list of numbers that
// package/journal.js writes. A step may have thousands, so the structures of physvib.h would be too slow.
#include "Api/C/Calls.h"
#include "Api/C/HandleObjects.h"
#include "Api/JavaScript/Exports.h"
#include <optional>

namespace physvib::js {

namespace {

constexpr double absentValue = -2.0e300; // written by journal.js for a member with its default

Vector3 toVector(const double* xyz) noexcept {
    return {static_cast<float>(xyz[0]), static_cast<float>(xyz[1]), static_cast<float>(xyz[2])};
}
double valueOr(double value, double fallback) noexcept { return value == absentValue ? fallback : value; }
std::optional<double> readOptional(double value) noexcept {
    return api::toOptional(valueOr(value, PHYSVIB_UNKNOWN));
}

/// Reads an entry from the numbers of both bodies on, in the order of journal.js.
FedContact readContact(const double* data) noexcept {
    FedContact contact;
    contact.a = static_cast<int>(data[0]);
    contact.b = static_cast<int>(data[1]);
    contact.point = {static_cast<float>(valueOr(data[2], 0.0)), static_cast<float>(valueOr(data[3], 0.0)),
                     static_cast<float>(valueOr(data[4], 0.0))};
    contact.normal = {static_cast<float>(valueOr(data[5], 0.0)), static_cast<float>(valueOr(data[6], 1.0)),
                      static_cast<float>(valueOr(data[7], 0.0))};
    contact.impulseNewtonSeconds = readOptional(data[8]);
    contact.approachMetresPerSecond = readOptional(data[9]);
    contact.restitution = valueOr(data[10], 0.0);
    contact.fraction = readOptional(data[11]);
    contact.gapMetres = valueOr(data[12], 0.0);
    contact.gapFraction = valueOr(data[13], 0.0);
    contact.alongAMetresPerSecond = readOptional(data[14]);
    contact.alongBMetresPerSecond = readOptional(data[15]);
    const int softness = static_cast<int>(valueOr(data[16], 0.0));
    contact.isSoft = softness != 0;
    contact.isPushWhole = softness == PHYSVIB_SOFT_WHOLE;
    contact.pointId = static_cast<int>(valueOr(data[17], PHYSVIB_POINT_NONE));
    return contact;
}

/// Reports an entry, whose kind is its first number, to the feed. Returns how many numbers it has, and sets
/// `error` (empty: none).
int reportEntry(ContactFeed& feed, const double* entry, std::string_view& error) {
    const int body = static_cast<int>(entry[1]);
    const double* data = entry + 2;
    switch (static_cast<int>(entry[0])) {
    case 0: // motion in the plane before the solver
        error = feed.move(
            body, {static_cast<float>(data[0]), static_cast<float>(data[1])},
            {{static_cast<float>(data[2]), static_cast<float>(data[3])}, static_cast<float>(data[4])});
        return 7;
    case 1: // velocities in the plane after it
        error = feed.moved(
            body, {{static_cast<float>(data[0]), static_cast<float>(data[1])}, static_cast<float>(data[2])});
        return 5;
    case 2: error = feed.touch(readContact(entry + 1)); return 19;
    case 3: { // motion in space before the solver
        const bool hasInertia = data[9] != 0.0;
        std::optional<InverseInertia> inertia;
        if (hasInertia) inertia = {data[10], data[11], data[12], data[13], data[14], data[15]};
        error = feed.moveInSpace(body, toVector(data), {toVector(data + 3), toVector(data + 6)}, inertia);
        return hasInertia ? 18 : 12;
    }
    default: error = feed.movedInSpace(body, {toVector(data), toVector(data + 3)}); return 8;
    }
}

} // namespace

/// Skips entries with invalid numbers, so that one body does not end the haptics of all. Returns 0, or the
/// number + 1 of the first body skipped, with the error in textBuffer(), or a negative error code.
extern "C" int PHYSVIB_JS(observe)(physvib_world world, const double* first, int count) {
    return api::withObject(world, [&](api::World& object) -> int {
        int firstRejected = 0;
        std::string_view error;
        for (const double *entry = first, *end = first + count; entry < end;) {
            const int length = reportEntry(object.feed, entry, error);
            if (error.starts_with("step:")) return api::fail(PHYSVIB_ERROR_ORDER, error);
            if (!error.empty() && firstRejected == 0) {
                firstRejected = static_cast<int>(entry[1]) + 1; // of a contact, its body a
                textBuffer() = error;
            }
            entry += length;
        }
        return firstRejected;
    });
}

} // namespace physvib::js
