// SPDX-License-Identifier: MIT
// What an attachment observes in a step, told in one call: package/journal.js writes it.
#include "Api/C/physvib.h"
#include "Api/JavaScript/Exports.h"

namespace physvib::js {

namespace {

constexpr double leftOut = -2.0e300; // as in journal.js: the default of physvib_contact_init

/// The next numbers of a list.
class Numbers {
public:
    Numbers(const double* first, int count) noexcept
        : at_{first}
        , end_{first + count} {}
    bool isEmpty() const noexcept { return at_ == end_; }
    const double* at() const noexcept { return at_; }
    double next() noexcept { return *at_++; }
    int nextInt() noexcept { return static_cast<int>(next()); }
    const double* next(int count) noexcept { return (at_ += count) - count; }
    void into(double& member) noexcept {
        if (const double value = next(); value != leftOut) member = value;
    }
    void into(int& member) noexcept {
        if (const double value = next(); value != leftOut) member = static_cast<int>(value);
    }

private:
    const double *at_, *end_;
};

int touch(physvib_world world, Numbers& from) noexcept {
    physvib_contact contact;
    physvib_contact_init(&contact, sizeof contact);
    for (int* member : {&contact.a, &contact.b}) from.into(*member);
    for (double* member :
         {&contact.x_m, &contact.y_m, &contact.z_m, &contact.normal_x, &contact.normal_y, &contact.normal_z,
          &contact.impulse_n_s, &contact.approach_m_per_s, &contact.restitution, &contact.fraction,
          &contact.gap_m, &contact.gap_fraction, &contact.along_a_m_per_s, &contact.along_b_m_per_s})
        from.into(*member);
    for (int* member : {&contact.is_soft, &contact.point_id}) from.into(*member);
    return physvib_world_touch(world, &contact);
}

int move(physvib_world world, Numbers& from) noexcept {
    const int body = from.nextInt();
    const double* to = from.next(5);
    return physvib_world_move(world, body, to[0], to[1], to[2], to[3], to[4]);
}

int moved(physvib_world world, Numbers& from) noexcept {
    const int body = from.nextInt();
    const double* to = from.next(3);
    return physvib_world_moved(world, body, to[0], to[1], to[2]);
}

int moveInSpace(physvib_world world, Numbers& from) noexcept {
    const int body = from.nextInt();
    const double *centre = from.next(3), *velocity = from.next(3), *spin = from.next(3);
    const bool hasInertia = from.next() != 0.0;
    return physvib_world_move_in_space(world, body, centre, velocity, spin,
                                       hasInertia ? from.next(6) : nullptr);
}

int movedInSpace(physvib_world world, Numbers& from) noexcept {
    const int body = from.nextInt();
    const double *velocity = from.next(3), *spin = from.next(3);
    return physvib_world_moved_in_space(world, body, velocity, spin);
}

// By their numbers in journal.js.
constexpr int (*kinds[])(physvib_world, Numbers&) noexcept {move, moved, touch, moveInSpace, movedInSpace};

} // namespace

/// Leaves out what has numbers that are none, so that one body does not end the haptics of all. Returns 0, the
/// first such body's number + 1 with the error in text(), or another error.
extern "C" int PHYSVIB_JS(observe)(physvib_world world, const double* first, int count) {
    Numbers numbers{first, count};
    int refused = 0;
    while (!numbers.isEmpty()) {
        const double* entry = numbers.at();
        const int code = kinds[numbers.nextInt()](world, numbers);
        if (code >= PHYSVIB_OK) continue;
        if (code != PHYSVIB_ERROR_ARGUMENT) return code;
        if (refused == 0) {
            refused = static_cast<int>(entry[1]) + 1; // of a contact, its first
            text() = physvib_error();
        }
    }
    return refused;
}

} // namespace physvib::js
