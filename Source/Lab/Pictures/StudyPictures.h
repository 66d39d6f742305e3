// SPDX-License-Identifier: MIT
// The results of studies as pictures: PNG bytes, the same for the same input and fonts.
#pragma once
#include "Lab/Study/Attenuation.h"
#include "Lab/Study/ConfusionMatrix.h"
#include "Lab/Study/InformationTransfer.h"
#include "Lab/Study/LevelTrials.h"
#include "Lab/Study/ResponseMap.h"
#include "Lab/Study/Votes.h"
#include <span>
#include <string>
#include <vector>

namespace physvib {

/// What stands around every picture.
struct PictureWords {
    std::string source;       ///< file names
    std::string provenance;   ///< version and analysis
    bool isSimulated = false; ///< watermarked: no person's figures may be mistaken for it
};

/// A condition's matrix and what it transfers.
struct ConfusionPanel {
    std::string title;
    ConfusionMatrix matrix;
    InformationTransfer transfer;
};

struct IconShare {
    std::string label;
    double shareCorrect = 0.0;
};
struct IconPanel {
    std::string title;
    std::vector<IconShare> icons;
};

// Any thread. Each panel list has at least one item.

/// A matrix per condition, brightness = share of the stimulus' trials.
std::string confusionPicture(std::span<const ConfusionPanel> panels, const PictureWords& words);

/// The chosen patterns and how often each was identified.
std::string iconPicture(std::span<const IconPanel> panels, const PictureWords& words);

/// Per condition: the normals as ellipses of one standard deviation, the map of the likeliest target, the
/// merged grid. Conditions that only have percent counts show the grid alone.
std::string resolutionPicture(std::span<const ConditionResolution> conditions, const PictureWords& words);

/// Shares with their intervals.
std::string choicePicture(std::span<const ChoiceSummary> summaries, const PictureWords& words);

/// Thresholds, matched levels and magnitudes, one kind below the other.
std::string levelPicture(std::span<const LevelSummary> summaries, const PictureWords& words);

/// Gamma over the frequency: a panel per axis, a curve per layer.
std::string isolationPicture(std::span<const IsolationResult> results, const PictureWords& words);

/// Mean scores with their intervals, a panel per scale.
std::string ratingPicture(const std::vector<std::string>& scales, std::span<const RatingSummary> summaries,
                          const PictureWords& words);

} // namespace physvib
