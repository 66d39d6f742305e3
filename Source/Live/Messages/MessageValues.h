// SPDX-License-Identifier: MIT
// The values of one message, asked for by the names in the table; each refusal is worded here, for every
// door.
#pragma once
#include "Core/PhantomPanner.h"
#include "Live/Documents/PlainMessage.h"
#include "Live/Messages/MessageTable.h"
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// What is wrong with a message: one line. Never leaves this room.
struct MessageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// All throw MessageError. Any thread but R.
class MessageValues {
public:
    /// Of a message in the table. Both outlive it. Throws of a value that the message does not have, or has
    /// twice.
    MessageValues(const PlainMessage& message, const MessageDescription& description,
                  const PhantomPanner& panner);

    bool has(std::string_view name) const { return find(name) != nullptr; }
    double number(std::string_view name) const; ///< or what is usual
    int wholeNumber(std::string_view name) const;
    std::string word(std::string_view name) const; ///< or what is usual
    bool isWord(std::string_view name) const;
    std::vector<double> numbers(std::string_view name) const;
    Spread spread() const;        ///< of `law`
    EnchanterPlace place() const; ///< in metres of the field
    std::vector<EnchanterPlace> places() const;

    /// Where that enchanter is, in metres of the field.
    EnchanterPlace enchanter(std::string_view name, char letter) const;

    /// At most one of these has been given.
    void expectOneOf(std::initializer_list<std::string_view> names) const;
    [[noreturn]] void fail(std::string_view name, const std::string& what) const;

private:
    const PlainValue* find(std::string_view name) const;
    const MessageArgument& argument(std::string_view name) const;
    double inRange(const MessageArgument& argument, double found) const;

    const PlainMessage& message_;
    const MessageDescription& description_;
    const PhantomPanner& panner_;
};

} // namespace physvib
