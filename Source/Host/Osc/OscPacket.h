// SPDX-License-Identifier: GPL-3.0-or-later
// Packets of Open Sound Control 1.0: read and written by liblo; bundles are taken apart here, since liblo
// does that only for sockets of its own.
#pragma once
#include "Io/Result.h"
#include "Live/Documents/PlainMessage.h"
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace physvib {

/// Seconds since 1900 in the upper half, their fraction in the lower.
using OscTag = std::uint64_t;
constexpr OscTag oscNow = 1; ///< "immediately"

using OscValue = std::variant<double, std::string>;

struct OscMessage {
    std::string address;
    std::vector<OscValue> values; ///< numbers (also true and false, as 1 and 0) and words
    OscTag tag = oscNow;          ///< of the innermost bundle around it
};

/// All messages of a packet, in its order; of bundles at most `deepestBundle` in each other. Or what is
/// wrong, and nothing of it. Any thread but R.
Result<std::vector<OscMessage>> readOscPacket(std::span<const char> bytes);
constexpr int deepestBundle = 16;

/// Names and values by turns, as they stand in `message`: the opposite of plainOf. Numbers in single
/// precision, which every program understands (Pd no other): exact times are tags. Any thread but R.
std::vector<char> oscPacket(const std::string& address, const PlainMessage& message);
/// The same in a bundle.
std::vector<char> oscBundle(const std::string& address, const PlainMessage& message, OscTag tag);
/// A message of words alone. Any thread but R.
std::vector<char> oscWords(const std::string& address, std::initializer_list<std::string> words);

/// `level 0.5 place 1 0.5 law energy`: a name, then a word or one or more numbers, and so on. Or what is
/// wrong. Any thread but R.
Result<PlainMessage> plainOf(std::string_view name, const std::vector<OscValue>& values);

} // namespace physvib
