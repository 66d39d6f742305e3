// SPDX-License-Identifier: MIT
// Formats JSON with readable line breaks: a list of objects item by item, a short list on one line.
#include "Io/Json/JsonText.h"
#include "Io/Text/NumberText.h"
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

template class nlohmann::basic_json<nlohmann::ordered_map>; // compiled here only, because it takes long

namespace physvib {

std::string jsonNumber(double number) {
    return number == 0.0 && std::signbit(number) ? "-0.0" : numberText(number);
}

namespace {

void appendCompact(std::string& out, const OrderedJson& value);

void appendName(std::string& out, const std::string& name) {
    const auto isPlain = [](char c) { return c >= ' ' && c <= '~' && c != '"' && c != '\\'; };
    if (std::ranges::all_of(name, isPlain))
        out.append(1, '"').append(name).append("\": ");
    else
        appendCompact(out, OrderedJson(name)), out += ": ";
}

// Invalid UTF-8 is replaced by U+FFFD, because JSON does not allow it.
void appendCompact(std::string& out, const OrderedJson& value) {
    if (value.is_number_float())
        out += jsonNumber(value.get<double>());
    else if (!value.is_structured())
        out += value.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
    if (!value.is_structured()) return;
    out += value.is_array() ? "[" : "{ ";
    for (auto item = value.begin(); item != value.end(); ++item) {
        if (item != value.begin()) out += ", ";
        if (value.is_object()) appendName(out, item.key());
        appendCompact(out, *item);
    }
    out += value.is_array() ? "]" : " }";
}

/// Appends the value on one line if it fits behind `usedColumns`; else one item per line, at `indent` + 2.
void appendIndented(std::string& out, const OrderedJson& value, std::size_t indent, std::size_t usedColumns) {
    constexpr std::size_t maxLineLength = 140;
    const bool isObjectList = value.is_array() && !value.empty() && value.front().is_object();
    const bool isOuterLevel = indent == 0 || (indent == 2 && isObjectList); // the root, and lists of objects
                                                                            // in it such as bodies: never on
                                                                            // one line
    const bool hasItems = value.is_structured() && !value.empty();
    if (!hasItems || !isOuterLevel) {
        const std::string line = compactJson(value);
        if (!hasItems || usedColumns + line.size() < maxLineLength) {
            out += line;
            return;
        }
    }
    const std::string margin(indent + 2, ' ');
    out += value.is_array() ? "[\n" : "{\n";
    for (auto item = value.begin(); item != value.end(); ++item) {
        std::string name;
        if (value.is_object()) appendName(name, item.key());
        out += margin + name;
        appendIndented(out, *item, indent + 2, margin.size() + name.size());
        out += std::next(item) == value.end() ? "\n" : ",\n";
    }
    out += std::string(indent, ' ') + (value.is_array() ? "]" : "}");
}

} // namespace

std::string compactJson(const OrderedJson& value) {
    std::string line;
    appendCompact(line, value);
    return line;
}

std::string prettyJson(const OrderedJson& value) {
    std::string out;
    appendIndented(out, value, 0, 0);
    return out + "\n";
}

} // namespace physvib
