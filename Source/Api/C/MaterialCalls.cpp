// SPDX-License-Identifier: MIT
// C functions of materials by name, and of single impacts, which need no world.
#include "Api/C/Calls.h"
#include "Api/C/HandleObjects.h"
#include "Io/Text/NameList.h"
#include "Scene/MaterialTable.h"
#include "Scene/PartNames.h"

using namespace physvib;
using namespace physvib::api;

namespace {

using Materials = std::vector<const Material*>;

// Some materials of Table 5.1 of the thesis have no frequency, so a body of them cannot vibrate.
void addVibratingMaterials(const MaterialTable& table, Materials& to) {
    for (const Material& material : table.materials)
        if (material.frequencyHz > 0.0) to.push_back(&material);
}

const Materials& vibratingMaterials() {
    static const Materials all = [] {
        Materials found;
        for (const MaterialTable& table : builtInMaterials()) addVibratingMaterials(table, found);
        return found;
    }();
    return all;
}

int unknownMaterialError(const Materials& candidates, std::string_view name) {
    constexpr std::size_t maxNames = 8;
    std::vector<std::string_view> names;
    for (const Material* material : candidates) names.emplace_back(material->name);
    const bool listsAll = names.size() <= maxNames;
    if (!listsAll) names.resize(maxNames);
    return argumentError("material: expected one that vibrates (" +
                         (names.empty() ? "there is none" : nameList(names, listsAll ? " or " : ", ")) +
                         (listsAll ? "" : " and so on") + "), found " + inQuotes(name));
}

void applyMaterial(const Material& material, physvib_body& body) {
    body.frequency_hz = material.frequencyHz;
    body.decay_per_s = material.decayPerSecond;
    for (double& frequencyHz : body.overtone_hz) frequencyHz = 0.0;
    body.grain_m = material.grainMetres;
    body.roughness = material.roughness;
    body.rolling = material.rolling;
    body.is_ridged = material.grainPattern == GrainPattern::regular ? 1 : 0;
}

int applyNamedMaterial(const Materials& candidates, const char* name, physvib_body* body) {
    physvib_body copy;
    if (!readStruct(body, copy, physvib_body_init)) return PHYSVIB_ERROR_ARGUMENT;
    const auto found = std::ranges::find(candidates, std::string_view{name}, &Material::name);
    if (found == candidates.end()) return unknownMaterialError(candidates, name);
    applyMaterial(**found, copy);
    return writeStruct(body, body->size, copy);
}

} // namespace

const char* physvib_material_name(int index) {
    const char* name = nullptr;
    catchExceptions([&] {
        if (index >= 0 && index < std::ssize(vibratingMaterials()))
            name = vibratingMaterials()[static_cast<std::size_t>(index)]->name.c_str();
        return PHYSVIB_OK;
    });
    return name;
}

int physvib_material(const char* name, physvib_body* body) {
    return catchExceptions([&] {
        if (name == nullptr) return argumentError("material: expected a name, found NULL");
        return applyNamedMaterial(vibratingMaterials(), name, body);
    });
}

int physvib_material_load(const char* path, const char* name, physvib_body* body) {
    return catchExceptions([&] {
        if (path == nullptr || name == nullptr)
            return argumentError("material: expected a path and a name, found NULL");
        const auto table = loadMaterials(path);
        if (!table) return fail(PHYSVIB_ERROR_FILE, table.error);
        Materials all;
        addVibratingMaterials(table.value, all);
        return applyNamedMaterial(all, name, body);
    });
}

int physvib_sound(const char* name) {
    if (name == nullptr || *name == '\0') return argumentError("sound: expected a name");
    return toSoundNumber(name);
}

int physvib_event_of(const char* material, double x, double y, double strength, physvib_event* event) {
    if (event == nullptr) return argumentError("event: expected a place for it, found NULL");
    if (!(strength >= 0.0 && strength <= 1.0)) return argumentError("strength: expected 0 to 1");
    physvib_body body;
    physvib_body_init(&body, sizeof body);
    body.frequency_hz = 200.0; // the default: a ring of a quarter of a second, which most actuators can play
    body.decay_per_s = 30.0;
    if (material != nullptr)
        if (const int code = physvib_material(material, &body); code != PHYSVIB_OK) return code;
    physvib_event result = defaultEvent();
    result.frequency_hz = body.frequency_hz;
    result.decay_per_s = body.decay_per_s;
    result.amplitude = strength;
    result.x_m = x;
    result.y_m = y;
    if (material != nullptr) result.sound = physvib_sound(material);
    CollisionEvent checked;
    if (const auto error = readEvent(result, checked); !error.empty()) return argumentError(error);
    return writeEvents({&checked, 1}, event, 1) < 0 ? PHYSVIB_ERROR_ARGUMENT : PHYSVIB_OK;
}

int physvib_renderer_impact(physvib_renderer renderer, double x, double y, double strength) {
    return physvib_renderer_impact_of(renderer, nullptr, x, y, strength);
}

int physvib_renderer_impact_of(physvib_renderer handle, const char* material, double x, double y,
                               double strength) {
    physvib_event event = defaultEvent();
    if (const int code = physvib_event_of(material, x, y, strength, &event); code != PHYSVIB_OK) return code;
    const auto renderer = borrow(handle);
    if (!renderer) return unknownHandleError();
    {
        constexpr std::int64_t nsPerSecond = 1'000'000'000;
        const std::lock_guard lock{renderer->readerMutex};
        const std::int64_t frames = renderer->status.read().framesRendered, rateHz = renderer->rateHz;
        // rounded up, so that the event is not late; in two parts, which do not overflow
        event.time_ns = frames / rateHz * nsPerSecond + (frames % rateHz * nsPerSecond + rateHz - 1) / rateHz;
    }
    return physvib_renderer_strike(handle, &event);
}
