// SPDX-License-Identifier: MIT
// A message or an answer in a form independent of its transport (line, OSC, C): a name and named values.
// Source/Live/Messages defines what each message does.
#pragma once
#include <string>
#include <variant>
#include <vector>

namespace physvib {

using PlainValue = std::variant<double, std::string, std::vector<double>>;

struct NamedValue {
    std::string name;
    PlainValue value;
    bool operator==(const NamedValue&) const = default;
};

struct PlainMessage {
    std::string name;
    std::vector<NamedValue> values;
    bool operator==(const PlainMessage&) const = default;
};

/// As a line of JSON: `{ "answer": "latency", "play_out_s": 0.03 }`. Any thread.
std::string answerLine(const PlainMessage& answer);

} // namespace physvib
