// SPDX-License-Identifier: MIT
// Human-readable JSON output: short values on one line, numbers with the fewest digits that read back.
#pragma once
#include <nlohmann/json.hpp>
#include <string>

extern template class nlohmann::basic_json<nlohmann::ordered_map>; // compiled once, in JsonLines.cpp

namespace physvib {

using OrderedJson = nlohmann::ordered_json; // fields stay in the order they were added

/// The shortest text that JSON reads back as the same bits: "-0" would be read as an integer. Any thread.
std::string jsonNumber(double number);

/// The value on one line, without a newline. Any thread.
std::string jsonLine(const OrderedJson& value);

/// The value in lines of up to 140 characters, where its parts allow it; a newline at the end. Any thread.
std::string jsonLines(const OrderedJson& value);

} // namespace physvib
