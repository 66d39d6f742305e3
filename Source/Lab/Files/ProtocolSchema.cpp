// SPDX-License-Identifier: MIT
// JSON schema of protocol files, from the same table of fields that reads and writes them.
#include "Io/Json/JsonLines.h"
#include "Lab/Files/ProtocolFields.h"
#include "Lab/Files/ProtocolFile.h"
#include <type_traits>

namespace physvib {
namespace {

template <class T>
OrderedJson objectSchema();

OrderedJson schemaOf(const bool&, const Bounds&) { return {{"type", "boolean"}}; }
OrderedJson schemaOf(const std::string&, const Bounds& bounds) {
    OrderedJson schema{{"type", "string"}};
    if (bounds.most > 0.0 && bounds.most < Bounds{}.most)
        schema["maxLength"] = static_cast<std::size_t>(bounds.most);
    return schema;
}
template <class Number>
requires std::is_arithmetic_v<Number> OrderedJson schemaOf(const Number&, const Bounds& bounds) {
    OrderedJson schema{{"type", std::is_integral_v<Number> ? "integer" : "number"}};
    if (bounds.least > Bounds{}.least) schema["minimum"] = bounds.least;
    if (bounds.most < Bounds{}.most) schema["maximum"] = bounds.most;
    return schema;
}
template <class T>
requires std::is_class_v<T> OrderedJson schemaOf(const T&, const Bounds&) { return objectSchema<T>(); }
template <class T>
OrderedJson schemaOf(const std::optional<T>&, const Bounds& bounds) {
    return schemaOf(T{}, bounds);
}
template <class T>
OrderedJson schemaOf(const std::vector<T>&, const Bounds& bounds) {
    OrderedJson schema{{"type", "array"}, {"items", schemaOf(T{}, bounds)}, {"minItems", bounds.fewestItems}};
    if (bounds.mostItems > 0) schema["maxItems"] = bounds.mostItems;
    return schema;
}

/// Visits the table of T.
template <class T>
struct SchemaWriter {
    OrderedJson properties = OrderedJson::object(), required = OrderedJson::array(),
                cases = OrderedJson::array();

    template <class F>
    void field(std::string_view name, F T::*, const Bounds& bounds, Need need) {
        properties[std::string(name)] = schemaOf(F{}, bounds);
        if (need == Need::required) required.push_back(std::string(name));
    }
    void choice(std::string_view name, const auto&, const auto& names) {
        properties[std::string(name)] = {{"enum", names}};
    }
    template <class... Kinds>
    void variant(std::string_view name, std::variant<Kinds...> T::*, const auto& names) {
        choice(name, nullptr, names);
        required.push_back(std::string(name));
        std::size_t index = 0;
        (add<Kinds>(std::string(name), std::string(names[index++])), ...);
    }

private:
    /// The fields of one kind, and those that it needs.
    template <class Kind>
    void add(const std::string& name, const std::string& kind) {
        SchemaWriter<Kind> own;
        visitFields(own, FieldsOf<Kind>{});
        for (const auto& [key, schema] : own.properties.items()) properties[key] = schema;
        cases.push_back(
            {{"if", {{"properties", {{name, {{"const", kind}}}}}}}, {"then", {{"required", own.required}}}});
    }
};

template <class T>
OrderedJson objectSchema() {
    SchemaWriter<T> writer;
    visitFields(writer, FieldsOf<T>{});
    OrderedJson schema{{"type", "object"},
                       {"properties", writer.properties},
                       {"required", writer.required},
                       {"additionalProperties", false}};
    if (!writer.cases.empty()) schema["allOf"] = writer.cases;
    return schema;
}

} // namespace

std::string protocolSchema() {
    OrderedJson schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                       {"title", "PhysVib study protocol"}};
    schema.update(objectSchema<Protocol>());
    OrderedJson& properties = schema["properties"];
    properties[protocolVersionField] = {
        {"type", "integer"}, {"minimum", 1}, {"maximum", protocolFormatVersion}};
    properties["$schema"] = {{"type", "string"}};
    schema["required"].push_back(protocolVersionField);
    return jsonLines(schema);
}

} // namespace physvib
