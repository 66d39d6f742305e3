// SPDX-License-Identifier: GPL-3.0-or-later
// Reads and writes packets of Open Sound Control 1.0 through liblo. Bundles are split here, because liblo
// does that only for its own sockets.
#pragma once
#include "Io/Result.h"
#include "Live/Documents/InputLine.h"
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace physvib {

/// NTP time: seconds since 1900 in the upper 32 bits, their fraction in the lower 32.
using OscTag = std::uint64_t;
constexpr OscTag oscNow = 1; ///< "immediately"

using OscValue = std::variant<double, std::string>;

struct OscMessage {
    std::string address;
    std::vector<OscValue> values; ///< numbers (true and false as 1 and 0) and strings
    OscTag tag = oscNow;          ///< of the innermost enclosing bundle
};

/// All messages of a packet in order, from bundles nested at most `maxBundleDepth` deep. Or the error, and no
/// message. Any thread but R.
Result<std::vector<OscMessage>> readOscPacket(std::span<const char> bytes);
constexpr int maxBundleDepth = 16;

/// Alternating names and values, in the order of `message`; the inverse of parseOscValues. Numbers are single
/// precision, the only type that all programs read (Pd no other); exact times are tags. Any thread but R.
std::vector<char> oscPacket(const std::string& address, const PlainMessage& message);
/// The same message in a bundle with that tag.
std::vector<char> oscBundle(const std::string& address, const PlainMessage& message, OscTag tag);
/// A message that has strings only. Any thread but R.
std::vector<char> oscStringPacket(const std::string& address, std::initializer_list<std::string> words);

/// Whether `address` (at most 62 characters) matches an address pattern of OSC 1.0; `*` and `?` also match
/// `/`. Any thread.
bool matchesOscPattern(std::string_view pattern, std::string_view address);
constexpr std::string_view oscPatternCharacters = "?*[{";

/// Parses `level 0.5 place 1 0.5 law energy`: a name, then a string or one or more numbers, and so on. Or the
/// error. Any thread but R.
Result<PlainMessage> parseOscValues(std::string_view name, const std::vector<OscValue>& values);

} // namespace physvib
