// SPDX-License-Identifier: GPL-3.0-or-later
// Parses and writes OSC bundles and messages, matches address patterns, and reads lists of names and values.
#include "Host/Osc/OscPacket.h"
#include "Io/Text/NumberText.h"
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <lo/lo.h>
#include <memory>

namespace physvib {
namespace {

struct FreeMessage {
    void operator()(lo_message message) const { lo_message_free(message); }
};
struct FreeBundle {
    void operator()(lo_bundle bundle) const { lo_bundle_free_recursive(bundle); }
};
using MessagePointer = std::unique_ptr<std::remove_pointer_t<lo_message>, FreeMessage>;
using BundlePointer = std::unique_ptr<std::remove_pointer_t<lo_bundle>, FreeBundle>;

/// A parse error; thrown and caught within this file.
struct OscError {
    std::string what;
};

constexpr std::string_view bundleMark{"#bundle\0", 8};

std::uint64_t bigEndian(std::span<const char> bytes) {
    std::uint64_t value = 0;
    for (const char byte : bytes) value = value << 8 | static_cast<unsigned char>(byte);
    return value;
}

// liblo does not guarantee alignment.
template <class T>
T unalignedValue(const void* at) {
    T value;
    std::memcpy(&value, at, sizeof value);
    return value;
}

double finite(double number) {
    if (!std::isfinite(number)) throw OscError{"expected numbers that are finite"};
    return number;
}

OscValue toOscValue(char type, const lo_arg* value) {
    switch (type) {
    case LO_INT32: return static_cast<double>(unalignedValue<std::int32_t>(value));
    case LO_INT64: return static_cast<double>(unalignedValue<std::int64_t>(value));
    case LO_FLOAT: return finite(static_cast<double>(unalignedValue<float>(value)));
    case LO_DOUBLE: return finite(unalignedValue<double>(value));
    case LO_TRUE: return 1.0;
    case LO_FALSE: return 0.0;
    case LO_STRING:
    case LO_SYMBOL: return std::string(reinterpret_cast<const char*>(value));
    default: throw OscError{"expected numbers and words, found one of type " + inQuotes({&type, 1})};
    }
}

OscMessage readMessage(std::span<const char> bytes, OscTag tag) {
    std::vector<char> buffer(bytes.begin(), bytes.end()); // liblo needs a mutable buffer
    int errorCode = 0;
    const MessagePointer message{lo_message_deserialise(buffer.data(), buffer.size(), &errorCode)};
    if (!message) throw OscError{"expected an OSC message (liblo: " + std::to_string(errorCode) + ")"};
    OscMessage read{std::string(buffer.data()), {}, tag};
    if (!read.address.starts_with('/'))
        throw OscError{"expected an address that begins with /, found " + inQuotes(read.address)};
    const char* const types = lo_message_get_types(message.get());
    lo_arg** const values = lo_message_get_argv(message.get());
    for (int i = 0; i < lo_message_get_argc(message.get()); ++i)
        read.values.push_back(toOscValue(types[i], values[i]));
    return read;
}

void readElement(std::span<const char> bytes, OscTag tag, int depth, std::vector<OscMessage>& all) {
    if (bytes.empty() || bytes.size() % 4 != 0)
        throw OscError{"expected a multiple of four bytes, found " + std::to_string(bytes.size())};
    if (!std::string_view(bytes.data(), bytes.size()).starts_with(bundleMark))
        return all.push_back(readMessage(bytes, tag));
    if (depth == maxBundleDepth)
        throw OscError{"expected bundles at most " + std::to_string(maxBundleDepth) + " deep"};
    if (bytes.size() < 16) throw OscError{"expected a time tag in a bundle"};
    tag = bigEndian(bytes.subspan(8, 8));
    for (bytes = bytes.subspan(16); !bytes.empty();) {
        const std::uint64_t size = bigEndian(bytes.first(4));
        bytes = bytes.subspan(4);
        if (size > bytes.size()) throw OscError{"expected a bundle of whole elements"};
        readElement(bytes.first(size), tag, depth + 1, all);
        bytes = bytes.subspan(size);
    }
}

MessagePointer makeLoMessage(const PlainMessage& plain) {
    MessagePointer message{lo_message_new()};
    for (const NamedValue& value : plain.values) {
        lo_message_add_string(message.get(), value.name.c_str());
        if (const auto* word = std::get_if<std::string>(&value.value))
            lo_message_add_string(message.get(), word->c_str());
        else if (const auto* number = std::get_if<double>(&value.value))
            lo_message_add_float(message.get(), static_cast<float>(*number));
        else
            for (const double part : std::get<std::vector<double>>(value.value))
                lo_message_add_float(message.get(), static_cast<float>(part));
    }
    return message;
}

std::vector<char> toBytes(const MessagePointer& message, const std::string& address) {
    std::vector<char> bytes(lo_message_length(message.get(), address.c_str()));
    lo_message_serialise(message.get(), address.c_str(), bytes.data(), nullptr);
    return bytes;
}

/// Whether the set between the brackets of a pattern contains `c`.
bool isInSet(std::string_view set, char c) noexcept {
    const bool isNegated = set.starts_with('!');
    bool has = false;
    for (std::size_t i = isNegated ? 1 : 0; i < set.size(); ++i) {
        const std::size_t last = i + 2 < set.size() && set[i + 1] == '-' ? i + 2 : i;
        has = has || (set[i] <= c && c <= set[last]);
        i = last;
    }
    return has != isNegated;
}

} // namespace

Result<std::vector<OscMessage>> readOscPacket(std::span<const char> bytes) {
    try {
        std::vector<OscMessage> all;
        readElement(bytes, oscNow, 0, all);
        return all;
    } catch (const OscError& error) {
        return Failure{error.what};
    }
}

std::vector<char> oscPacket(const std::string& address, const PlainMessage& message) {
    return toBytes(makeLoMessage(message), address);
}

std::vector<char> oscStringPacket(const std::string& address, std::initializer_list<std::string> words) {
    const MessagePointer message{lo_message_new()};
    for (const std::string& word : words) lo_message_add_string(message.get(), word.c_str());
    return toBytes(message, address);
}

std::vector<char> oscBundle(const std::string& address, const PlainMessage& message, OscTag tag) {
    const BundlePointer bundle{
        lo_bundle_new({static_cast<std::uint32_t>(tag >> 32), static_cast<std::uint32_t>(tag)})};
    lo_bundle_add_message(bundle.get(), address.c_str(), makeLoMessage(message).release());
    std::vector<char> bytes(lo_bundle_length(bundle.get()));
    lo_bundle_serialise(bundle.get(), bytes.data(), nullptr);
    return bytes;
}

// Bit i of `reached`: the first i characters of the address match what was read of the pattern. (liblo's own
// matcher reads beyond the end of an address.)
bool matchesOscPattern(std::string_view pattern, std::string_view address) {
    const auto next = [&](std::uint64_t reached, auto matches) {
        std::uint64_t advanced = 0;
        for (std::size_t i = 0; i < address.size(); ++i)
            if ((reached >> i & 1U) != 0 && matches(address[i])) advanced |= std::uint64_t{2} << i;
        return advanced;
    };
    std::uint64_t reached = 1;
    for (std::size_t at = 0; at < pattern.size() && reached != 0; ++at) {
        const char lead = pattern[at];
        const std::size_t end = pattern.find(lead == '[' ? ']' : lead == '{' ? '}' : lead, at);
        if (end == pattern.npos) return false; // the bracket is not closed
        const std::string_view inside = pattern.substr(at + 1, end - std::min(end, at + 1));
        at = end;
        if (lead == '*')
            reached = ~std::uint64_t{0} << std::countr_zero(reached);
        else if (lead == '{') {
            std::uint64_t any = 0, part = reached;
            for (const char c : inside)
                part = c == ',' ? (any |= part, reached) : next(part, [c](char found) { return found == c; });
            reached = any | part;
        } else
            reached = next(
                reached, [&](char c) { return lead == '[' ? isInSet(inside, c) : lead == '?' || lead == c; });
    }
    return (reached >> address.size() & 1U) != 0;
}

Result<PlainMessage> parseOscValues(std::string_view name, const std::vector<OscValue>& values) {
    PlainMessage message{std::string(name), {}};
    for (std::size_t i = 0; i < values.size();) {
        const auto* const named = std::get_if<std::string>(&values[i]);
        if (named == nullptr)
            return Failure{printable(name) + ": expected a name before " +
                           plainNumber(std::get<double>(values[i]))};
        if (++i == values.size())
            return Failure{printable(name) + ": " + printable(*named) + ": expected a value"};
        if (const auto* word = std::get_if<std::string>(&values[i])) {
            message.values.push_back({*named, *word});
            ++i;
            continue;
        }
        std::vector<double> numbers;
        for (; i < values.size() && std::holds_alternative<double>(values[i]); ++i)
            numbers.push_back(std::get<double>(values[i]));
        if (numbers.size() == 1)
            message.values.push_back({*named, numbers.front()});
        else
            message.values.push_back({*named, std::move(numbers)});
    }
    return message;
}

} // namespace physvib
