// SPDX-License-Identifier: MIT
// Provenance of an output file: program version, seed and other inputs, as its first line or its comment.
#pragma once
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace physvib {

struct Provenance {
    std::string version;
    std::vector<std::pair<std::string, std::string>> entries; ///< e.g. {"seed", "1"}, {"scene", "driving"}
};

/// `physvib VERSION key=value ...` on one line; control characters become spaces. Any thread.
inline std::string provenanceLine(const Provenance& provenance) {
    std::string line = "physvib " + provenance.version;
    for (const auto& [key, value] : provenance.entries) line += " " + key + "=" + value;
    std::ranges::replace_if(
        line, [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
    return line;
}

/// The provenance as the first line of a CSV file, a comment. Any thread.
inline std::string provenanceComment(const Provenance& provenance) {
    return "# " + provenanceLine(provenance) + "\n";
}

} // namespace physvib
