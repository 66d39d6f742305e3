// SPDX-License-Identifier: MIT
// The sections of a report, in order.
#pragma once
#include "Lab/Report/ReportBuilder.h"

namespace physvib {

void tellParticipants(ReportBuilder& report); ///< participants, numbers of trials, exclusions, ethics and
                                              ///< consent
void tellProcedure(ReportBuilder& report); ///< protocol in sentences, calls of the stimuli, levels, exposure
void tellApparatus(ReportBuilder& report); ///< device, levels, noise and limiter as recorded in the rows
void tellTimes(ReportBuilder& report);  ///< dates, breaks, resumes and outputs, if files of times are there
void tellOrders(ReportBuilder& report); ///< condition orders as run
void tellDoses(ReportBuilder& report);  ///< levels and exposure, by condition and by stimulus
void tellProvenance(ReportBuilder& report); ///< versions, seeds, files

// Results; each section is for trials of one kind of task.
void tellIdentification(ReportBuilder& report); ///< thesis Fig. 3.11, 3.12, 4.2 to 4.4
void tellPlaces(ReportBuilder& report);         ///< Fig. 4.6 to 4.9, Table 4.1
void tellPlaceErrors(ReportBuilder& report);    ///< targets without a grid: constant and variable error
void tellChoices(ReportBuilder& report);        ///< Fig. 5.8, 5.9
void tellRatings(ReportBuilder& report);        ///< Fig. 5.13, 5.14
void tellLevels(ReportBuilder& report); ///< staircases, adjustments, magnitudes; psychometric functions
/// Counts answers in words by stimulus; true if there are any.
bool tellDescriptions(ReportBuilder& report);

/// "P01 began at ...": from the columns time_utc, event, language, outputs and noise_outputs. Precondition:
/// there are moments. Any thread (allocates).
std::string timesSentence(const std::string& participant, const std::vector<StudyMoment>& moments);

} // namespace physvib
