// SPDX-License-Identifier: MIT
// C functions of materials by name, and of single impacts, which need no world.
#include "Api/C/Calls.h"
#include "Api/C/Objects.h"
#include "Io/Text/NameList.h"
#include "Scene/MaterialTable.h"
#include "Scene/PartNames.h"

using namespace physvib;
using namespace physvib::api;

namespace {

using Materials = std::vector<const Material*>;

// Some materials of Table 5.1 are only dropped: without a frequency they cannot make a body vibrate.
void addVibrating(const MaterialTable& table, Materials& to) {
    for (const Material& material : table.materials)
        if (material.frequencyHz > 0.0) to.push_back(&material);
}

const Materials& builtIn() {
    static const Materials all = [] {
        Materials found;
        for (const MaterialTable& table : builtInMaterials()) addVibrating(table, found);
        return found;
    }();
    return all;
}

int unknownMaterial(const Materials& among, std::string_view name) {
    constexpr std::size_t most = 8;
    std::vector<std::string_view> names;
    for (const Material* material : among) names.emplace_back(material->name);
    const bool isShort = names.size() <= most;
    if (!isShort) names.resize(most);
    return nothingThere("material: expected one that vibrates (" +
                        (names.empty() ? "there is none" : listed(names, isShort ? " or " : ", ")) +
                        (isShort ? "" : " and so on") + "), found \"" + std::string{name} + "\"");
}

void set(const Material& material, physvib_body& body) {
    body.frequency_hz = material.frequencyHz;
    body.decay_per_s = material.decayPerSecond;
    for (double& frequencyHz : body.overtone_hz) frequencyHz = 0.0;
    body.grain_m = material.grainMetres;
    body.roughness = material.roughness;
    body.rolling = material.rolling;
    body.is_ridged = material.grainPattern == GrainPattern::regular ? 1 : 0;
}

int setNamed(const Materials& among, const char* name, physvib_body* body) {
    physvib_body taken;
    if (!take(body, taken, physvib_body_init)) return PHYSVIB_ERROR_ARGUMENT;
    const auto found = std::ranges::find(among, std::string_view{name}, &Material::name);
    if (found == among.end()) return unknownMaterial(among, name);
    set(**found, taken);
    return begin(body, body->size, taken);
}

} // namespace

const char* physvib_material_name(int index) {
    const char* name = nullptr;
    guarded([&] {
        if (index >= 0 && index < std::ssize(builtIn()))
            name = builtIn()[static_cast<std::size_t>(index)]->name.c_str();
        return PHYSVIB_OK;
    });
    return name;
}

int physvib_material(const char* name, physvib_body* body) {
    return guarded([&] {
        if (name == nullptr) return nothingThere("material: expected a name, found NULL");
        return setNamed(builtIn(), name, body);
    });
}

int physvib_material_load(const char* path, const char* name, physvib_body* body) {
    return guarded([&] {
        if (path == nullptr || name == nullptr)
            return nothingThere("material: expected a path and a name, found NULL");
        const auto table = loadMaterials(path);
        if (!table) return fail(PHYSVIB_ERROR_FILE, table.error);
        Materials all;
        addVibrating(table.value, all);
        return setNamed(all, name, body);
    });
}

int physvib_sound(const char* name) {
    if (name == nullptr || *name == '\0') return nothingThere("sound: expected a name");
    return soundNamed(name);
}

int physvib_event_of(const char* material, double x, double y, double strength, physvib_event* event) {
    if (event == nullptr) return nothingThere("event: expected a place for it, found NULL");
    if (!(strength >= 0.0 && strength <= 1.0)) return nothingThere("strength: expected 0 to 1");
    physvib_body body;
    physvib_body_init(&body, sizeof body);
    body.frequency_hz = 200.0; // the default: a ring of a quarter of a second, which most actuators can play
    body.decay_per_s = 30.0;
    if (material != nullptr)
        if (const int code = physvib_material(material, &body); code != PHYSVIB_OK) return code;
    physvib_event made = noEvent();
    made.frequency_hz = body.frequency_hz;
    made.decay_per_s = body.decay_per_s;
    made.amplitude = strength;
    made.x_m = x;
    made.y_m = y;
    if (material != nullptr) made.sound = physvib_sound(material);
    CollisionEvent played;
    if (const auto fault = readEvent(made, played); !fault.empty()) return nothingThere(fault);
    return writeEvents({&played, 1}, event, 1) < 0 ? PHYSVIB_ERROR_ARGUMENT : PHYSVIB_OK;
}

int physvib_renderer_impact(physvib_renderer renderer, double x, double y, double strength) {
    return physvib_renderer_impact_of(renderer, nullptr, x, y, strength);
}

int physvib_renderer_impact_of(physvib_renderer name, const char* material, double x, double y,
                               double strength) {
    physvib_event event = noEvent();
    if (const int code = physvib_event_of(material, x, y, strength, &event); code != PHYSVIB_OK) return code;
    const auto renderer = use(name);
    if (!renderer) return unknownHandle();
    {
        constexpr std::int64_t nsPerSecond = 1'000'000'000;
        const std::lock_guard lock{renderer->readers};
        const std::int64_t frames = renderer->status.read().framesRendered, rateHz = renderer->rateHz;
        // rounded up, so that the event is not late; in two parts, which do not overflow
        event.time_ns = frames / rateHz * nsPerSecond + (frames % rateHz * nsPerSecond + rateHz - 1) / rateHz;
    }
    return physvib_renderer_strike(name, &event);
}
