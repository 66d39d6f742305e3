// SPDX-License-Identifier: MIT
// C functions of a world: settings, bodies, steps, contacts, and the events that result.
#include "Api/C/Calls.h"
#include "Api/C/HandleObjects.h"
#include <cmath>

using namespace physvib;
using namespace physvib::api;

namespace {

constexpr double maxStepSeconds = 3600.0;

int codeFromFeedError(std::string_view error) noexcept {
    return codeFromError(error, error.starts_with("step:") || error.starts_with("contact:") ||
                                        error.starts_with("time:")
                                    ? PHYSVIB_ERROR_ORDER
                                    : PHYSVIB_ERROR_ARGUMENT);
}

bool readWorldSettings(const physvib_world_settings* from, ImpactSettings& to) {
    physvib_world_settings copy;
    if (from == nullptr)
        physvib_world_settings_init(&copy, sizeof copy);
    else if (!readStruct(from, copy, physvib_world_settings_init))
        return false;
    for (const double number : {copy.field_x_m, copy.field_y_m, copy.field_radians})
        if (!(std::abs(number) <= 1.0e9)) return argumentError("field: expected numbers"), false;
    to.fieldWidthMetres = copy.field_width_m;
    to.normalisation = toOptional(copy.normalisation_s_per_m);
    to.handMassKg = toOptional(copy.hand_mass_kg);
    to.driveGain = copy.drive_gain;
    to.location = copy.at_body != 0 ? ImpactLocation::fixture : ImpactLocation::contact;
    to.thresholdMetresPerSecond = copy.threshold_m_per_s;
    to.keepsHitsOfDestroyed = copy.drops_hits_of_removed == 0;
    to.isMuted = copy.is_muted != 0;
    if (copy.hits_per_step != -1) to.hitsPerStep = copy.hits_per_step;
    to.fieldOrigin = {static_cast<float>(copy.field_x_m), static_cast<float>(copy.field_y_m)};
    to.fieldRadians = static_cast<float>(copy.field_radians);
    to.fullScaleNewtonSeconds = copy.full_scale_impulse_n_s;
    to.settlingSeconds = copy.settling_s;
    // checked here, because without exceptions configure() could not release the lock
    const std::string_view error = errorOf(to);
    return error.empty() || (argumentError(error), false);
}

HapticFixture toFixture(const physvib_body& body) {
    HapticFixture values;
    values.frequencyHz = body.frequency_hz;
    values.decayPerSecond = body.decay_per_s;
    values.isCamera = body.is_camera != 0;
    values.staticMassKg = body.static_mass_kg;
    values.voice = static_cast<Voice>(body.voice);
    values.surface = body.surface;
    values.gain = body.gain;
    values.handMassKg = toOptional(body.hand_mass_kg);
    values.part = body.part;
    values.texture = {body.grain_m, body.roughness,
                      body.is_ridged != 0 ? GrainPattern::regular : GrainPattern::random, body.rolling};
    for (std::size_t i = 0; i < values.overtones.size(); ++i)
        values.overtones[i] = {body.overtone_hz[i], body.overtone_decay_per_s[i], body.overtone_amplitude[i]};
    return values;
}

Vector2 toVector(double x, double y) { return {static_cast<float>(x), static_cast<float>(y)}; }
Vector3 toVector(double x, double y, double z) {
    return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
}
Vector3 toVector(const double* xyz) { return toVector(xyz[0], xyz[1], xyz[2]); }

FedContact toContact(const physvib_contact& from) {
    FedContact contact;
    contact.a = from.a;
    contact.b = from.b;
    contact.point = toVector(from.x_m, from.y_m, from.z_m);
    contact.normal = toVector(from.normal_x, from.normal_y, from.normal_z);
    contact.impulseNewtonSeconds = toOptional(from.impulse_n_s);
    contact.tangentialNewtonSeconds = from.tangential_n_s;
    contact.frictionNewtonSeconds = toVector(from.friction_x_n_s, from.friction_y_n_s, from.friction_z_n_s);
    contact.approachMetresPerSecond = toOptional(from.approach_m_per_s);
    contact.restitution = from.restitution;
    contact.effectiveMassKg = toOptional(from.effective_mass_kg);
    contact.fraction = toOptional(from.fraction);
    contact.gapMetres = from.gap_m;
    contact.gapFraction = from.gap_fraction;
    contact.alongAMetresPerSecond = toOptional(from.along_a_m_per_s);
    contact.alongBMetresPerSecond = toOptional(from.along_b_m_per_s);
    contact.isSoft = from.is_soft != 0;
    contact.isPushWhole = from.is_soft == PHYSVIB_SOFT_WHOLE;
    contact.pointId = from.point_id;
    contact.isImpulseOfPair = from.is_impulse_of_pair != 0;
    return contact;
}

int reportContact(physvib_world handle, const physvib_contact* contact,
                  std::string_view (ContactFeed::*report)(const FedContact&)) noexcept {
    return withObject(handle, [&](World& world) {
        physvib_contact copy;
        if (!readStruct(contact, copy, physvib_contact_init)) return PHYSVIB_ERROR_ARGUMENT;
        const std::string_view error = (world.feed.*report)(toContact(copy));
        const int unknownBody = world.feed.counts().unknownBody;
        if (error.starts_with("body:") && (unknownBody == copy.a || unknownBody == copy.b))
            return argumentError("body " + std::to_string(unknownBody) +
                                 ": expected one that was set before its contacts (set_body)");
        return codeFromFeedError(error);
    });
}

void moveReadyEvents(World& world, bool atOnce) {
    if (atOnce)
        world.feed.flush(world.pendingEvents);
    else
        world.feed.take(world.pendingEvents);
}

} // namespace

