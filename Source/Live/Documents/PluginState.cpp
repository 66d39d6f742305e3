// SPDX-License-Identifier: MIT
// Reads and writes the plug-in's state as JSON; the tables of its fields are in PluginState.h.
#include "Live/Documents/PluginState.h"
#include "Io/Text/NumberText.h"
#include "Live/Documents/DocumentJson.h"
#include "Scene/SceneFile.h"

namespace physvib {
namespace {

constexpr std::size_t maxNotes = 128, maxControllers = 120, maxParameters = 1000;

std::size_t checkedSize(const JsonField& list, std::size_t maxItems) {
    const std::size_t size = list.arraySize();
    if (size > maxItems)
        list.fail("expected at most " + std::to_string(maxItems) + " items, found " + std::to_string(size));
    return size;
}

/// Reads a part with a file reader; its errors then begin with the field's name instead of a file name.
auto readEmbedded(const JsonField& json, auto read) {
    auto part = read(json.jsonText(), json.path());
    if (!part) throw JsonError({}, part.error);
    return std::move(part.value);
}

// JSON kinds of a note's fields.
struct MaterialName {
    const Scene* scene;
};
struct Radius {
    double operator()(const JsonField& json) const {
        const double metres = json.numberUpTo(sceneLimits::maxSizeMetres);
        if (metres >= sceneLimits::minSizeMetres) return metres;
        json.fail("expected at least " + numberText(sceneLimits::minSizeMetres));
    }
};
struct ComponentLimit {
    double max;
}; // a vector; `max` limits both components

int readCustom(const JsonField& json, const MaterialName& kind) {
    const std::string name = json.text();
    const auto& materials = kind.scene->materials;
    const auto found = std::ranges::find(materials, name, &Material::name);
    if (found == materials.end())
        json.fail("expected the name of a material of the scene, found " + inQuotes(name));
    return static_cast<int>(found - materials.begin());
}
OrderedJson writeCustom(const MaterialName& kind, const int& material) {
    return kind.scene->materials[static_cast<std::size_t>(material)].name;
}

Vector readCustom(const JsonField& json, const ComponentLimit& kind) {
    if (const std::size_t size = json.arraySize(); size != 2)
        json.fail("expected 2 numbers, found " + std::to_string(size) + " items");
    const Vector v{json.item(0).number(), json.item(1).number()};
    if (!(std::abs(v.x) <= kind.max && std::abs(v.y) <= kind.max))
        json.fail("expected up to " + numberText(kind.max));
    return v;
}
OrderedJson writeCustom(const ComponentLimit&, const Vector& v) { return OrderedJson::array({v.x, v.y}); }

/// A rule with the scene whose materials and bodies it names.
struct SceneNote {
    NoteRule rule;
    const Scene* scene = nullptr;
};

// Which fields a rule has depends on its kind ("do").
void visitFields(auto& v, FieldsOf<SceneNote>) {
    constexpr auto rule = &SceneNote::rule;
    constexpr auto vector = nest(rule, &NoteRule::atFullVelocity);
    v.field("note", nest(rule, &NoteRule::note), kinds::wholeNumber(0, 127));
    v.field("do", nest(rule, &NoteRule::kind), kinds::OneOf{noteKindNames});
    if (v.object.rule.kind == NoteKind::push) {
        v.field("object", nest(rule, &NoteRule::object), kinds::text);
        v.field("impulse_ns", vector, ComponentLimit{sceneLimits::maxImpulseNewtonSeconds});
        return;
    }
    v.field("material", nest(rule, &NoteRule::material), MaterialName{v.object.scene});
    v.field("x", nest(rule, &NoteRule::x), kinds::upTo(1.0));
    v.field("y", nest(rule, &NoteRule::y), kinds::upTo(1.0));
    if (v.object.rule.kind == NoteKind::strike) return;
    v.field("radius_m", nest(rule, &NoteRule::radiusMetres), Radius{});
    v.field("velocity_m_per_s", vector, ComponentLimit{sceneLimits::maxSpeedMetresPerSecond});
}

NoteRule readNote(const JsonField& json, const Scene& scene) {
    SceneNote note{{}, &scene};
    json.expectObject();
    note.rule.kind = static_cast<NoteKind>(json["do"].oneOf(noteKindNames)); // this value selects the fields
    readTable(json, note);
    const auto body = std::ranges::find(scene.bodies, note.rule.object, &BodyDescription::name);
    if (note.rule.kind == NoteKind::push && body == scene.bodies.end())
        json["object"].fail("expected the name of a body that the scene starts with, found " +
                            inQuotes(note.rule.object));
    return note.rule;
}

// Version 1 gave these to every instance, though no user had chosen them. Left in place, they would let a
// host's controllers change the vibration unexpectedly.
const std::vector<ControllerRule> controllersOfVersion1{
    {1, "tilt"}, {7, "level"}, {16, "gravity"}, {17, "exponent"}};

PluginState readStateRoot(const JsonField& root) {
    PluginState state;
    readTable(root, state);
    if (state.strips.empty()) resizeStrips(state.strips, state.layout.geometry.count); // version 1
    if (root["physvib_plugin_state"].wholeNumber() == 1 && state.controllers == controllersOfVersion1)
        state.controllers.clear();
    return state;
}

} // namespace

static Scene readCustom(const JsonField& json, const Custom<Scene>&) {
    return readEmbedded(json, [](const auto& text, const auto& name) { return readScene(text, name); });
}
static OrderedJson writeCustom(const Custom<Scene>&, const Scene& scene) {
    return OrderedJson::parse(sceneJson(scene));
}

static LayoutDescription readCustom(const JsonField& json, const kinds::LayoutFile&) {
    return readEmbedded(json, readLayout);
}
static OrderedJson writeCustom(const kinds::LayoutFile&, const LayoutDescription& layout) {
    return writeCustom(Custom<LayoutDescription>{}, layout);
}

static std::vector<NoteRule> readCustom(const JsonField& list, const kinds::Notes& kind) {
    std::vector<NoteRule> notes;
    for (std::size_t i = 0, n = checkedSize(list, maxNotes); i < n; ++i)
        notes.push_back(readNote(list.item(i), *kind.scene));
    return notes;
}
static OrderedJson writeCustom(const kinds::Notes& kind, const std::vector<NoteRule>& notes) {
    OrderedJson list = OrderedJson::array();
    for (const NoteRule& rule : notes) list.push_back(writeTable(SceneNote{rule, kind.scene}));
    return list;
}

static std::vector<ControllerRule> readCustom(const JsonField& list,
                                              const Custom<std::vector<ControllerRule>>&) {
    checkedSize(list, maxControllers);
    return kinds::Objects<ControllerRule>{}(list);
}
static OrderedJson writeCustom(const Custom<std::vector<ControllerRule>>&,
                               const std::vector<ControllerRule>& rules) {
    return kinds::Objects<ControllerRule>{}.write(rules);
}

static std::pair<int, int> readCustom(const JsonField& json, const EditorSize&) {
    constexpr double maxPixels = 20'000;
    const Vector size = readCustom(json, ComponentLimit{maxPixels});
    return {static_cast<int>(size.x), static_cast<int>(size.y)};
}
static OrderedJson writeCustom(const EditorSize&, const std::tuple<const int&, const int&>& size) {
    const auto& [width, height] = size;
    return OrderedJson::array({std::max(width, 0), width > 0 ? height : 0});
}

static ParameterValues readCustom(const JsonField& json, const Custom<ParameterValues>&) {
    ParameterValues values;
    const auto names = json.names();
    if (names.size() > maxParameters)
        json.fail("expected at most " + std::to_string(maxParameters) + " parameters");
    for (const std::string& name : names) {
        const JsonField value = json[name];
        values.emplace_back(name, value.isText() ? ParameterValue{value.text()} : value.number());
    }
    return values;
}
static OrderedJson writeCustom(const Custom<ParameterValues>&, const ParameterValues& values) {
    OrderedJson json = OrderedJson::object();
    for (const auto& [id, value] : values)
        std::visit([&field = json[id]](const auto& plain) { field = plain; }, value);
    return json;
}

Result<PluginState> readPluginState(std::string_view text, std::string_view name) {
    return readJson(text, name, limits::maxSceneFileBytes,
                    [](const Json& root) { return readStateRoot(JsonField(root, {})); });
}

std::string pluginStateJson(const PluginState& state) { return prettyJson(writeTable(state)); }

} // namespace physvib
