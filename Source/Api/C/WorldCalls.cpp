// SPDX-License-Identifier: MIT
// C functions of a world: report contacts, take its events, explain why nothing is felt.
#include "Api/C/Calls.h"
#include "Api/C/Objects.h"
#include "Contacts/ContactCounts.h"
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

using namespace physvib;
using namespace physvib::api;

namespace {

constexpr double longestStepSeconds = 3600.0;

int inOrder(std::string_view fault) noexcept {
    return resultOf(fault,
                    fault.starts_with("step:") || fault.starts_with("contact:") || fault.starts_with("time:")
                        ? PHYSVIB_ERROR_ORDER
                        : PHYSVIB_ERROR_ARGUMENT);
}

bool convert(const physvib_world_settings* from, ImpactSettings& to) {
    physvib_world_settings taken;
    if (!takeOrBegin(from, taken, physvib_world_settings_init)) return false;
    for (const double number : {taken.field_x_m, taken.field_y_m, taken.field_radians})
        if (!(std::abs(number) <= 1.0e9)) return nothingThere("field: expected numbers"), false;
    to.fieldWidthMetres = taken.field_width_m;
    to.normalisation = optional(taken.normalisation_s_per_m);
    to.handMassKg = optional(taken.hand_mass_kg);
    to.driveGain = taken.drive_gain;
    to.location = taken.at_body != 0 ? ImpactLocation::fixture : ImpactLocation::contact;
    to.thresholdMetresPerSecond = taken.threshold_m_per_s;
    to.keepsHitsOfDestroyed = taken.drops_hits_of_removed == 0;
    to.isMuted = taken.is_muted != 0;
    if (taken.hits_per_step != -1) to.hitsPerStep = taken.hits_per_step;
    to.fieldOrigin = {static_cast<float>(taken.field_x_m), static_cast<float>(taken.field_y_m)};
    to.fieldRadians = static_cast<float>(taken.field_radians);
    to.fullScaleNewtonSeconds = taken.full_scale_impulse_n_s;
    to.settlingSeconds = taken.settling_s;
    // checked here, because without exceptions configure() could not release the lock
    return resultOf(faultOf(to)) == PHYSVIB_OK;
}

HapticFixture fixtureOf(const physvib_body& body) {
    HapticFixture values;
    values.frequencyHz = body.frequency_hz;
    values.decayPerSecond = body.decay_per_s;
    values.isCamera = body.is_camera != 0;
    values.staticMassKg = body.static_mass_kg;
    values.voice = static_cast<Voice>(body.voice);
    values.surface = body.surface;
    values.gain = body.gain;
    values.handMassKg = optional(body.hand_mass_kg);
    values.part = body.part;
    values.texture = {body.grain_m, body.roughness,
                      body.is_ridged != 0 ? GrainPattern::regular : GrainPattern::random, body.rolling};
    for (std::size_t i = 0; i < values.overtones.size(); ++i)
        values.overtones[i] = {body.overtone_hz[i], body.overtone_decay_per_s[i], body.overtone_amplitude[i]};
    return values;
}

Vector2 vectorOf(double x, double y) { return {static_cast<float>(x), static_cast<float>(y)}; }
Vector3 vectorOf(double x, double y, double z) {
    return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
}
Vector3 vectorOf(const double* of) { return vectorOf(of[0], of[1], of[2]); }

FedContact contactOf(const physvib_contact& from) {
    FedContact contact;
    contact.a = from.a;
    contact.b = from.b;
    contact.point = vectorOf(from.x_m, from.y_m, from.z_m);
    contact.normal = vectorOf(from.normal_x, from.normal_y, from.normal_z);
    contact.impulseNewtonSeconds = optional(from.impulse_n_s);
    contact.tangentialNewtonSeconds = from.tangential_n_s;
    contact.frictionNewtonSeconds = vectorOf(from.friction_x_n_s, from.friction_y_n_s, from.friction_z_n_s);
    contact.approachMetresPerSecond = optional(from.approach_m_per_s);
    contact.restitution = from.restitution;
    contact.effectiveMassKg = optional(from.effective_mass_kg);
    contact.fraction = optional(from.fraction);
    contact.gapMetres = from.gap_m;
    contact.gapFraction = from.gap_fraction;
    contact.alongAMetresPerSecond = optional(from.along_a_m_per_s);
    contact.alongBMetresPerSecond = optional(from.along_b_m_per_s);
    contact.isSoft = from.is_soft != 0;
    contact.isPushWhole = from.is_soft == PHYSVIB_SOFT_WHOLE;
    contact.pointId = from.point_id;
    contact.isImpulseOfPair = from.is_impulse_of_pair != 0;
    return contact;
}

int tell(physvib_world name, const physvib_contact* contact,
         std::string_view (ContactFeed::*call)(const FedContact&)) noexcept {
    return in(name, [&](World& world) {
        physvib_contact taken;
        if (!take(contact, taken, physvib_contact_init)) return PHYSVIB_ERROR_ARGUMENT;
        const std::string_view fault = (world.feed.*call)(contactOf(taken));
        const int unknown = world.feed.counts().unknownBody;
        if (fault.starts_with("body:") && (unknown == taken.a || unknown == taken.b))
            return nothingThere("body " + std::to_string(unknown) +
                                ": expected one that was set before its contacts (set_body)");
        return inOrder(fault);
    });
}

void collect(World& world, bool atOnce) {
    if (atOnce)
        world.feed.flush(world.taken);
    else
        world.feed.take(world.taken);
}

// Outputs count from their opening. If the count has fallen, it is of another output and all of it is new.
std::uint64_t since(std::uint64_t& last, std::uint64_t now) noexcept {
    const std::uint64_t before = std::exchange(last, now);
    return now >= before ? now - before : now;
}

int explain(physvib_world name, OutputFacts* output, char* text, size_t size) noexcept {
    return in(name, [&](World& world) {
        if (text == nullptr || size == 0) return nothingThere("text: expected a place for it");
        if (output != nullptr) {
            output->late = since(world.late, output->late);
            output->dropped = since(world.dropped, output->dropped);
            output->rejected = since(world.rejected, output->rejected);
            output->withoutPart = since(world.withoutPart, output->withoutPart);
        }
        const ContactCounts recent = world.feed.takeRecent();
        const std::string sentence = physvib::explain(recent, world.feed.counts(), output);
        copyText(sentence, {text, size});
        return static_cast<int>(sentence.size());
    });
}

OutputFacts outputOf(Renderer& renderer, const LastChanges& changes) {
    const std::lock_guard lock{renderer.readers};
    const RenderStatus status = renderer.status.read();
    const double now = static_cast<double>(status.framesRendered) / renderer.rateHz * 1.0e9;
    OutputFacts output;
    output.isMissing = status.framesRendered == 0;
    if (output.isMissing) output.trouble = "no samples have been pulled from the renderer";
    output.isSilent = now < static_cast<double>(changes.silentUntilNs);
    output.silentBy = "physvib_renderer_silence";
    output.channels = renderer.channels;
    output.levelGain = changes.level;
    output.mutedChannels = changes.mutedChannels();
    output.late = status.late;
    output.dropped = renderer.source.events.overflows();
    output.rejected = status.rejected;
    output.panner = &changes.panner;
    output.withoutPart = status.withoutPart;
    return output;
}

std::string_view viewOf(const char* text) noexcept { return text == nullptr ? "" : text; }

} // namespace

