// SPDX-License-Identifier: MIT
// The parts of a report, in their order.
#pragma once
#include "Lab/Report/ReportBuilder.h"

namespace physvib {

void tellParticipants(ReportBuilder& report); ///< who, how many trials, who is left out, ethics and consent
void tellProcedure(ReportBuilder& report);  ///< in the protocol's own words, the calls that made the stimuli,
                                            ///< levels, exposure
void tellApparatus(ReportBuilder& report);  ///< device, levels, noise and limiter, as rows have them
void tellOrders(ReportBuilder& report);     ///< the orders of conditions as they were run
void tellPower(ReportBuilder& report);      ///< which differences so many participants can show
void tellProvenance(ReportBuilder& report); ///< versions, seeds, files

// What the trials say; each is for trials of one kind of task.
void tellIdentification(ReportBuilder& report); ///< thesis Fig. 3.11, 3.12, 4.2 to 4.4
void tellPlaces(ReportBuilder& report);         ///< Fig. 4.6 to 4.9, Table 4.1
void tellPlaceErrors(ReportBuilder& report);    ///< targets on no grid: constant and variable error
void tellChoices(ReportBuilder& report);        ///< Fig. 5.8, 5.9
void tellRatings(ReportBuilder& report);        ///< Fig. 5.13, 5.14
void tellLevels(ReportBuilder& report); ///< staircases, adjustments, magnitudes; psychometric functions

} // namespace physvib
