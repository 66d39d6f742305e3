// SPDX-License-Identifier: MIT
// Parses an input line: determines its kind, and reads the fields with the readers of the file formats.
#include "Live/Documents/InputLine.h"
#include "Io/Text/NumberText.h"
#include "Live/Documents/DocumentJson.h"
#include "Scene/SceneJson.h"

namespace physvib {

namespace {
struct ActionLine {
    Action action;
};
void visitFields(auto& v, FieldsOf<ActionLine>) { v.variant("input", &ActionLine::action, actionNames); }

constexpr std::size_t maxNumbers = 1024; // in a list
constexpr std::string_view silenceName = "silence", onName = "on";

void addNumbers(const JsonField& list, std::vector<double>& numbers, bool isPair) {
    const std::size_t count = list.arraySize();
    if (isPair && count != 2) list.fail("expected a pair of numbers");
    if (count > maxNumbers) list.fail("expected at most " + std::to_string(maxNumbers) + " numbers");
    for (std::size_t i = 0; i < count; ++i) {
        if (!isPair && list.item(i).isArray())
            addNumbers(list.item(i), numbers, true);
        else
            numbers.push_back(list.item(i).number());
    }
}

PlainValue readPlain(const JsonField& json) {
    if (json.isNumber()) return json.number();
    if (!json.isArray()) return json.text();
    std::vector<double> numbers;
    addNumbers(json, numbers, false);
    return numbers;
}

PlainMessage readMessage(const JsonField& json) {
    PlainMessage message{json["message"].text(), {}};
    for (const std::string& name : json.names())
        if (name != "message") message.values.push_back({name, readPlain(json[name])});
    return message;
}

/// An input or a control, whatever other kinds its fields name.
LineInput readAction(const JsonField& json, const std::vector<Material>& materials, int channels) {
    if (!json.has("control")) {
        ActionLine line;
        detail::readValue(json, line, {}, materials);
        return std::move(line.action);
    }
    if (!json["control"].equals(silenceName)) return readControl(json, channels);
    json.expectObject({"control", "on"});
    return SilenceControl{json["on"].boolean()};
}

constexpr std::string_view idName = "id";
constexpr double maxId = 9'007'199'254'740'991; // larger integers are not exact in JSON

bool isId(double number) { return std::abs(number) <= maxId && number == std::floor(number); }

/// Removes the number from `root`, so that the other readers do not see it.
std::optional<double> extractId(Json& root) {
    if (!root.is_object() || !root.contains(idName)) return std::nullopt;
    const JsonField field = JsonField(root, {})[idName];
    const double id = field.number();
    if (!isId(id))
        field.fail("expected a whole number from -" + plainNumber(maxId) + " to " + plainNumber(maxId));
    root.erase(std::string(idName));
    return id;
}

/// The number after the first "id" of a line that may be malformed.
std::optional<double> findId(std::string_view line) {
    constexpr std::string_view key = "\"id\"", blank = " \t";
    const auto keyAt = line.find(key);
    const auto colon = keyAt == line.npos ? keyAt : line.find_first_not_of(blank, keyAt + key.size());
    const auto begin =
        colon == line.npos || line[colon] != ':' ? line.npos : line.find_first_not_of(blank, colon + 1);
    if (begin == line.npos) return std::nullopt;
    const auto id = parseNumber<double>(line.substr(begin, line.find_first_of(",} \t\r", begin) - begin));
    return id && isId(*id) ? id : std::nullopt;
}

bool isControl(const std::string& name) {
    return name == silenceName || std::ranges::find(controlNames, name) != controlNames.end();
}

} // namespace

std::string answerLine(const PlainMessage& answer) {
    OrderedJson json{{"answer", answer.name}};
    for (const NamedValue& value : answer.values)
        json[value.name] = std::visit([](const auto& plain) { return OrderedJson(plain); }, value.value);
    return compactJson(json);
}

InputLine readInputLine(std::string_view line, const std::vector<Material>& materials, int channels) {
    std::optional<double> id = findId(line);
    InputLine read = [&]() -> InputLine {
        try {
            Json root = parseStrictly(line);
            id = extractId(root);
            const JsonField json(root, {});
            json.expectObject();
            return json.has("message") ? LineInput{readMessage(json)} : readAction(json, materials, channels);
        } catch (const JsonError& error) {
            return Failure{error.what()};
        }
    }();
    read.id = id;
    return read;
}

bool containsSilenceWord(std::string_view text) noexcept {
    constexpr char toLower = 'a' - 'A';
    const auto isSame = [](char found, char wanted) { return (found | toLower) == wanted; };
    const auto end = text.end();
    return std::search(text.begin(), end, silenceName.begin(), silenceName.end(), isSame) != end;
}

// Names may be written with JSON escapes. The control needs no scene; whether an input fits the scene is
// checked when it is executed.
bool requestsSilence(std::string_view line) {
    if (!containsSilenceWord(line) && line.find('\\') == line.npos) return false;
    const auto read = readInputLine(line, {}, 1);
    if (const auto* silence = std::get_if<SilenceControl>(&read.value)) return silence->isOn;
    std::string kinds;
    try {
        const Json root = parseStrictly(line);
        for (const char* kind : {"control", "input", "message"})
            if (root.is_object() && root.contains(kind) && root[kind].is_string())
                kinds += root[kind].get_ref<const std::string&>() + '\n';
    } catch (const JsonError&) {
    }
    return containsSilenceWord(kinds.empty() ? line : kinds);
}

Result<LineInput> readPlainInput(const PlainMessage& plain, const std::vector<Material>& materials,
                                 int channels) {
    if (!isControl(plain.name) && std::ranges::find(actionNames, plain.name) == actionNames.end())
        return Failure{inQuotes(plain.name) + ": expected the name of a message, an input or a control"};
    Json json{{isControl(plain.name) ? "control" : "input", plain.name}};
    for (const NamedValue& value : plain.values) {
        if (json.contains(value.name))
            return Failure{plain.name + ": " + printable(value.name) + ": expected once"};
        const auto* number = std::get_if<double>(&value.value);
        if (number != nullptr && value.name == onName)
            json[value.name] = *number != 0.0;
        else
            json[value.name] = std::visit([](const auto& found) { return Json(found); }, value.value);
    }
    try {
        return readAction(JsonField(json, {}), materials, channels);
    } catch (const JsonError& error) {
        return Failure{plain.name + ": " + error.what()};
    }
}

Result<SilenceControl> readPlainSilence(const std::vector<NamedValue>& values) {
    const auto* flag = values.size() == 1 ? std::get_if<double>(&values.front().value) : nullptr;
    if (flag == nullptr || values.front().name != onName) return Failure{"silence: expected on, and 1 or 0"};
    return SilenceControl{*flag != 0.0};
}

} // namespace physvib
