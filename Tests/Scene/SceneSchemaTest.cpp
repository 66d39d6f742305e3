// SPDX-License-Identifier: MIT
// The published schema says what the reader does: the same fields, ranges and words.
#include "DropScene.h"
#include "Io/Disk/ReadFile.h"
#include "Scene/SceneFields.h"
#include "Scene/SceneFile.h"
#include "Scene/SceneValidation.h"
#include "TestPlaces.h"
#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

namespace physvib::scene_schema_test {

using Json = nlohmann::json;

const Json& schema() {
    static const Json json =
        Json::parse(readFile(PHYSVIB_SOURCE_DIR "/Source/Scene/Scenes/scene.schema.json", 1'000'000).value);
    return json;
}

const Json& referred(const Json& json) {
    return schema()["$defs"][json["$ref"].get<std::string>().substr(std::string("#/$defs/").size())];
}

/// The definition of a kind of thing, with what it takes from another; "" is the scene itself.
Json definition(const std::string& name) {
    Json own = name.empty() ? schema() : schema()["$defs"][name];
    if (!own.contains("$ref")) return own;
    const Json& other = referred(own);
    own["properties"].update(other["properties"]);
    for (const Json& required : other["required"]) own["required"].push_back(required);
    own["allOf"] = other["allOf"];
    return own;
}

/// A field's values, where they are described once for several fields.
const Json& values(const Json& json) {
    return json.contains("$ref") && !referred(json).contains("properties") ? referred(json) : json;
}

template <class T>
const char* definitionOf() {
    if constexpr (std::is_same_v<T, Material>) return "material";
    if constexpr (std::is_same_v<T, FixtureDescription>) return "fixture";
    if constexpr (std::is_same_v<T, BodyDescription>) return "body";
    if constexpr (std::is_same_v<T, JointDescription>) return "joint";
    if constexpr (std::is_same_v<T, ScriptInput>) return "input";
    if constexpr (std::is_same_v<T, LiveInput>) return "live-input";
    return "normalisation";
}

template <class T>
void expectDefinition(const std::string& name, std::set<std::string> alsoKnown = {});

/// Compares the table of T with a definition.
template <class T>
class SchemaCheck {
public:
    explicit SchemaCheck(const std::string& name)
        : definition_(definition(name)) {}

    template <class F>
    void field(std::string_view name, F T::*, const Bounds& bounds, Need need = Need::required) {
        const Json& found = take(name, need);
        expect(found, std::type_identity<F>{}, bounds);
    }
    void pair(std::string_view name, double T::*, double T::*, const Bounds& bounds) {
        expect(take(name, Need::required), std::type_identity<Vector>{}, bounds);
    }
    template <class E, class Names>
    void choice(std::string_view name, E T::*, const Names& names) {
        EXPECT_EQ(take(name, Need::optional)["enum"], Json(names));
    }
    void material(std::string_view name, int T::*) {
        EXPECT_EQ(take(name, Need::required)["type"], "string");
    }
    template <class... Kinds, class Names>
    void variant(std::string_view name, std::variant<Kinds...> T::*, const Names& names) {
        EXPECT_EQ(take(name, Need::required)["enum"], Json(names));
        std::size_t kind = 0;
        ((expectKind<Kinds>(name, std::string(names[kind]), kind), ++kind), ...);
        EXPECT_EQ(definition_["allOf"].size(), sizeof...(Kinds));
        EXPECT_EQ(definition_["unevaluatedProperties"], false);
    }

    void finish(std::set<std::string> alsoKnown) {
        known_.merge(alsoKnown);
        std::set<std::string> properties, required;
        for (const auto& item : definition_["properties"].items()) properties.insert(item.key());
        for (const Json& name : definition_["required"]) required.insert(name.get<std::string>());
        EXPECT_EQ(properties, known_);
        EXPECT_EQ(required, required_);
        for (const auto& item : definition_["properties"].items())
            EXPECT_TRUE(item.value().contains("description") ||
                        referred(item.value()).contains("description"))
                << item.key();
    }

    std::set<std::string>& required() { return required_; }

private:
    const Json& take(std::string_view name, Need need) {
        known_.emplace(name);
        if (need == Need::required) required_.emplace(name);
        return values(definition_["properties"][std::string(name)]);
    }

    template <class Kind>
    void expectKind(std::string_view tag, const std::string& word, std::size_t index) {
        const Json& rule = definition_["allOf"][index];
        EXPECT_EQ(rule["if"]["properties"][std::string(tag)]["const"], word);
        expectDefinition<Kind>(
            rule["then"]["$ref"].get<std::string>().substr(std::string("#/$defs/").size()));
    }