int physvib_world_create(const physvib_world_settings* settings, physvib_world* world) {
    return guarded([&] {
        if (world == nullptr) return nothingThere("world: expected a place for it, found NULL");
        *world = nullptr;
        ImpactSettings wanted;
        if (!convert(settings, wanted)) return PHYSVIB_ERROR_ARGUMENT;
        return Worlds::all().add(std::make_unique<World>(wanted), world, "worlds: expected at most 256");
    });
}

int physvib_world_free(physvib_world world) { return Worlds::all().remove(world); }

int physvib_world_configure(physvib_world name, const physvib_world_settings* settings) {
    return in(name, [&](World& world) {
        ImpactSettings wanted;
        if (!convert(settings, wanted)) return PHYSVIB_ERROR_ARGUMENT;
        world.feed.configure(wanted);
        return PHYSVIB_OK;
    });
}

int physvib_world_set_body(physvib_world name, int body, const physvib_body* values) {
    return in(name, [&](World& world) {
        physvib_body taken;
        if (!take(values, taken, physvib_body_init)) return PHYSVIB_ERROR_ARGUMENT;
        if (taken.voice < PHYSVIB_VOICE_OWN || taken.voice > PHYSVIB_VOICE_BOTH)
            return nothingThere("voice: expected one of PHYSVIB_VOICE_...");
        if (taken.device < 0) return nothingThere("device: expected 0 or more");
        const std::string_view fault =
            world.feed.set(body, {taken.mass_kg, taken.inertia_kg_m2, taken.gravity_scale}, fixtureOf(taken));
        if (fault.empty() && taken.device != 0)
            world.devices[body] = taken.device;
        else if (fault.empty())
            world.devices.erase(body);
        return resultOf(fault);
    });
}

