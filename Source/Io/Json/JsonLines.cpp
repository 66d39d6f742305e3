// SPDX-License-Identifier: MIT
// Lines are broken where a person would: a list of objects item by item, a short list not at all.
#include "Io/Json/JsonLines.h"
#include "Io/Text/NumberText.h"
#include <cmath>
#include <cstddef>
#include <iterator>

template class nlohmann::basic_json<nlohmann::ordered_map>;

namespace physvib {

std::string jsonNumber(double number) {
    return number == 0.0 && std::signbit(number) ? "-0.0" : numberText(number);
}

// Bytes that are no UTF-8 cannot stand in JSON and become U+FFFD.
std::string jsonLine(const OrderedJson& value) {
    if (value.is_number_float()) return jsonNumber(value.get<double>());
    if (!value.is_structured()) return value.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
    std::string text = value.is_array() ? "[" : "{ ";
    for (auto item = value.begin(); item != value.end(); ++item) {
        if (item != value.begin()) text += ", ";
        if (value.is_object()) text += jsonLine(OrderedJson(item.key())) + ": ";
        text += jsonLine(*item);
    }
    return text + (value.is_array() ? "]" : " }");
}

namespace {

void appendLines(std::string& out, const OrderedJson& value, std::size_t indent, std::size_t column) {
    constexpr std::size_t longestLine = 140;
    std::string line = jsonLine(value);
    const bool holdsObjects = value.is_array() && !value.empty() && value.front().is_object();
    const bool isTop = indent == 0 || (indent == 2 && holdsObjects); // a list of bodies is never a line
    const bool isList = value.is_structured() && !value.empty();
    if (!isList || (!isTop && column + line.size() < longestLine)) {
        out += line;
        return;
    }
    const std::string margin(indent + 2, ' ');
    out += value.is_array() ? "[\n" : "{\n";
    for (auto item = value.begin(); item != value.end(); ++item) {
        const std::string name = value.is_object() ? jsonLine(OrderedJson(item.key())) + ": " : "";
        out += margin + name;
        appendLines(out, *item, indent + 2, margin.size() + name.size());
        out += std::next(item) == value.end() ? "\n" : ",\n";
    }
    out += std::string(indent, ' ') + (value.is_array() ? "]" : "}");
}

} // namespace

std::string jsonLines(const OrderedJson& value) {
    std::string out;
    appendLines(out, value, 0, 0);
    return out + "\n";
}

} // namespace physvib
