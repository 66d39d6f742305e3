// SPDX-License-Identifier: MIT
// Reads and writes the plug-in's state as JSON; the tables of its fields are in PluginState.h.
#include "Live/Documents/PluginState.h"
#include "Io/Text/NumberText.h"
#include "Live/Documents/DocumentJson.h"
#include "Scene/SceneFile.h"

namespace physvib {
namespace {

constexpr std::size_t mostNotes = 128, mostControllers = 120, mostParameters = 1000;

std::size_t sizeUpTo(const JsonField& list, std::size_t most) {
    const std::size_t size = list.arraySize();
    if (size > most)
        list.fail("expected at most " + std::to_string(most) + " items, found " + std::to_string(size));
    return size;
}

/// Reads a part with a file reader; its errors then begin with the field's name instead of a file name.
auto readPart(const JsonField& json, auto read) {
    auto part = read(json.fileText(), json.path());
    if (!part) throw JsonError({}, part.error);
    return std::move(part.value);
}

// JSON kinds of a note's fields.
struct MaterialOf {
    const Scene* scene;
};
struct Radius {
    double operator()(const JsonField& json) const {
        const double metres = json.numberUpTo(sceneLimits::maxSizeMetres);
        if (metres >= sceneLimits::minSizeMetres) return metres;
        json.fail("expected at least " + numberText(sceneLimits::minSizeMetres));
    }
};
struct Reach {
    double most;
}; // limit of both components

int readKind(const JsonField& json, const MaterialOf& kind) {
    const std::string wanted = json.text();
    const auto& materials = kind.scene->materials;
    const auto found = std::ranges::find(materials, wanted, &Material::name);
    if (found == materials.end())
        json.fail("expected the name of a material of the scene, found " + inQuotes(wanted));
    return static_cast<int>(found - materials.begin());
}
OrderedJson writeKind(const MaterialOf& kind, const int& material) {
    return kind.scene->materials[static_cast<std::size_t>(material)].name;
}

Vector readKind(const JsonField& json, const Reach& kind) {
    if (const std::size_t size = json.arraySize(); size != 2)
        json.fail("expected 2 numbers, found " + std::to_string(size) + " items");
    const Vector v{json.item(0).number(), json.item(1).number()};
    if (!(std::abs(v.x) <= kind.most && std::abs(v.y) <= kind.most))
        json.fail("expected up to " + numberText(kind.most));
    return v;
}
OrderedJson writeKind(const Reach&, const Vector& v) { return OrderedJson::array({v.x, v.y}); }

/// A rule with the scene whose materials and bodies it names.
struct SceneNote {
    NoteRule rule;
    const Scene* scene = nullptr;
};

// The fields of a rule depend on what it does.
void visitFields(auto& v, FieldsOf<SceneNote>) {
    constexpr auto rule = &SceneNote::rule;
    constexpr auto vector = in(rule, &NoteRule::atFullVelocity);
    v.field("note", in(rule, &NoteRule::note), kinds::whole(0, 127));
    v.field("do", in(rule, &NoteRule::kind), kinds::OneOf{noteKindNames});
    if (v.object.rule.kind == NoteKind::push) {
        v.field("object", in(rule, &NoteRule::object), kinds::text);
        v.field("impulse_ns", vector, Reach{sceneLimits::maxImpulseNewtonSeconds});
        return;
    }
    v.field("material", in(rule, &NoteRule::material), MaterialOf{v.object.scene});
    v.field("x", in(rule, &NoteRule::x), kinds::upTo(1.0));
    v.field("y", in(rule, &NoteRule::y), kinds::upTo(1.0));
    if (v.object.rule.kind == NoteKind::strike) return;
    v.field("radius_m", in(rule, &NoteRule::radiusMetres), Radius{});
    v.field("velocity_m_per_s", vector, Reach{sceneLimits::maxSpeedMetresPerSecond});
}

NoteRule readNote(const JsonField& json, const Scene& scene) {
    SceneNote note{{}, &scene};
    json.expectObject();
    note.rule.kind = static_cast<NoteKind>(json["do"].oneOf(noteKindNames)); // this value selects the fields
    readTable(json, note);
    const auto isThere = std::ranges::find(scene.bodies, note.rule.object, &BodyDescription::name);
    if (note.rule.kind == NoteKind::push && isThere == scene.bodies.end())
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

static Scene readKind(const JsonField& json, const Own<Scene>&) {
    return readPart(json, [](const auto& text, const auto& name) { return readScene(text, name); });
}
static OrderedJson writeKind(const Own<Scene>&, const Scene& scene) {
    return OrderedJson::parse(sceneJson(scene));
}

static LayoutDescription readKind(const JsonField& json, const kinds::LayoutFile&) {
    return readPart(json, readLayout);
}
static OrderedJson writeKind(const kinds::LayoutFile&, const LayoutDescription& layout) {
    return writeKind(Own<LayoutDescription>{}, layout);
}

static std::uint32_t readKind(const JsonField& json, const Own<std::uint32_t>&) {
    const double found = json.numberUpTo(4294967295.0);
    if (found != std::floor(found)) json.fail("expected a whole number, found " + numberText(found));
    return static_cast<std::uint32_t>(found);
}
static OrderedJson writeKind(const Own<std::uint32_t>&, const std::uint32_t& seed) { return seed; }

static std::vector<NoteRule> readKind(const JsonField& list, const kinds::Notes& kind) {
    std::vector<NoteRule> notes;
    for (std::size_t i = 0, n = sizeUpTo(list, mostNotes); i < n; ++i)
        notes.push_back(readNote(list.item(i), *kind.scene));
    return notes;
}
static OrderedJson writeKind(const kinds::Notes& kind, const std::vector<NoteRule>& notes) {
    OrderedJson list = OrderedJson::array();
    for (const NoteRule& rule : notes) list.push_back(writeTable(SceneNote{rule, kind.scene}));
    return list;
}

static std::vector<ControllerRule> readKind(const JsonField& list, const Own<std::vector<ControllerRule>>&) {
    sizeUpTo(list, mostControllers);
    return kinds::Objects<ControllerRule>{}(list);
}
static OrderedJson writeKind(const Own<std::vector<ControllerRule>>&,
                             const std::vector<ControllerRule>& rules) {
    return kinds::Objects<ControllerRule>{}.write(rules);
}

static std::pair<int, int> readKind(const JsonField& json, const EditorSize&) {
    constexpr double mostPixels = 20'000;
    const Vector size = readKind(json, Reach{mostPixels});
    return {static_cast<int>(size.x), static_cast<int>(size.y)};
}
static OrderedJson writeKind(const EditorSize&, const std::tuple<const int&, const int&>& size) {
    const auto& [width, height] = size;
    return OrderedJson::array({std::max(width, 0), width > 0 ? height : 0});
}

static ParameterValues readKind(const JsonField& json, const Own<ParameterValues>&) {
    ParameterValues values;
    const auto names = json.names();
    if (names.size() > mostParameters)
        json.fail("expected at most " + std::to_string(mostParameters) + " parameters");
    for (const std::string& name : names) {
        const JsonField value = json[name];
        values.emplace_back(name, value.isText() ? ParameterValue{value.text()} : value.number());
    }
    return values;
}
static OrderedJson writeKind(const Own<ParameterValues>&, const ParameterValues& values) {
    OrderedJson json = OrderedJson::object();
    for (const auto& [id, value] : values)
        std::visit([&place = json[id]](const auto& it) { place = it; }, value);
    return json;
}

Result<PluginState> readPluginState(std::string_view text, std::string_view name) {
    return readJson(text, name, limits::maxSceneFileBytes,
                    [](const Json& root) { return readStateRoot(JsonField(root, {})); });
}

std::string pluginStateJson(const PluginState& state) { return jsonLines(writeTable(state)); }

} // namespace physvib
