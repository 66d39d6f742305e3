// SPDX-License-Identifier: MIT
// Names of the parts of a body that events and actuators carry as numbers, as files write and read them.
#pragma once
#include "Core/EnchanterLayout.h"
#include "Io/Text/NumberText.h"
#include "Scene/NumberedNames.h"
#include <string>
#include <string_view>

namespace physvib {

inline constexpr std::string_view partNamePrefix = "part-"; // and the number of a part without a name

/// The number of the part that a file calls `name`; 0 if it has none. Any thread.
inline PartNumber partOf(std::string_view name) noexcept {
    if (name.starts_with(partNamePrefix))
        if (const auto number = parseNumber<PartNumber>(name.substr(partNamePrefix.size())).value_or(0);
            number > 0)
            return number;
    return partNamed(name);
}

/// The names by their numbers. One thread at a time.
class PartNames {
public:
    void add(std::string_view name) {
        if (const PartNumber part = partOf(name); part == partNamed(name)) names_.add(part, name);
    }

    /// What files write: a name that was added, a built-in name (chest), or else the number (part-923368111).
    /// Nothing for 0.
    std::string of(PartNumber part) const {
        if (part == 0) return {};
        if (const std::string* const known = names_.find(part)) return *known;
        for (const std::string_view name : bodyParts)
            if (partNamed(name) == part) return std::string{name};
        return std::string{partNamePrefix} + std::to_string(part);
    }

    bool operator==(const PartNames&) const = default;

private:
    NumberedNames names_;
};

} // namespace physvib
