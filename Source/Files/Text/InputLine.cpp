// SPDX-License-Identifier: MIT
// Which of the kinds a line is; their fields are read where those of files are.
#include "Files/Text/InputLine.h"
#include "Files/ControlJson.h"
#include "Files/Json/JsonReader.h"

namespace physvib {

namespace {
struct ActionLine {
    Action action;
};
} // namespace

template <>
struct FieldsOf<ActionLine> {
    template <class V>
    static void visit(V& v) {
        v.variant("input", &ActionLine::action, actionNames);
    }
};

namespace {

LineInput readLine(const JsonField& json, const std::vector<Material>& materials, int channels) {
    json.expectObject();
    if (!json.has("control")) {
        ActionLine line;
        detail::readValue(json, line, {}, materials);
        return std::move(line.action);
    }
    if (!json["control"].is("silence")) return readControl(json, channels);
    json.expectObject({"control", "on"});
    return SilenceControl{json["on"].truth()};
}

} // namespace

Result<LineInput> readInputLine(std::string_view line, std::string_view name, const std::vector<Material>& materials, int channels) {
    try {
        const Json root = parseStrictly(line);
        return readLine(JsonField(root, {}), materials, channels);
    } catch (const JsonError& error) {
        return Failure{std::string(name) + ": " + error.what()};
    }
}

} // namespace physvib
