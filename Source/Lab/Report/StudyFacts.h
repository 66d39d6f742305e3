// SPDX-License-Identifier: MIT
// Facts of a study that trial files do not contain: participants, exclusions with reasons, ethics, consent,
// and the noise level at the ear.
#pragma once
#include "Io/Result.h"
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// One participant; unknown fields are empty.
struct PersonFacts {
    std::string participant; ///< code, as in the trial files
    std::optional<double> ageYears;
    std::string sex, handedness;
    std::string excluded; ///< why all trials are excluded; empty: they count
    bool operator==(const PersonFacts&) const = default;
};

/// Facts given by the user.
struct StudyFacts {
    std::vector<PersonFacts> people;
    std::string ethics, consent; ///< sentences for the report; if empty, the report has a reminder
    std::string noise;           ///< sentence on the noise level at the ear, likewise
    std::string plan{};          ///< text of the plan (StudyPlanned.h); empty: none was given
    bool operator==(const StudyFacts&) const = default;

    /// Null if the table has no such participant. Any thread.
    const PersonFacts* person(std::string_view participant) const noexcept;
    bool isExcluded(std::string_view participant) const noexcept;
};

/// A table with the column participant and any of age, sex, handedness, excluded; or one line `people.csv:3:
/// column age: expected ...`. Any thread.
Result<std::vector<PersonFacts>> readPeople(std::string_view text, std::string_view name);

} // namespace physvib
