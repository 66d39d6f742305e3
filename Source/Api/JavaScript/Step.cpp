// SPDX-License-Identifier: MIT
// Passes the motions and contacts of a step, which package/journal.js lists, to the feed in one call.
// Thousands per step are usual, so the structures of the C functions are not used.
#include "Api/C/Calls.h"
#include "Api/C/Objects.h"
#include "Api/JavaScript/Exports.h"
#include <optional>

namespace physvib::js {

namespace {

constexpr double leftOut = -2.0e300; // leftOut of journal.js: the member has its default

Vector3 vectorOf(const double* at) noexcept {
    return {static_cast<float>(at[0]), static_cast<float>(at[1]), static_cast<float>(at[2])};
}
double orElse(double value, double other) noexcept { return value == leftOut ? other : value; }
std::optional<double> known(double value) noexcept { return api::optional(orElse(value, PHYSVIB_UNKNOWN)); }

/// Reads an entry from the numbers of both bodies on, in the order of journal.js.
FedContact contactOf(const double* at) noexcept {
    FedContact contact;
    contact.a = static_cast<int>(at[0]);
    contact.b = static_cast<int>(at[1]);
    contact.point = {static_cast<float>(orElse(at[2], 0.0)), static_cast<float>(orElse(at[3], 0.0)),
                     static_cast<float>(orElse(at[4], 0.0))};
    contact.normal = {static_cast<float>(orElse(at[5], 0.0)), static_cast<float>(orElse(at[6], 1.0)),
                      static_cast<float>(orElse(at[7], 0.0))};
    contact.impulseNewtonSeconds = known(at[8]);
    contact.approachMetresPerSecond = known(at[9]);
    contact.restitution = orElse(at[10], 0.0);
    contact.fraction = known(at[11]);
    contact.gapMetres = orElse(at[12], 0.0);
    contact.gapFraction = orElse(at[13], 0.0);
    contact.alongAMetresPerSecond = known(at[14]);
    contact.alongBMetresPerSecond = known(at[15]);
    const int soft = static_cast<int>(orElse(at[16], 0.0));
    contact.isSoft = soft != 0;
    contact.isPushWhole = soft == PHYSVIB_SOFT_WHOLE;
    contact.pointId = static_cast<int>(orElse(at[17], PHYSVIB_POINT_NONE));
    return contact;
}

/// An entry by its kind in journal.js. Returns how many numbers it has; `fault`: what is wrong with it.
int tell(ContactFeed& feed, const double* entry, std::string_view& fault) {
    const int body = static_cast<int>(entry[1]);
    const double* at = entry + 2;
    switch (static_cast<int>(entry[0])) {
    case 0:
        fault =
            feed.move(body, {static_cast<float>(at[0]), static_cast<float>(at[1])},
                      {{static_cast<float>(at[2]), static_cast<float>(at[3])}, static_cast<float>(at[4])});
        return 7;
    case 1:
        fault = feed.moved(
            body, {{static_cast<float>(at[0]), static_cast<float>(at[1])}, static_cast<float>(at[2])});
        return 5;
    case 2: fault = feed.touch(contactOf(entry + 1)); return 19;
    case 3: {
        const bool hasInertia = at[9] != 0.0;
        std::optional<InverseInertia> inverse;
        if (hasInertia) inverse = {at[10], at[11], at[12], at[13], at[14], at[15]};
        fault = feed.moveInSpace(body, vectorOf(at), {vectorOf(at + 3), vectorOf(at + 6)}, inverse);
        return hasInertia ? 18 : 12;
    }
    default: fault = feed.movedInSpace(body, {vectorOf(at), vectorOf(at + 3)}); return 8;
    }
}

} // namespace

/// Skips entries with invalid numbers, so that one body does not end the haptics of all. Returns 0, or the
/// number + 1 of the first body skipped, with the error in text(), or a negative error code.
extern "C" int PHYSVIB_JS(observe)(physvib_world world, const double* first, int count) {
    return api::in(world, [&](api::World& of) -> int {
        int refused = 0;
        std::string_view fault;
        for (const double *entry = first, *end = first + count; entry < end;) {
            const int length = tell(of.feed, entry, fault);
            if (fault.starts_with("step:")) return api::fail(PHYSVIB_ERROR_ORDER, fault);
            if (!fault.empty() && refused == 0) {
                refused = static_cast<int>(entry[1]) + 1; // of a contact, its body a
                text() = fault;
            }
            entry += length;
        }
        return refused;
    });
}

} // namespace physvib::js
