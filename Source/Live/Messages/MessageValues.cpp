// SPDX-License-Identifier: MIT
// Checks a message's values against the types and ranges of the table, and resolves places and actuator
// letters.
#include "Live/Messages/MessageValues.h"
#include "Io/Text/NameList.h"
#include "Io/Text/NumberText.h"
#include <algorithm>
#include <cmath>

namespace physvib {

namespace {

constexpr double farthestMetres = 1e6; // beyond every field

bool isOnSomeField(double metres) { return std::abs(metres) <= farthestMetres; }

} // namespace

MessageValues::MessageValues(const PlainMessage& message, const MessageDescription& description,
                             const PhantomPanner& panner)
    : message_{message}
    , description_{description}
    , panner_{panner} {
    for (auto value = message.values.begin(); value != message.values.end(); ++value) {
        argument(value->name);
        if (std::ranges::find(message.values.begin(), value, value->name, &NamedValue::name) != value)
            fail(value->name, "expected once");
    }
}

void MessageValues::fail(std::string_view name, const std::string& what) const {
    throw MessageError{std::string(name) + ": " + what};
}

const PlainValue* MessageValues::find(std::string_view name) const {
    const auto found = std::ranges::find(message_.values, name, &NamedValue::name);
    return found == message_.values.end() ? nullptr : &found->value;
}

const MessageArgument& MessageValues::argument(std::string_view name) const {
    for (const MessageArgument& own : description_.arguments)
        if (own.name == name) return own;
    for (const MessageArgument& common : messages::when)
        if (common.name == name && !description_.isQuery()) return common;
    throw MessageError{"has no " + inQuotes(name)};
}

double MessageValues::inRange(const MessageArgument& argument, double found) const {
    if (!(found >= argument.least && found <= argument.most))
        fail(argument.name, "expected " + numberText(argument.least) + " to " + plainNumber(argument.most) +
                                ", found " + numberText(found));
    return found;
}

double MessageValues::number(std::string_view name) const {
    const MessageArgument& wanted = argument(name);
    const PlainValue* const value = find(name);
    if (value == nullptr) return parseNumber<double>(wanted.usual).value_or(0.0);
    const auto* const found = std::get_if<double>(value);
    if (found == nullptr) fail(name, "expected a number");
    return inRange(wanted, *found);
}

int MessageValues::wholeNumber(std::string_view name) const {
    const double found = number(name);
    if (found != std::floor(found)) fail(name, "expected a whole number, found " + numberText(found));
    return static_cast<int>(found);
}

std::string MessageValues::word(std::string_view name) const {
    const PlainValue* const value = find(name);
    if (value == nullptr) return std::string(argument(name).usual);
    const auto* const found = std::get_if<std::string>(value);
    if (found == nullptr) fail(name, "expected a word");
    return *found;
}

bool MessageValues::isWord(std::string_view name) const {
    const PlainValue* const value = find(name);
    return value != nullptr && std::holds_alternative<std::string>(*value);
}

std::vector<double> MessageValues::numbers(std::string_view name) const {
    const PlainValue* const value = find(name);
    const auto* const found = value == nullptr ? nullptr : std::get_if<std::vector<double>>(value);
    if (found == nullptr) fail(name, "expected a list of numbers");
    double last = -1.0;
    for (const double number : *found) {
        if (inRange(argument(name), number) <= last)
            fail(name, "expected rising numbers, found " + numberText(number) + " after " + numberText(last));
        last = number;
    }
    return *found;
}

Spread MessageValues::spread() const {
    const std::string name = word("law");
    if (name == nameOf(PanningLaw::automatic)) return panner_.travelSpread();
    const auto found = std::ranges::find(spreadNames, name);
    if (found != spreadNames.end()) return static_cast<Spread>(found - spreadNames.begin());
    fail("law", "expected one of " + listed(spreadNames) + ", found " + inQuotes(name));
}

EnchanterPlace MessageValues::enchanter(std::string_view name, char letter) const {
    const EnchanterLayout& layout = panner_.layout();
    const int j = letter - 'A';
    if (j < 0 || j >= layout.count || letter > 'Z')
        fail(name, "expected " + std::string(layout.count > 1 ? "letters from A to " : "the letter ") +
                       static_cast<char>('A' + std::min(layout.count, 26) - 1) + ", found " +
                       inQuotes({&letter, 1}));
    const EnchanterPlace& at = layout.places[static_cast<std::size_t>(j)];
    return {at.xMetres * panner_.fieldWidthMetres() / layout.extentWidthMetres,
            at.yMetres * panner_.fieldHeightMetres() / layout.extentHeightMetres,
            at.zMetres * panner_.fieldWidthMetres() / layout.extentWidthMetres};
}

EnchanterPlace MessageValues::place() const {
    const PlainValue* const value = find("place");
    if (value == nullptr) return {0.5 * panner_.fieldWidthMetres(), 0.5 * panner_.fieldHeightMetres()};
    if (const auto* letter = std::get_if<std::string>(value); letter != nullptr && letter->size() == 1)
        return enchanter("place", letter->front());
    const auto* const found = std::get_if<std::vector<double>>(value);
    const std::size_t count = found == nullptr ? 0 : found->size();
    if ((count != 2 && count != 3) || !std::ranges::all_of(*found, isOnSomeField))
        fail("place", "expected x and y, or x, y and z in metres, or an actuator's letter");
    return {(*found)[0], (*found)[1], count == 3 ? (*found)[2] : 0.0};
}

std::vector<EnchanterPlace> MessageValues::places() const {
    std::vector<EnchanterPlace> all;
    const PlainValue* const value = find("places");
    if (value == nullptr) fail("places", "expected places, found none");
    if (const auto* letters = std::get_if<std::string>(value))
        for (const char letter : *letters) all.push_back(enchanter("places", letter));
    if (const auto* found = std::get_if<std::vector<double>>(value)) {
        if (found->size() % 2 != 0 || !std::ranges::all_of(*found, isOnSomeField))
            fail("places", "expected pairs of x and y in metres");
        for (std::size_t i = 0; i < found->size(); i += 2) all.push_back({(*found)[i], (*found)[i + 1]});
    }
    if (all.size() < 2 || all.size() > messages::mostPlaces)
        fail("places", "expected 2 to " + std::to_string(messages::mostPlaces) + " places, found " +
                           std::to_string(all.size()));
    return all;
}

void MessageValues::expectOneOf(std::initializer_list<std::string_view> names) const {
    std::string_view first;
    for (const std::string_view name : names) {
        if (!has(name)) continue;
        if (!first.empty()) fail(name, "expected either this or " + std::string(first));
        first = name;
    }
}

} // namespace physvib