    static void expect(const Json& json, std::type_identity<std::string>, const Bounds&) {
        EXPECT_EQ(json["type"], "string") << json;
    }
    static void expect(const Json& json, std::type_identity<bool>, const Bounds&) {
        EXPECT_EQ(json["type"], "boolean") << json;
    }
    template <class F>
    requires std::is_arithmetic_v<F>
    static void expect(const Json& json, std::type_identity<F>, const Bounds& bounds) {
        EXPECT_EQ(json["type"], std::is_integral_v<F> ? "integer" : "number") << json;
        EXPECT_EQ(json["minimum"].get<double>(), bounds.min) << json;
        EXPECT_EQ(json["maximum"].get<double>(), bounds.max) << json;
    }
    static void expect(const Json& json, std::type_identity<Vector>, const Bounds& bounds) {
        expect(json["items"], std::type_identity<double>{}, bounds);
        EXPECT_EQ(json["minItems"], 2) << json;
        EXPECT_EQ(json["maxItems"], 2) << json;
    }
    static void expect(const Json& json, std::type_identity<Interval>, const Bounds& bounds) {
        expect(json, std::type_identity<Vector>{}, bounds);
    }
    template <class F>
    static void expect(const Json& json, std::type_identity<std::optional<F>>, const Bounds& bounds) {
        expect(json, std::type_identity<F>{}, bounds);
    }
    template <class F>
    static void expect(const Json& json, std::type_identity<std::vector<F>>, const Bounds& bounds) {
        expect(values(json["items"]), std::type_identity<F>{}, bounds);
        EXPECT_EQ(json.value("minItems", 0U), bounds.minItems) << json;
        EXPECT_EQ(json["maxItems"], bounds.maxItems) << json;
    }
    template <class F>
    static void expect(const Json& json, std::type_identity<F>, const Bounds&) {
        const Json& reference = json.contains("anyOf") ? json["anyOf"][1] : json;
        EXPECT_EQ(reference["$ref"], std::string("#/$defs/") + definitionOf<F>());
    }