int physvib_world_set_mass(physvib_world name, int body, double massKg) {
    return in(name, [&](World& world) { return resultOf(world.feed.setMass(body, massKg)); });
}

int physvib_world_device(physvib_world name, int body) {
    return in(name, [&](World& world) {
        const auto known = world.devices.find(body);
        return known == world.devices.end() ? 0 : known->second;
    });
}

int physvib_world_remove_body(physvib_world name, int body) {
    return in(name, [&](World& world) { return inOrder(world.feed.remove(body)); });
}

int physvib_world_move(physvib_world name, int body, double x, double y, double vx, double vy, double spin) {
    return in(name, [&](World& world) {
        return resultOf(world.feed.move(body, vectorOf(x, y), {vectorOf(vx, vy), static_cast<float>(spin)}));
    });
}

int physvib_world_moved(physvib_world name, int body, double vx, double vy, double spin) {
    return in(name, [&](World& world) {
        return inOrder(world.feed.moved(body, {vectorOf(vx, vy), static_cast<float>(spin)}));
    });
}

int physvib_world_move_in_space(physvib_world name, int body, const double centre[3],
                                const double velocity[3], const double spin[3], const double inverse[6]) {
    return in(name, [&](World& world) {
        if (!centre || !velocity || !spin)
            return nothingThere("motion: expected centre, velocity and spin, found NULL");
        std::optional<InverseInertia> turning;
        if (inverse) turning = {inverse[0], inverse[1], inverse[2], inverse[3], inverse[4], inverse[5]};
        return resultOf(
            world.feed.moveInSpace(body, vectorOf(centre), {vectorOf(velocity), vectorOf(spin)}, turning));
    });
}

int physvib_world_moved_in_space(physvib_world name, int body, const double velocity[3],
                                 const double spin[3]) {
    return in(name, [&](World& world) {
        if (!velocity || !spin) return nothingThere("motion: expected velocity and spin, found NULL");
        return inOrder(world.feed.movedInSpace(body, {vectorOf(velocity), vectorOf(spin)}));
    });
}

int physvib_world_pair(physvib_world name, int surface, int other, double frequencyHz, double decayPerSecond,
                       double gain) {
    return in(name, [&](World& world) {
        return resultOf(world.feed.setPair(surface, other, {frequencyHz, decayPerSecond, {}, gain}));
    });
}

int physvib_world_begin_step(physvib_world name, double seconds, double gravity) {
    return in(name, [&](World& world) {
        if (!(seconds >= 0.0 && seconds <= longestStepSeconds))
            return nothingThere("step: expected 0 to 3600 s");
        return inOrder(world.feed.beginStep(world.feed.timeNs() + std::llround(seconds * 1.0e9), gravity));
    });
}

int physvib_world_touch(physvib_world world, const physvib_contact* contact) {
    return tell(world, contact, &ContactFeed::touch);
}
int physvib_world_begin(physvib_world world, const physvib_contact* contact) {
    return tell(world, contact, &ContactFeed::begin);
}
int physvib_world_push(physvib_world world, const physvib_contact* contact) {
    return tell(world, contact, &ContactFeed::push);
}

int physvib_world_end(physvib_world name, int a, int b) {
    return in(name, [&](World& world) { return inOrder(world.feed.end(a, b)); });
}

int physvib_world_end_step(physvib_world name) {
    return in(name, [&](World& world) { return inOrder(world.feed.endStep()); });
}

physvib_int64 physvib_world_time_ns(physvib_world name) {
    return in(name, [&](World& world) -> physvib_int64 { return world.feed.timeNs(); });
}

physvib_int64 physvib_world_take(physvib_world name, physvib_event* events, physvib_int64 capacity,
                                 int atOnce) {
    return in(name, [&](World& world) -> physvib_int64 {
        if (capacity < 0 || (capacity > 0 && events == nullptr))
            return nothingThere("events: expected a place for them");
        collect(world, atOnce != 0);
        const std::int64_t count = writeEvents(world.taken, events, capacity);
        if (count > 0) world.taken.erase(world.taken.begin(), world.taken.begin() + count);
        return count;
    });
}