int physvib_world_create(const physvib_world_settings* settings, physvib_world* world) {
    return catchExceptions([&] {
        if (world == nullptr) return argumentError("world: expected a place for it, found NULL");
        *world = nullptr;
        ImpactSettings checked;
        if (!readWorldSettings(settings, checked)) return PHYSVIB_ERROR_ARGUMENT;
        const std::uintptr_t handle = worlds().add(std::make_unique<World>(checked));
        if (handle == 0) return fail(PHYSVIB_ERROR_FULL, "worlds: expected at most 256");
        *world = reinterpret_cast<physvib_world>(handle);
        return PHYSVIB_OK;
    });
}

int physvib_world_free(physvib_world world) {
    return worlds().remove(reinterpret_cast<std::uintptr_t>(world)) ? PHYSVIB_OK : unknownHandleError();
}

int physvib_world_configure(physvib_world handle, const physvib_world_settings* settings) {
    return withObject(handle, [&](World& world) {
        ImpactSettings checked;
        if (!readWorldSettings(settings, checked)) return PHYSVIB_ERROR_ARGUMENT;
        world.feed.configure(checked);
        return PHYSVIB_OK;
    });
}

int physvib_world_set_body(physvib_world handle, int body, const physvib_body* values) {
    return withObject(handle, [&](World& world) {
        physvib_body copy;
        if (!readStruct(values, copy, physvib_body_init)) return PHYSVIB_ERROR_ARGUMENT;
        if (copy.voice < PHYSVIB_VOICE_OWN || copy.voice > PHYSVIB_VOICE_BOTH)
            return argumentError("voice: expected one of PHYSVIB_VOICE_...");
        if (copy.device < 0) return argumentError("device: expected 0 or more");
        const std::string_view error =
            world.feed.set(body, {copy.mass_kg, copy.inertia_kg_m2, copy.gravity_scale}, toFixture(copy));
        if (error.empty() && copy.device != 0)
            world.devices[body] = copy.device;
        else if (error.empty())
            world.devices.erase(body);
        return codeFromError(error);
    });
}

int physvib_world_set_mass(physvib_world handle, int body, double massKg) {
    return withObject(handle, [&](World& world) { return codeFromError(world.feed.setMass(body, massKg)); });
}

int physvib_world_device(physvib_world handle, int body) {
    return withObject(handle, [&](World& world) {
        const auto found = world.devices.find(body);
        return found == world.devices.end() ? 0 : found->second;
    });
}

int physvib_world_remove_body(physvib_world handle, int body) {
    return withObject(handle, [&](World& world) { return codeFromFeedError(world.feed.remove(body)); });
}

int physvib_world_move(physvib_world handle, int body, double x, double y, double vx, double vy,
                       double spin) {
    return withObject(handle, [&](World& world) {
        return codeFromError(
            world.feed.move(body, toVector(x, y), {toVector(vx, vy), static_cast<float>(spin)}));
    });
}

int physvib_world_moved(physvib_world handle, int body, double vx, double vy, double spin) {
    return withObject(handle, [&](World& world) {
        return codeFromFeedError(world.feed.moved(body, {toVector(vx, vy), static_cast<float>(spin)}));
    });
}

int physvib_world_move_in_space(physvib_world handle, int body, const double centre[3],
                                const double velocity[3], const double spin[3], const double inverse[6]) {
    return withObject(handle, [&](World& world) {
        if (!centre || !velocity || !spin)
            return argumentError("motion: expected centre, velocity and spin, found NULL");
        std::optional<InverseInertia> inertia;
        if (inverse) inertia = {inverse[0], inverse[1], inverse[2], inverse[3], inverse[4], inverse[5]};
        return codeFromError(
            world.feed.moveInSpace(body, toVector(centre), {toVector(velocity), toVector(spin)}, inertia));
    });
}