    Json definition_;
    std::set<std::string> known_, required_;
};

template <class T>
void expectDefinition(const std::string& name, std::set<std::string> alsoKnown) {
    SCOPED_TRACE(name);
    SchemaCheck<T> check(name);
    visitFields(check, FieldsOf<T>{});
    if (name.empty()) check.required().insert("physvib_scene");
    check.finish(std::move(alsoKnown));
}

TEST(SceneSchema, HasTheFieldsOfTheReaderAndNoOther) {
    expectDefinition<Scene>("", {"physvib_scene", "variables"});
    expectDefinition<Material>("material");
    expectDefinition<FixtureDescription>("fixture");
    expectDefinition<BodyDescription>("body");
    expectDefinition<JointDescription>("joint");
    expectDefinition<ScriptInput>("input");
    expectDefinition<LiveInput>("live-input");
    expectDefinition<Normalisation>("normalisation");
}

TEST(SceneSchema, RefusesUnknownFields) {
    for (const std::string name : {"", "material", "body", "normalisation", "variable", "choice"})
        EXPECT_EQ(definition(name)["additionalProperties"], false) << name;
}

// Every number and every truth in a scene's file counts for itself alone: changed a little, something moves
// or is felt otherwise. What does not is named here.

using nlohmann::json;

BodyDescription body(const std::string& name, Shape shape, Vector at, int material = 1) {
    BodyDescription made{name, BodyType::dynamicBody, {{std::move(shape), {}, 0.0, material}}, at};
    made.fixtures[0].isCamera = true;
    return made;
}

/// Something of everything.
Scene richScene() {
    Scene scene;
    scene.name = "rich";
    scene.fieldWidthMetres = 8.0;
    scene.fieldHeightMetres = 6.0;
    scene.gravityMetresPerSecond2 = {0.5, -9.8};
    scene.driveGain = 3.0;
    scene.materials = {{"floor", 1000.0, 0.5, 0.3, 80.0, 34.0, 0.01, 1.5, GrainPattern::regular, 0.4},
                       {"rubber", 120.0, 0.6, 0.5, 205.0, 40.0, 0.02, 1.2, GrainPattern::random, 0.3},
                       {"steel", 500.0, 0.2, 0.4, 430.0, 12.0}};
    BodyDescription floor = body("floor", BoxShape{8.0, 0.3}, {4.0, 0.2}, 0);
    floor.type = BodyType::staticBody;
    floor.massKg = 500.0;
    floor.angleRadians = 0.02;
    floor.fixtures[0].restitution = 0.35;
    BodyDescription ball = body("ball", CircleShape{0.2}, {1.0, 1.0});
    ball.velocityMetresPerSecond = {1.0, -1.0};
    ball.spinRadiansPerSecond = 3.0;
    ball.linearDampingPerSecond = 0.3;
    ball.angularDampingPerSecond = 0.4;
    BodyDescription wedge =
        body("wedge", PolygonShape{{{-0.3, -0.2}, {0.3, -0.2}, {0.1, 0.3}}}, {2.2, 0.9}, 2);
    wedge.fixtures[0].offsetMetres = {0.03, 0.02};
    wedge.fixtures[0].angleRadians = 0.2;
    wedge.massKg = 7.0;
    BodyDescription ground =
        body("ground", ChainShape{{{8.0, 0.7}, {7.4, 0.4}, {6.6, 0.45}}, false}, {0.1, 0.1}, 2);
    ground.type = BodyType::staticBody;
    ground.massKg = 300.0;
    scene.bodies = {floor, ball, wedge, ground};
    const auto pair = [&](const std::string& name, double x, Joint joint) {
        scene.bodies.push_back(body(name + " a", BoxShape{0.3, 0.2}, {x, 0.8}, 2));
        scene.bodies.push_back(body(name + " b", BoxShape{0.2, 0.2}, {x + 0.15, 1.4}, 1));
        scene.joints.push_back({name, name + " a", name + " b", std::move(joint), true});
    };
    pair("hinge", 3.0, RevoluteJoint{{3.1, 1.1}, Interval{-0.3, 0.4}, 2.0, 3.0});
    pair("wheel", 3.8, WheelJoint{{3.9, 1.1}, {0.1, 1.0}, 3.0, 0.3, Interval{-0.1, 0.15}, 4.0, 2.0});
    pair("spring", 4.6, DistanceJoint{{4.6, 0.85}, {4.75, 1.35}, 4.0, 0.2, false});
    pair("seam", 5.4, WeldJoint{{5.5, 1.1}, 5.0, 0.3});
    pair("slider", 6.2, SliderJoint{{6.3, 1.1}, {0.2, 1.0}, Interval{-0.15, 0.2}, 0.5, 30.0});
    scene.bodies.push_back(body("falls", CircleShape{0.15}, {7.0, 1.2}));
    const BodyDescription coin = body("coin", CircleShape{0.1}, {1.6, 2.0});
    scene.script = {{0.1, 2, 0.25, ImpulseAction{"ball", {4.0, 6.0}, Vector{0.05, 0.02}}},
                    {0.15, 1, 0.0, VelocityAction{"wedge", {1.0, 2.0}, 1.5}},
                    {0.2, 2, 0.15, SpawnAction{coin, {0.1, 0.05}}},
                    {0.6, 1, 0.0, GravityAction{{1.0, -8.0}}},
                    {0.7, 1, 0.0, TiltAction{0.2}},
                    {0.5, 1, 0.0, MotorAction{"wheel", -3.0, 4.0}},
                    {0.3, 1, 0.0, GripAction{"falls", Vector{6.5, 1.5}, Vector{0.05, 0.02}, 0.3}},
                    {0.35, 1, 0.0, SoundAction{1, 220.0, 30.0}},
                    {0.4, 1, 0.0, TextureAction{0, 0.015, 1.3, GrainPattern::random, 0.5}},
                    {0.45, 1, 0.0, HoldAction{0.8, 0.1}}};
    scene.scriptPeriodSeconds = 1.1;
    return scene;
}

std::string playedOf(const Scene& scene) {
    Simulation world{scene, 3, 100};
    std::vector<CollisionEvent> events;
    std::string words;
    const auto add = [&](double value) { words += std::to_string(value) + ' '; };
    for (int step = 0; step < 160; ++step) {
        world.step(events);
        if (step % 20 != 19) continue;
        for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
            const BodyPose pose = world.pose(i);
            add(pose.xMetres), add(pose.yMetres), add(pose.angleRadians);
        }
    }
    for (const CollisionEvent& e : events) {
        for (const double value :
             {static_cast<double>(e.timeNs), e.frequencyHz, e.decayPerSecond, 1e3 * e.amplitude, e.x, e.y,
              e.source.impulseNewtonSeconds, e.source.massKg})
            add(value);
        add(e.source.fixture), add(e.source.other), add(static_cast<double>(e.source.kind));
    }
    return words;
}

TEST(EveryField, OfASceneCountsForItselfAlone) {
    const Scene scene = richScene();
    ASSERT_EQ(validate(scene), "");
    const std::string text = sceneJson(scene);
    const auto whole = readScene(text, "rich");
    ASSERT_EQ(whole.error, "");
    ASSERT_TRUE(whole.value == scene) << "what is written is read again";
    const json file = json::parse(text), flat = file.flatten();
    const std::string before = playedOf(scene);
    std::map<std::string, bool> counts; // by the pointer without its places in lists
    for (const auto& [pointer, value] : flat.items()) {
        std::vector<json> others;
        if (value.is_boolean())
            others = {!value.get<bool>()};
        else if (value.is_number_integer() && pointer.find("times") != std::string::npos)
            others = {value.get<int>() + 1};
        else if (value.is_number())
            others = {1.1 * value.get<double>() + 0.03, 0.9 * value.get<double>() - 0.03};
        if (others.empty()) continue;
        bool& isCounted = counts[std::regex_replace(pointer, std::regex("/[0-9]+"), "")];
        for (const json& other : others) {
            if (isCounted) break;
            json changed = file;
            changed[json::json_pointer{pointer}] = other;
            if (const auto read = readScene(changed.dump(), "changed"))
                isCounted = playedOf(read.value) != before;
        }
    }
    EXPECT_GT(counts.size(), 60U);
    for (const auto& [pointer, isCounted] : counts)
        EXPECT_TRUE(isCounted || pointer == "/physvib_scene") << pointer << ": its change changes nothing";
}

} // namespace physvib::scene_schema_test
