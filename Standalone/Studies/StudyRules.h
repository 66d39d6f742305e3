// SPDX-License-Identifier: GPL-3.0-or-later
// Rules of a study's check: what cannot be told apart, as it renders alike, and what no number of trials
// reaches.
#pragma once
#include "Studies/StudyCheck.h"

namespace physvib {

/// Adds to the errors and warnings of a check whose stimuli have their prints. Errors: a level, a factor,
/// alternatives or objects that change no sample; reversals, steps and times that cannot be reached.
/// Warnings: single stimuli or conditions that are the same samples, and what may be meant. Message thread.
void judgeRules(const Protocol& protocol, StudyCheck& check);

} // namespace physvib
