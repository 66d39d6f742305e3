// SPDX-License-Identifier: MIT
// What a paper says of a study and trial files do not know: who the participants are, who is excluded and
// why, ethics and consent, and how loud the noise was at the ear.
#pragma once
#include "Io/Result.h"
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// One participant; what is not known is empty.
struct PersonFacts {
    std::string participant; ///< code, as in the trial files
    std::optional<double> ageYears;
    std::string sex, handedness;
    std::string excluded; ///< why all trials are left out; empty: they count
    bool operator==(const PersonFacts&) const = default;
};

/// Given by the user, beside the trials.
struct StudyFacts {
    std::vector<PersonFacts> people;
    std::string ethics, consent; ///< sentences for the report; empty: to be filled in
    std::string noise;           ///< the same of the noise's level at the ear
    bool operator==(const StudyFacts&) const = default;

    /// Null if nothing is known of that participant. Any thread.
    const PersonFacts* person(std::string_view participant) const noexcept;
    bool isExcluded(std::string_view participant) const noexcept;
};

/// A table with the column participant and any of age, sex, handedness, excluded; or one line `people.csv:3:
/// column age: expected ...`. Any thread.
Result<std::vector<PersonFacts>> readPeople(std::string_view text, std::string_view name);

} // namespace physvib
