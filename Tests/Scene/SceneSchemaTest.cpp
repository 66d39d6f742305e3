// SPDX-License-Identifier: MIT
// The published schema says what the reader does: the same fields, ranges and words.
#include "Io/Disk/ReadFile.h"
#include "Scene/SceneFields.h"
#include "TestPlaces.h"
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

namespace physvib {
namespace {

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
    void field(std::string_view name, F T::*, const Bounds& bounds, Need need) {
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
    static void expect(const Json& json, std::type_identity<double>, const Bounds& bounds) {
        EXPECT_EQ(json["type"], "number") << json;
        EXPECT_EQ(json["minimum"].get<double>(), bounds.least) << json;
        EXPECT_EQ(json["maximum"].get<double>(), bounds.most) << json;
    }
    static void expect(const Json& json, std::type_identity<int>, const Bounds& bounds) {
        EXPECT_EQ(json["type"], "integer") << json;
        EXPECT_EQ(json["minimum"].get<double>(), bounds.least) << json;
        EXPECT_EQ(json["maximum"].get<double>(), bounds.most) << json;
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
        EXPECT_EQ(json.value("minItems", 0U), bounds.fewestItems) << json;
        EXPECT_EQ(json["maxItems"], bounds.mostItems) << json;
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

} // namespace
} // namespace physvib