physvib_int64 physvib_world_send(physvib_world name, physvib_renderer to, physvib_int64 laterNs, int atOnce) {
    return in(name, [&](World& world) -> physvib_int64 {
        const auto renderer = use(to);
        if (!renderer) return unknownHandle();
        if (laterNs < 0 || laterNs > limits::maxTimeNs / 2)
            return nothingThere("delay: expected 0 to 5 10^16 ns");
        collect(world, atOnce != 0);
        physvib_int64 sent = 0;
        const std::lock_guard lock{renderer->producers};
        for (CollisionEvent event : world.taken) {
            event.timeNs += laterNs;
            sent += renderer->source.events.push(event) ? 1 : 0;
        }
        world.taken.clear();
        return sent;
    });
}

physvib_int64 physvib_world_thinned(physvib_world name) {
    return in(name, [&](World& world) -> physvib_int64 {
        return static_cast<physvib_int64>(world.feed.thinned());
    });
}

physvib_int64 physvib_world_drops(physvib_world name) {
    return in(name,
              [&](World& world) -> physvib_int64 { return static_cast<physvib_int64>(world.feed.drops()); });
}

int physvib_world_get_counts(physvib_world name, physvib_world_counts* counts) {
    return in(name, [&](World& world) {
        const ContactCounts now = world.feed.counts();
        physvib_world_counts taken;
        if (!take(counts, taken, physvib_world_counts_init)) return PHYSVIB_ERROR_ARGUMENT;
        const auto number = [](std::uint64_t count) { return static_cast<physvib_int64>(count); };
        taken.contacts = number(now.contacts);
        taken.below_threshold = number(now.belowThreshold);
        taken.no_source = number(now.withoutSource);
        taken.unplayable = number(now.unplayable);
        taken.muted = number(now.muted + now.settling);
        taken.dropped = number(now.dropped);
        taken.events = number(now.events);
        taken.threshold_m_per_s = now.thresholdMetresPerSecond;
        return begin(counts, counts->size, taken);
    });
}

int physvib_output_facts_init(physvib_output_facts* facts, size_t size) {
    auto usual = zeroed<physvib_output_facts>();
    usual.level = 1.0;
    return begin(facts, size, usual);
}

int physvib_world_note(physvib_world name, int body, int note) {
    return in(name, [&](World& world) {
        if (note < PHYSVIB_NOTE_SENSOR || note > PHYSVIB_NOTE_ASLEEP)
            return nothingThere("note: expected one of PHYSVIB_NOTE_...");
        return resultOf(world.feed.note(body, static_cast<EngineNote>(note)));
    });
}
static_assert(PHYSVIB_NOTE_SENSOR == static_cast<int>(EngineNote::sensor) &&
              PHYSVIB_NOTE_ASLEEP == static_cast<int>(EngineNote::asleep));

int physvib_world_explain(physvib_world world, char* text, size_t size) {
    return explain(world, nullptr, text, size);
}

int physvib_world_explain_output(physvib_world world, const physvib_output_facts* facts, char* text,
                                 size_t size) {
    physvib_output_facts taken;
    if (!take(facts, taken, physvib_output_facts_init)) return PHYSVIB_ERROR_ARGUMENT;
    if (!(taken.level >= 0.0)) return nothingThere("level: expected a gain of 0 or more");
    RendererSettings renderer;
    if (taken.renderer != nullptr && !takeRenderer(taken.renderer, renderer)) return PHYSVIB_ERROR_ARGUMENT;
    const auto count = [](physvib_int64 told) {
        return static_cast<std::uint64_t>(std::max<physvib_int64>(told, 0));
    };
    OutputFacts output{taken.is_missing != 0,
                       taken.is_silent != 0,
                       viewOf(taken.silent_by),
                       viewOf(taken.trouble),
                       std::max(0, taken.channels),
                       taken.level,
                       static_cast<std::uint64_t>(taken.muted_channels),
                       count(taken.late),
                       count(taken.dropped),
                       count(taken.rejected),
                       taken.renderer != nullptr ? &renderer.panner : nullptr,
                       count(taken.without_part)};
    return explain(world, &output, text, size);
}

int physvib_renderer_explain(physvib_renderer name, physvib_world world, char* text, size_t size) {
    return Renderers::all().in(name, [&](Renderer& renderer) {
        LastChanges changes;
        {
            const std::lock_guard lock{renderer.producers};
            changes = renderer.changes;
        }
        OutputFacts output = outputOf(renderer, changes);
        return explain(world, &output, text, size);
    });
}