int physvib_world_moved_in_space(physvib_world handle, int body, const double velocity[3],
                                 const double spin[3]) {
    return withObject(handle, [&](World& world) {
        if (!velocity || !spin) return argumentError("motion: expected velocity and spin, found NULL");
        return codeFromFeedError(world.feed.movedInSpace(body, {toVector(velocity), toVector(spin)}));
    });
}

int physvib_world_pair(physvib_world handle, int surface, int other, double frequencyHz,
                       double decayPerSecond, double gain) {
    return withObject(handle, [&](World& world) {
        return codeFromError(world.feed.setPair(surface, other, {frequencyHz, decayPerSecond, {}, gain}));
    });
}

int physvib_world_begin_step(physvib_world handle, double seconds, double gravity) {
    return withObject(handle, [&](World& world) {
        if (!(seconds >= 0.0 && seconds <= maxStepSeconds))
            return argumentError("step: expected 0 to 3600 s");
        return codeFromFeedError(
            world.feed.beginStep(world.feed.timeNs() + std::llround(seconds * 1.0e9), gravity));
    });
}

int physvib_world_touch(physvib_world world, const physvib_contact* contact) {
    return reportContact(world, contact, &ContactFeed::touch);
}
int physvib_world_begin(physvib_world world, const physvib_contact* contact) {
    return reportContact(world, contact, &ContactFeed::begin);
}
int physvib_world_push(physvib_world world, const physvib_contact* contact) {
    return reportContact(world, contact, &ContactFeed::push);
}

int physvib_world_end(physvib_world handle, int a, int b) {
    return withObject(handle, [&](World& world) { return codeFromFeedError(world.feed.end(a, b)); });
}

int physvib_world_end_step(physvib_world handle) {
    return withObject(handle, [&](World& world) { return codeFromFeedError(world.feed.endStep()); });
}

physvib_int64 physvib_world_time_ns(physvib_world handle) {
    return withObject(handle, [&](World& world) -> physvib_int64 { return world.feed.timeNs(); });
}

physvib_int64 physvib_world_take(physvib_world handle, physvib_event* events, physvib_int64 capacity,
                                 int atOnce) {
    return withObject(handle, [&](World& world) -> physvib_int64 {
        if (capacity < 0 || (capacity > 0 && events == nullptr))
            return argumentError("events: expected a place for them");
        moveReadyEvents(world, atOnce != 0);
        const std::int64_t count = writeEvents(world.pendingEvents, events, capacity);
        if (count > 0)
            world.pendingEvents.erase(world.pendingEvents.begin(), world.pendingEvents.begin() + count);
        return count;
    });
}

physvib_int64 physvib_world_send(physvib_world handle, physvib_renderer to, physvib_int64 laterNs,
                                 int atOnce) {
    return withObject(handle, [&](World& world) -> physvib_int64 {
        const auto renderer = borrow(to);
        if (!renderer) return unknownHandleError();
        if (laterNs < 0 || laterNs > limits::maxTimeNs / 2)
            return argumentError("delay: expected 0 to 5 10^16 ns");
        moveReadyEvents(world, atOnce != 0);
        physvib_int64 sent = 0;
        const std::lock_guard lock{renderer->producerMutex};
        for (CollisionEvent event : world.pendingEvents) {
            event.timeNs += laterNs;
            sent += renderer->source.events.push(event) ? 1 : 0;
        }
        world.pendingEvents.clear();
        return sent;
    });
}

physvib_int64 physvib_world_thinned(physvib_world handle) {
    return withObject(handle, [](World& world) { return toInt64(world.feed.thinned()); });
}

physvib_int64 physvib_world_drops(physvib_world handle) {
    return withObject(handle, [](World& world) { return toInt64(world.feed.drops()); });
}

int physvib_world_get_counts(physvib_world handle, physvib_world_counts* counts) {
    return withObject(handle, [&](World& world) {
        const ContactCounts total = world.feed.counts();
        physvib_world_counts copy;
        if (!readStruct(counts, copy, physvib_world_counts_init)) return PHYSVIB_ERROR_ARGUMENT;
        const std::size_t size = counts->size; // of the caller's version
        copy.contacts = toInt64(total.contacts);
        copy.below_threshold = toInt64(total.belowThreshold);
        copy.no_source = toInt64(total.withoutSource);
        copy.unplayable = toInt64(total.unplayable);
        copy.muted = toInt64(total.muted + total.settling);
        copy.dropped = toInt64(total.dropped);
        copy.events = toInt64(total.events);
        copy.threshold_m_per_s = total.thresholdMetresPerSecond;
        return writeStruct(counts, size, copy);
    });
}
